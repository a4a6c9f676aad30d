// A random order of [0, size), of which any place can be asked alone.
#pragma once

#include <cstdint>

#include "host/sampling/random.hpp"

namespace slideway {

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
