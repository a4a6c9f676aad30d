#include "host/base/fnv1a.hpp"

#include <bit>

namespace slideway {

static_assert(std::endian::native == std::endian::little, "the hash is defined over little-endian bytes");

void Fnv1a::add(std::span<std::byte const> bytes) {
    for (std::byte const byte : bytes) {
        hash_ = (hash_ ^ static_cast<std::uint64_t>(byte)) * 1099511628211u;
    }
}

void Fnv1a::add(std::string_view text) { add(std::as_bytes(std::span(text))); }

void Fnv1a::add(std::uint64_t value) { add(std::as_bytes(std::span(&value, 1))); }

std::uint64_t fnv1a(std::span<std::byte const> bytes) {
    Fnv1a hash;
    hash.add(bytes);
    return hash.value();
}

std::uint64_t fnv1a(std::string_view text) { return fnv1a(std::as_bytes(std::span(text))); }

}  // namespace slideway
