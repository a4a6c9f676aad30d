// Summary statistics of plain numbers, and their intervals of confidence.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace slideway {

/// In the unit of what it bounds; a bound that cannot be given is NaN.
struct Interval {
    double low = std::numeric_limits<double>::quiet_NaN();
    double high = std::numeric_limits<double>::quiet_NaN();

    double half_width() const { return 0.5 * (high - low); }
};

/// A number and its interval.
struct Estimate {
    double value = std::numeric_limits<double>::quiet_NaN();
    Interval interval;
};

/// Of the numbers that are not NaN; all NaN when there are none.
struct Summary {
    std::size_t count = 0;    // numbers used
    std::size_t missing = 0;  // NaN
    double mean, sd;          // sd: with count - 1; NaN for a single number
    double min, median, max;
};

Summary summarise(std::span<double const> values);

/// Student's t of a mean of n numbers: half the width of its interval in standard errors.  @param n > 1  @param level in (0, 1)
double student_quantile(std::uint64_t n, double level);

/// Confidence interval of the mean of independent draws by Student's t: mean ± t(n-1, (1+level)/2) · sd/√n.
/// Source: Student (1908), The probable error of a mean, Biometrika 6.  Exact for normal draws; of skewed ones it
/// holds the mean less often than it says: of exponential draws 90 % with 10, 92 % with 20 and 95 % with 200 of them, of
/// lognormal ones with a skewness of 6 86 % with 20, 91 % with 100 and 94 % with 1,000 (95 % ones).
/// @param level in (0, 1).  @return in the unit of the values; NaN without a finite sd (fewer than two numbers).
Interval mean_interval(Summary const& summary, double level = 0.95);

/// Sample quantile by linear interpolation (type 7 of Hyndman and Fan 1996): with h = (n-1)p, the value is
/// x[⌊h⌋] + (h - ⌊h⌋)(x[⌊h⌋+1] - x[⌊h⌋]).
/// @param n numbers  @param p in [0, 1].  @param value_at of a rank from 0  @return NaN for no values.
template <class ValueAt> double quantile_of(std::uint64_t n, double p, ValueAt value_at) {
    if (n == 0) return std::numeric_limits<double>::quiet_NaN();
    double const h = static_cast<double>(n - 1) * p;
    auto const below = std::min(static_cast<std::uint64_t>(h), n - 1);
    double const fraction = h - static_cast<double>(below), low = value_at(below);
    // Without a fraction the neighbour does not count: it may be infinite, or beyond the end.
    if (!(fraction > 0) || below + 1 == n) return low;
    return low + fraction * (value_at(below + 1) - low);
}
/// @param sorted ascending, no NaN.
double quantile(std::span<double const> sorted, double p);

/// Share of members with a property: successes / trials, NaN without trials.
struct Proportion : Estimate { std::uint64_t successes = 0, trials = 0; };

/// Score interval of a proportion p̂ = k/n of independent trials: the p with |p̂ - p| <= z √(p(1-p)/n), that is
/// (p̂ + z²/2n ± z √(p̂(1-p̂)/n + z²/4n²)) / (1 + z²/n), z the (1+level)/2 quantile of the normal distribution.  Its
/// lower bound is 0 for k = 0 and its upper one 1 for k = n, both exactly.  It holds p in `level` of the studies on average over p,
/// and
/// within 2 % of it where n p and n (1-p) are 10 or more; nearer to 0 and 1 the share goes up and down, of 95 % ones between
/// 91 and 99 % in our studies and to 84 % at worst (k = 1; Agresti and Coull 1998, American Statistician 52, 119).
/// Source: Wilson (1927), Probable inference, the law of succession, and statistical inference, JASA 22, 209.
/// @param successes k <= trials n.  @param level in (0, 1).  @return [0, 1] as interval without trials.
Proportion proportion(std::uint64_t successes, std::uint64_t trials, double level = 0.95);

/// Sample quantile, type 7, of a probability p.
struct QuantileEstimate : Estimate { double p; };

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

// Counts of a sample in equal bins.

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

/// What the rule goes by.
struct HistogramRange {
    double least, largest;      // finite
    double quartiles[2];        // lower, upper
    std::uint64_t numbers = 0;  // finite ones, > 0
};
/// The edges of its bins.
std::vector<double> histogram_edges(HistogramRange const& range);

}  // namespace slideway
