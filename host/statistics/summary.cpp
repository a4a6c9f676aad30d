#include "host/statistics/summary.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <boost/iterator/counting_iterator.hpp>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/students_t.hpp>

#include "host/base/numbers.hpp"
#include "host/sampling/distribution.hpp"

namespace slideway {
namespace {

/// The least number up to `end` for which it does not hold, where it holds for all below that and for none above; `end` if there is none.
template <class Condition> std::uint64_t first_without(std::uint64_t end, Condition const& holds) {
    using Number = boost::counting_iterator<std::uint64_t>;
    return *std::partition_point(Number(0), Number(end), holds);
}

}  // namespace

double quantile(std::span<double const> sorted, double p) {
    return quantile_of(sorted.size(), p, [&](std::uint64_t rank) { return sorted[rank]; });
}

Summary summarise(std::span<double const> values) {
    std::vector<double> sorted;
    sorted.reserve(values.size());
    std::copy_if(values.begin(), values.end(), std::back_inserter(sorted), [](double x) { return !std::isnan(x); });
    Summary summary{sorted.size(), values.size() - sorted.size(), nan, nan, nan, nan, nan};
    if (sorted.empty()) return summary;
    std::sort(sorted.begin(), sorted.end());

    auto const n = static_cast<double>(sorted.size());
    double sum = 0;
    for (double const x : sorted) sum += x;
    double const mean = sum / n;
    // Second pass: the residual sum removes the rounding of the first from the mean and from the spread.
    double residual = 0, squares = 0;
    for (double const x : sorted) {
        residual += x - mean;
        squares += (x - mean) * (x - mean);
    }
    summary.mean = std::isfinite(mean) ? mean + residual / n : mean;
    if (sorted.size() > 1) summary.sd = std::sqrt(std::max(0.0, squares - residual * residual / n) / (n - 1));
    if (!std::isfinite(mean)) summary.sd = nan;
    summary.min = sorted.front();
    summary.median = quantile(sorted, 0.5);
    summary.max = sorted.back();
    return summary;
}

double student_quantile(std::uint64_t n, double level) {
    return boost::math::quantile(boost::math::students_t(static_cast<double>(n) - 1), 0.5 + 0.5 * level);
}

Interval mean_interval(Summary const& summary, double level) {
    if (!std::isfinite(summary.sd)) return {};
    double const half = student_quantile(summary.count, level) * summary.sd / std::sqrt(static_cast<double>(summary.count));
    return {summary.mean - half, summary.mean + half};
}

Proportion proportion(std::uint64_t successes, std::uint64_t trials, double level) {
    Proportion result{{nan, {0, 1}}, successes, trials};
    if (trials == 0) return result;
    auto const n = static_cast<double>(trials);
    double const p = static_cast<double>(successes) / n;
    double const z = standard_normal_quantile(0.5 + 0.5 * level);
    double const scale = 1 / (1 + z * z / n);
    double const centre = (p + z * z / (2 * n)) * scale;
    double const half = z * scale * std::sqrt(p * (1 - p) / n + z * z / (4 * n * n));
    result.value = p;
    // At the ends the two terms cancel but for rounding.
    result.interval.low = successes == 0 ? 0 : std::max(0.0, centre - half);
    result.interval.high = successes == trials ? 1 : std::min(1.0, centre + half);
    return result;
}

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
        estimates.push_back({{quantile(sorted, p), quantile_interval(sorted, p, level)}, p});
    }
    return estimates;
}

namespace {

std::size_t bin_number(HistogramRange const& of) {
    // Halves: the range of doubles is not a double.
    double const range = 0.5 * of.largest - 0.5 * of.least;
    double const quartiles = 0.5 * of.quartiles[1] - 0.5 * of.quartiles[0];
    double const width = 2 * quartiles / std::cbrt(static_cast<double>(of.numbers));
    double const bins = std::ceil(range / width);
    return bins < static_cast<double>(most_bins) ? std::max<std::size_t>(1, static_cast<std::size_t>(bins)) : most_bins;
}

}  // namespace

std::vector<double> histogram_edges(HistogramRange const& range) {
    if (range.least == range.largest) return {range.least, range.largest};
    std::size_t const bins = bin_number(range);
    std::vector<double> edges;
    for (std::size_t i = 0; i <= bins; ++i) {
        double const share = static_cast<double>(i) / static_cast<double>(bins);
        edges.push_back((1 - share) * range.least + share * range.largest);
    }
    return edges;
}

Histogram histogram(std::span<double const> sorted) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    auto const first = std::upper_bound(sorted.begin(), sorted.end(), -infinity);
    auto const last = std::lower_bound(first, sorted.end(), infinity);
    Histogram result;
    result.below = static_cast<std::uint64_t>(first - sorted.begin());
    result.above = static_cast<std::uint64_t>(sorted.end() - last);
    std::span<double const> const finite(first, last);
    if (finite.empty()) return result;
    result.edges = histogram_edges(
        {finite.front(), finite.back(), {quantile(finite, 0.25), quantile(finite, 0.75)}, finite.size()});
    std::size_t const bins = result.edges.size() - 1;
    // The numbers are sorted, so the edges cut them.
    auto from = finite.begin();
    for (std::size_t i = 0; i < bins; ++i) {
        auto const to = i + 1 == bins ? finite.end() : std::lower_bound(from, finite.end(), result.edges[i + 1]);
        result.counts.push_back(static_cast<std::uint64_t>(to - from));
        from = to;
    }
    return result;
}

}  // namespace slideway
