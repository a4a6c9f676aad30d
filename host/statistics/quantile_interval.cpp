#include "host/statistics/quantile_interval.hpp"

#include <boost/math/distributions/binomial.hpp>

#include "host/statistics/summary.hpp"

namespace slideway {
namespace {

/// The least number up to `end` for which it does not hold, where it holds for all below that and for none above; `end` if there is none.
template <class Condition> std::uint64_t first_without(std::uint64_t end, Condition const& holds) {
    std::uint64_t least = 0;
    while (least < end) {
        std::uint64_t const middle = least + (end - least) / 2;
        if (holds(middle))
            least = middle + 1;
        else
            end = middle;
    }
    return least;
}

}  // namespace

RankInterval quantile_ranks(std::uint64_t n, double p, double level) {
    double const tail = 0.5 * (1 - level);
    boost::math::binomial const below(static_cast<double>(n), p);
    // k is the number of draws below: r is one more than the largest k of P(B <= k) <= tail.
    std::uint64_t const r = first_without(n + 1, [&](std::uint64_t k) { return boost::math::cdf(below, static_cast<double>(k)) <= tail; });
    std::uint64_t const s = first_without(n + 1, [&](std::uint64_t k) {
        return k == 0 || boost::math::cdf(boost::math::complement(below, static_cast<double>(k - 1))) > tail;  // P(B >= 0) = 1
    });
    return {r, s};
}

Interval quantile_interval(std::span<double const> sorted, double p, double level) {
    return interval_of_ranks(sorted.size(), p, level, [&](std::uint64_t rank) { return sorted[rank]; });
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
