// Integrals over the part of a face that is below its wall: its polygon, cut into triangles, by Radon's formula.
#pragma once

#include <vector>

#include "numbers.hpp"

namespace oracle::detail {

/// A place of the square [-1, 1]^2, with what the face does there.
struct BedPlace { Real along, across, depth, rate; };

struct WeightedPlace {
    BedPlace place;
    Real area;
};

/// Places and weights that integrate products of up to five affine functions over where the depth is above zero, exactly.
/// @param square its corners in order; depth and rate are affine
std::vector<WeightedPlace> quadrature_over_wet(std::vector<BedPlace> const& square);

}  // namespace oracle::detail
