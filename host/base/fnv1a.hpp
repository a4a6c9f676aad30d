// A checksum that is the same on every machine and in every version, unlike std::hash.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

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

/// Of all bytes at once.
std::uint64_t fnv1a(std::span<std::byte const> bytes);
std::uint64_t fnv1a(std::string_view text);

}  // namespace slideway
