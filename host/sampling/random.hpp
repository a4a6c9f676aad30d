// Random numbers that depend on their address alone, (seed, member, key name), and a random order of which any place can be asked alone.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace slideway {

/// Philox 4×64 with ten rounds (Salmon et al., SC 2011), by Random123.
std::array<std::uint64_t, 4> philox(std::array<std::uint64_t, 4> counter, std::array<std::uint64_t, 2> key);

/// FNV-1a: what a name is in the key of a generator.
std::uint64_t name_hash(std::string_view name);

/// Independent numbers of one key: second word of the counter.
enum class Stream : std::uint64_t { value, permutation, jitter, scramble, second_scramble };

/// The numbers of one varied key: seed and hash of its name.  So neither the order of the variations nor other keys, members or threads
/// change what a member draws.
struct StreamKey {
    std::uint64_t seed;
    std::uint64_t name;

    /// Four words at an address of a stream; `sub` tells apart several calls for one index.
    std::array<std::uint64_t, 4> words(Stream stream, std::uint64_t index, std::uint64_t sub = 0) const;
    /// Uniform in (0, 1), an odd multiple of 2^-53.
    double uniform(Stream stream, std::uint64_t index) const;
};

/// The odd multiple of 2^-53 in (0, 1) that the leading 52 bits of a word say.
double unit_fraction(std::uint64_t word);

/// Pseudo-random permutation of [0, size) in O(1) memory: a Feistel network over the bits of size − 1, at least six,
/// its round functions by Philox; what falls beyond the end goes through again (cycle walking: Black & Rogaway, CT-RSA
/// 2002, section 3).  The halves differ by a bit where the number of bits is odd (Schneier & Kelsey, FSE 1996:
/// unbalanced networks).
class Permutation {
public:
    /// @param size >= 1.
    Permutation(std::uint64_t size, StreamKey const& key);
    /// Where `index` goes, in [0, size).  @throws std::out_of_range if index >= size.
    std::uint64_t operator()(std::uint64_t index) const;

private:
    std::uint64_t shuffle(std::uint64_t index) const;

    std::uint64_t size_;
    StreamKey key_;
    int right_bits_;
    std::uint64_t left_mask_, right_mask_;
};

}  // namespace slideway
