#include "host/statistics/quantile_interval.hpp"

#include <cstddef>

#include <boost/math/distributions/binomial.hpp>

#include "host/statistics/summary.hpp"

namespace slideway {
namespace {

/// The smallest k in [0, n] where `holds`, which stays true from there on; n + 1 where it never holds.
template <class Predicate> std::size_t first_where(std::size_t n, Predicate holds) {
    std::size_t low = 0, high = n + 1;
    while (low < high) {
        std::size_t const middle = low + (high - low) / 2;
        if (holds(middle)) {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    return low;
}

}  // namespace

Interval quantile_interval(std::span<double const> sorted, double p, double level) {
    Interval interval;
    if (sorted.empty()) return interval;
    std::size_t const n = sorted.size();
    double const tail = 0.5 * (1 - level);
    boost::math::binomial const below(static_cast<double>(n), p);
    // k is the number of draws below: r is one more than the largest k of P(B <= k) <= tail.
    std::size_t const r =
        first_where(n, [&](std::size_t k) { return boost::math::cdf(below, static_cast<double>(k)) > tail; });
    std::size_t const s = first_where(n, [&](std::size_t k) {
        if (k == 0) return false;  // P(B >= 0) = 1
        return boost::math::cdf(boost::math::complement(below, static_cast<double>(k - 1))) <= tail;
    });
    if (r >= 1) interval.low = sorted[r - 1];
    if (s <= n) interval.high = sorted[s - 1];
    return interval;
}

std::vector<QuantileEstimate> estimate_quantiles(std::span<double const> sorted, std::span<double const> probabilities,
                                                 double level) {
    std::vector<QuantileEstimate> estimates;
    for (double const p : probabilities) {
        estimates.push_back({p, quantile(sorted, p), quantile_interval(sorted, p, level)});
    }
    return estimates;
}

}  // namespace slideway
