#include "host/statistics/histogram.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/statistics/summary.hpp"

namespace slideway {
namespace {

std::size_t bin_number(std::span<double const> finite) {
    // Halves: the range of doubles is not a double.
    double const range = 0.5 * finite.back() - 0.5 * finite.front();
    double const quartiles = 0.5 * quantile(finite, 0.75) - 0.5 * quantile(finite, 0.25);
    double const width = 2 * quartiles / std::cbrt(static_cast<double>(finite.size()));
    double const bins = std::ceil(range / width);
    return bins < static_cast<double>(most_bins) ? std::max<std::size_t>(1, static_cast<std::size_t>(bins)) : most_bins;
}

}  // namespace

Histogram histogram(std::span<double const> sorted) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    auto const first = std::upper_bound(sorted.begin(), sorted.end(), -infinity);
    auto const last = std::lower_bound(first, sorted.end(), infinity);
    Histogram result;
    result.below = static_cast<std::uint64_t>(first - sorted.begin());
    result.above = static_cast<std::uint64_t>(sorted.end() - last);
    std::span<double const> const finite(first, last);
    if (finite.empty()) return result;
    if (finite.front() == finite.back()) {
        result.edges = {finite.front(), finite.front()};
        result.counts = {finite.size()};
        return result;
    }
    std::size_t const bins = bin_number(finite);
    for (std::size_t i = 0; i <= bins; ++i) {
        double const share = static_cast<double>(i) / static_cast<double>(bins);
        result.edges.push_back((1 - share) * finite.front() + share * finite.back());
    }
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
