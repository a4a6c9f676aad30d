// Sobol's sequence, scrambled: points that fill the unit cube evenly.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "host/sampling/random.hpp"

namespace slideway {

/// One coordinate of the sequence.  Point i, in the order of the Gray code g = i ⊕ ⌊i/2⌋ (Antonov & Saleev 1979), is
/// x_i = shift ⊕ ⊕_r g_r v_r, its leading 52 bits read as a fraction.  So point i costs as many operations as g has
/// bits.
class SobolAxis {
public:
    static constexpr int bits = 64;
    using Directions = std::array<std::uint64_t, bits>;  // v_r, the digit worth 1/2 in bit 63

    /// The axis as it is.
    explicit SobolAxis(Directions const& directions) : directions_(directions) {}

    /// Scrambled: x → L x ⊕ shift over the digits, L random, lower triangular with ones on its diagonal (J. Matoušek,
    /// J. Complexity 14 (1998) 527, "random linear scrambling"), the shift random.  Points of a (t, k, d)-net remain
    /// one, and each alone is uniform.
    SobolAxis(Directions const& directions, StreamKey const& key, Stream stream);

    /// Coordinate of a point, in (0, 1): an odd multiple of 2^-53.
    double operator()(std::uint64_t index) const;

private:
    Directions directions_;
    std::uint64_t shift_ = 0;
};

/// Most dimensions that there are numbers for.
std::size_t sobol_dimensions();

/// Direction numbers of Joe & Kuo (SIAM J. Sci. Comput. 30 (2008) 2635), as Boost.Random has them, [dimensions].
/// @param dimensions <= sobol_dimensions().
std::vector<SobolAxis::Directions> sobol_directions(std::size_t dimensions);

}  // namespace slideway
