// Random numbers that depend on their address alone: (seed, member, key name).
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace slideway {

/// Philox 4×64 with ten rounds (Salmon et al., SC 2011), by Random123.
std::array<std::uint64_t, 4> philox(std::array<std::uint64_t, 4> counter, std::array<std::uint64_t, 2> key);

/// FNV-1a of 64 bits: the same on every machine and in every version, unlike std::hash.
std::uint64_t name_hash(std::string_view name);

/// Uniform in (0, 1), an odd multiple of 2^-53.  Key of the generator: seed and hash of the name; counter: member.
/// So neither the order of the variations nor other keys, members or threads change what a member draws.
double uniform_draw(std::uint64_t seed, std::uint64_t member, std::string_view name);

}  // namespace slideway
