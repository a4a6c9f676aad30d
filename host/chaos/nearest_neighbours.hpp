// Who is nearest in delay coordinates, though far in time.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "host/chaos/delay_embedding.hpp"

namespace slideway {

struct Neighbour {
    static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
    std::size_t index = none;
    double distance = std::numeric_limits<double>::quiet_NaN();  // Euclidean
};

/// For each of the first `points` points Xᵢ the nearest Xⱼ among them with |i - j| > theiler (Theiler 1986) and
/// |Xᵢ - Xⱼ| > resolution: the distance to a repeated point is none, or rounding, and tells nothing by its growth.  Of equally
/// near ones the first.
/// @param points at most embedding.size(); the points behind them are neither asked nor found.
/// @param resolution in units of the series, ≥ 0.
/// @return one entry per point; `none` where no point is left.
std::vector<Neighbour> nearest_neighbours(DelayEmbedding const& embedding, std::size_t points, std::size_t theiler,
                                          double resolution = 0);

}  // namespace slideway
