// A checksum that is the same on every machine and in every version, unlike std::hash.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace slideway {

static_assert(std::endian::native == std::endian::little, "the hash is defined over little-endian bytes");

/// 64-bit FNV-1a (Fowler, Noll and Vo): for each byte, hash = (hash xor byte) · 1099511628211 mod 2^64, from
/// 14695981039346656037.  Not cryptographic.
class Fnv1a {
public:
    void add(std::span<std::byte const> bytes) {
        for (std::byte const byte : bytes) hash_ = (hash_ ^ static_cast<std::uint64_t>(byte)) * 1099511628211u;
    }
    void add(std::string_view text) { add(std::as_bytes(std::span(text))); }
    void add(std::uint64_t value) { add(std::as_bytes(std::span(&value, 1))); }  // eight bytes, the lowest first
    std::uint64_t value() const { return hash_; }

private:
    std::uint64_t hash_ = 14695981039346656037u;
};

/// Of all bytes at once.
inline std::uint64_t fnv1a(std::span<std::byte const> bytes) {
    Fnv1a hash;
    hash.add(bytes);
    return hash.value();
}
inline std::uint64_t fnv1a(std::string_view text) { return fnv1a(std::as_bytes(std::span(text))); }

}  // namespace slideway
