#include "host/statistics/quantile_interval.hpp"

#include <algorithm>
#include <ranges>

#include <boost/math/distributions/binomial.hpp>

#include "host/statistics/summary.hpp"

namespace slideway {
RankInterval quantile_ranks(std::uint64_t n, double p, double level) {
    double const tail = 0.5 * (1 - level);
    boost::math::binomial const below(static_cast<double>(n), p);
    // k is the number of draws below: r is one more than the largest k of P(B <= k) <= tail.
    auto const numbers = std::views::iota(std::uint64_t{0}, n + 1);
    auto const r = std::ranges::partition_point(numbers, [&](std::uint64_t k) { return boost::math::cdf(below, static_cast<double>(k)) <= tail; });
    auto const s = std::ranges::partition_point(numbers, [&](std::uint64_t k) {
        return k == 0 || boost::math::cdf(boost::math::complement(below, static_cast<double>(k - 1))) > tail;  // P(B >= 0) = 1
    });
    return {static_cast<std::uint64_t>(r - numbers.begin()), static_cast<std::uint64_t>(s - numbers.begin())};
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
