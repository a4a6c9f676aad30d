// Whether two runs of the same members tell the same story.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "host/statistics/summary.hpp"

namespace slideway {

/// The same quantity of the same members twice, in the quantity's unit; pairs with a NaN are left out.
struct PairedComparison {
    std::size_t pairs = 0;
    double first, second;  // means
    double difference;     // second − first, mean over the pairs
    Interval interval;     // of the difference, by Student's t
    /// P of a mean difference as large, if there were none: paired t-test (Student 1908).  1 where all pairs are equal, 0 where all differ by
    /// the same; NaN of fewer than two pairs.
    double p_mean;
    /// P of distributions as far apart, if they were one: two-sample Kolmogorov–Smirnov test, of what a shift by `slack` does not explain.
    /// Pairs that go together make it larger than it is.  NaN without pairs.
    double p_distribution;
};

/// @param first, second of the same length, one entry per member  @param slack difference of values that is of no interest, >= 0
PairedComparison compare_pairs(std::span<double const> first, std::span<double const> second, double slack = 0, double level = 0.95);

/// P of means as far apart as these, of independent draws with spreads of their own: Welch's t-test (Welch 1947).  NaN where either has fewer
/// than two numbers; 1 where both are one and the same number.
double welch_p(Summary const& first, Summary const& second);

/// P(D >= d) of the two-sample Kolmogorov–Smirnov statistic of two samples of n values each from one continuous distribution, exact:
/// 2 Σ_j (−1)^(j+1) C(2n, n − jk)/C(2n, n), k = n d (Gnedenko and Korolyuk 1951).
/// @param steps k, a whole number in [0, n]
double kolmogorov_smirnov_p(std::size_t n, std::size_t steps);

/// Adjusted p-values of several tests at once (Holm 1979): those below α keep the chance of any false alarm among all below α.
/// @param p may hold NaN, tests that were not made, which stay NaN and do not count
std::vector<double> holm_adjusted(std::span<double const> p);

}  // namespace slideway
