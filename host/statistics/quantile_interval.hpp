// Quantiles of a sample with intervals that assume no distribution.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "host/statistics/summary.hpp"

namespace slideway {

struct QuantileEstimate {
    double p;      // probability
    double value;  // sample quantile, type 7
    Interval interval;
};

/// Ranks, from 1, of two order statistics; 0 and n + 1 where there is none.
struct RankInterval {
    std::uint64_t low, high;
};

/// Confidence interval of the p-quantile of n independent draws by two of their order statistics.  The number of draws
/// below the quantile is B ~ Bin(n, p), so P(x(r) > q) = P(B <= r-1) and P(x(s) < q) = P(B >= s), both at most: the
/// lower bound is x(r) with the largest r of P(B <= r-1) <= (1-level)/2, the upper one x(s) with the smallest s of
/// P(B >= s) <= (1-level)/2.  It covers the quantile of any distribution with at least `level`;
/// ranks are whole, so 95 % ones have 95 to 98.5 % with 50 to 1,000 draws.
/// Source: Conover (1999), Practical Nonparametric Statistics, 3.2; Hahn and Meeker (1991), Statistical Intervals, 5.2.
/// @param n > 0 draws; or their values, sorted ascending, no NaN.  @param p, level in (0, 1).
/// @return r and s; or the interval in the unit of the values.  A bound for which n is too small (no such rank) is NaN.
RankInterval quantile_ranks(std::uint64_t n, double p, double level = 0.95);
Interval quantile_interval(std::span<double const> sorted, double p, double level = 0.95);
/// The same of values by their rank, from 0.
template <class ValueAt> Interval interval_of_ranks(std::uint64_t n, double p, double level, ValueAt value_at) {
    Interval interval;
    if (n == 0) return interval;
    auto const [low, high] = quantile_ranks(n, p, level);
    if (low >= 1) interval.low = value_at(low - 1);
    if (high <= n) interval.high = value_at(high - 1);
    return interval;
}

/// Sample quantiles with their intervals, one for each probability.
std::vector<QuantileEstimate> estimate_quantiles(std::span<double const> sorted, std::span<double const> probabilities,
                                                 double level = 0.95);

}  // namespace slideway
