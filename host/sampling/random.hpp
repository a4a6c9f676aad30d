// Random numbers that depend on their address alone: (seed, member, key name).
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

}  // namespace slideway
