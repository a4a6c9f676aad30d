// Summary statistics of plain numbers.
#pragma once

#include <cstddef>
#include <span>

namespace slideway {

/// Of the numbers that are not NaN; all NaN when there are none.
struct Summary {
    std::size_t count = 0;    // numbers used
    std::size_t missing = 0;  // NaN
    double mean, sd;          // sd: with count - 1; NaN for a single number
    double min, median, max;
};

Summary summarise(std::span<double const> values);

/// Sample quantile by linear interpolation (type 7 of Hyndman and Fan 1996): with h = (n-1)p, the value is
/// x[⌊h⌋] + (h - ⌊h⌋)(x[⌊h⌋+1] - x[⌊h⌋]).
/// @param sorted ascending, no NaN.  @param p in [0, 1].  @return NaN for no values.
double quantile(std::span<double const> sorted, double p);

}  // namespace slideway
