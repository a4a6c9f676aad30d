// Summary statistics of plain numbers.
#pragma once

#include <cstddef>
#include <span>

#include "host/statistics/interval.hpp"

namespace slideway {

/// Of the numbers that are not NaN; all NaN when there are none.
struct Summary {
    std::size_t count = 0;    // numbers used
    std::size_t missing = 0;  // NaN
    double mean, sd;          // sd: with count - 1; NaN for a single number
    double min, median, max;
};

Summary summarise(std::span<double const> values);

/// Confidence interval of the mean of independent draws by Student's t: mean ± t(n-1, (1+level)/2) · sd/√n.
/// Source: Student (1908), The probable error of a mean, Biometrika 6.  Exact for normal draws; of skewed ones it
/// holds the mean less often than it says: of exponential draws 90 % with 10, 92 % with 20 and 95 % with 200 of them, of
/// lognormal ones with a skewness of 6 86 % with 20, 91 % with 100 and 94 % with 1,000 (95 % ones).
/// @param level in (0, 1).  @return in the unit of the values; NaN without a finite sd (fewer than two numbers).
Interval mean_interval(Summary const& summary, double level = 0.95);

/// Sample quantile by linear interpolation (type 7 of Hyndman and Fan 1996): with h = (n-1)p, the value is
/// x[⌊h⌋] + (h - ⌊h⌋)(x[⌊h⌋+1] - x[⌊h⌋]).
/// @param sorted ascending, no NaN.  @param p in [0, 1].  @return NaN for no values.
double quantile(std::span<double const> sorted, double p);

}  // namespace slideway
