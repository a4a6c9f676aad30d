// Numbers as little-endian bytes and back, and checksums of bytes.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/base/error.hpp"

namespace slideway {

static_assert(std::endian::native == std::endian::little, "bytes in files are little-endian");

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

class ByteWriter {
public:
    void put(std::uint64_t word) { append(&word, sizeof word); }
    void put(double number) { append(&number, sizeof number); }
    /// Its length before it.
    void put(std::span<std::byte const> bytes) {
        put(std::uint64_t{bytes.size()});
        append(bytes);
    }
    /// Without its length.
    void append(std::span<std::byte const> bytes) { append(bytes.data(), bytes.size()); }
    void put(std::string_view text) { put(std::as_bytes(std::span(text))); }
    std::vector<std::byte> take() { return std::move(bytes_); }

private:
    void append(void const* from, std::size_t length) {
        if (length == 0) return;
        bytes_.resize(bytes_.size() + length);
        std::memcpy(bytes_.data() + bytes_.size() - length, from, length);
    }
    std::vector<std::byte> bytes_;
};

/// What cannot be read throws FileError: "NAME: is damaged (its statistics are cut short)".
class ByteReader {
public:
    ByteReader(std::span<std::byte const> bytes, std::string name) : rest_(bytes), name_(std::move(name)) {}
    std::uint64_t word() { return number<std::uint64_t>(); }
    double real() { return number<double>(); }
    std::span<std::byte const> block() { return take(word()); }
    std::string text() {
        auto const bytes = block();
        return std::string(reinterpret_cast<char const*>(bytes.data()), bytes.size());
    }
    /// How many entries follow, of `size` bytes each at least: no more than there is room for.
    std::size_t count(std::size_t size) {
        std::uint64_t const entries = word();
        if (entries > rest_.size() / size) fail("it names more entries than it holds");
        return static_cast<std::size_t>(entries);
    }
    void end() const {
        if (!rest_.empty()) fail("something follows them");
    }
    [[noreturn]] void fail(std::string_view why) const {
        throw FileError(name_ + std::string(": its statistics are damaged (") + std::string(why) + ")");
    }

private:
    template <class T> T number() {
        T value;
        std::memcpy(&value, take(sizeof value).data(), sizeof value);
        return value;
    }
    std::span<std::byte const> take(std::uint64_t length) {
        if (length > rest_.size()) fail("they are cut short");
        auto const taken = rest_.first(static_cast<std::size_t>(length));
        rest_ = rest_.subspan(static_cast<std::size_t>(length));
        return taken;
    }
    std::span<std::byte const> rest_;
    std::string name_;
};

}  // namespace slideway
