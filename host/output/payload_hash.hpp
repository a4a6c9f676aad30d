// A fingerprint of a result file's numbers, to compare runs and to notice damage.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "host/output/netcdf_file.hpp"

namespace slideway {

/// 64-bit FNV-1a (Fowler, Noll and Vo): for each byte, hash = (hash xor byte) · 1099511628211 mod 2^64, from
/// 14695981039346656037.  Not cryptographic.
class Fnv1a {
public:
    void add(std::span<std::byte const> bytes);
    void add(std::string_view text);
    void add(std::uint64_t value);  // eight bytes, the lowest first
    std::uint64_t value() const { return hash_; }

private:
    std::uint64_t hash_ = 14695981039346656037u;
};

/// The hash over all variables of a file by name (a file made in memory forgets their order): name, number of
/// dimensions, their lengths, then the data in C order, little-endian, each number in its own width.  Every NaN counts
/// as the same one, as its bits differ between instruction sets.  Groups follow what they lie in, in the order of their
/// definition: name, then their variables and groups in the same way.  Attributes do not count: the same numbers
/// computed on another day, with other threads or another compiler keep their hash.  @return 16 hexadecimal digits.
std::string payload_hash(NetcdfFile const& file);

}  // namespace slideway
