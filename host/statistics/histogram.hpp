// Counts of a sample in equal bins.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace slideway {

inline constexpr std::size_t most_bins = 64;

/// Bin i is edges[i] <= x < edges[i+1], the last one with its upper edge.
struct Histogram {
    std::vector<double> edges;           // [bins + 1], ascending; empty without finite numbers
    std::vector<std::uint64_t> counts;   // [bins]
    std::uint64_t below = 0, above = 0;  // -infinity, +infinity: in no bin
};

/// Equal bins from the least to the largest finite number.  Their number is that of Freedman and Diaconis, the range
/// over 2 IQR n^(-1/3), rounded up and limited to [1, 64]; where the quartiles coincide but not the ends it is 64.  A
/// sample of one value alone has one bin of no width, both edges that value.  Infinite numbers are counted apart and
/// take no part in range, quartiles and n.
/// Source: Freedman and Diaconis (1981), On the histogram as a density estimator, Z. Wahrscheinlichkeitstheorie 57.
/// @param sorted ascending, no NaN.
Histogram histogram(std::span<double const> sorted);

}  // namespace slideway
