#include "host/statistics/error_bound.hpp"

#include <algorithm>
#include <cmath>

#include <boost/math/distributions/students_t.hpp>

#include "host/base/numbers.hpp"
#include "host/statistics/summary.hpp"

namespace slideway {
namespace {

constexpr double missed = 0.05;  // chance to see nothing of what is bounded

double paired_t_p(Summary const& differences, double grain) {
    if (differences.count < 2 || !std::isfinite(differences.mean)) return nan;
    if (differences.mean == 0) return 1;
    double const sd = std::max(differences.sd, grain / std::sqrt(12.0));
    if (sd == 0) return 0;
    auto const n = static_cast<double>(differences.count);
    double const t = std::abs(differences.mean) / (sd / std::sqrt(n));
    return 2 * boost::math::cdf(boost::math::complement(boost::math::students_t(n - 1), t));
}

}  // namespace

double unseen_share(std::size_t drawn, std::uint64_t members) {
    if (drawn == 0) return 1;
    auto const n = static_cast<double>(drawn), all = static_cast<double>(members);
    double const differing = (all - 0.5 * (n - 1)) * (1 - std::pow(missed, 1 / n));
    return std::min(differing, all - n) / all;
}

ErrorBound error_bound(std::span<double const> differences, std::uint64_t members, double spread, double grain) {
    Summary const summary = summarise(differences);
    ErrorBound bound;
    bound.pairs = summary.count;
    bound.difference = summary.count > 0 ? summary.mean : nan;
    bound.half_width = summary.count == 1 && members == 1 ? 0 : mean_interval(summary).half_width();
    bound.unseen = unseen_share(summary.count, members) * (members == 1 ? 0 : spread);
    // At 95 % one in forty of the errors just above a bound would hide below it.
    double const reach = bound.half_width == 0 ? 0 : mean_interval(summary, 0.99).half_width();
    double const seen = std::abs(bound.difference) + reach;
    bound.bound = std::isnan(seen + bound.unseen) ? nan : std::max(seen, bound.unseen);
    bound.p = paired_t_p(summary, grain);
    return bound;
}

std::vector<double> holm_adjusted(std::span<double const> p) {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < p.size(); ++i) {
        if (!std::isnan(p[i])) order.push_back(i);
    }
    std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return p[i] < p[j]; });
    std::vector<double> adjusted(p.size(), nan);
    double least = 0;
    for (std::size_t rank = 0; rank < order.size(); ++rank) {
        least = std::max(least, std::min(1.0, static_cast<double>(order.size() - rank) * p[order[rank]]));
        adjusted[order[rank]] = least;
    }
    return adjusted;
}

}  // namespace slideway
