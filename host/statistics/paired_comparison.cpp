#include "host/statistics/paired_comparison.hpp"

#include <algorithm>
#include <cmath>

#include <boost/math/distributions/students_t.hpp>

#include "host/base/numbers.hpp"

namespace slideway {
namespace {

/// P(|T| >= t) of Student's t.
double two_sided_p(double freedom, double t) {
    return 2 * boost::math::cdf(boost::math::complement(boost::math::students_t(freedom), t));
}

double paired_t_p(Summary const& differences) {
    if (differences.count < 2 || !std::isfinite(differences.mean)) return nan;
    if (differences.mean == 0) return 1;
    if (differences.sd == 0) return 0;
    auto const n = static_cast<double>(differences.count);
    return two_sided_p(n - 1, std::abs(differences.mean) / (differences.sd / std::sqrt(n)));
}

/// n sup_x (F_a(x − slack) − F_b(x)) of two sorted samples of n values: how far a lies below b, whatever a shift explains.
std::size_t lead_of(std::vector<double> const& a, std::vector<double> const& b, double slack) {
    std::size_t j = 0, lead = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        // At a[i] + slack the shifted a has i + 1 values, and b as many as are not above.
        while (j < b.size() && b[j] <= a[i] + slack) ++j;
        if (i + 1 > j) lead = std::max(lead, i + 1 - j);
    }
    return lead;
}

}  // namespace

double welch_p(Summary const& first, Summary const& second) {
    if (first.count < 2 || second.count < 2 || !std::isfinite(first.mean + second.mean)) return nan;
    double const a = first.sd * first.sd / static_cast<double>(first.count), b = second.sd * second.sd / static_cast<double>(second.count);
    double const difference = std::abs(first.mean - second.mean);
    if (a + b == 0) return difference == 0 ? 1 : 0;
    double const freedom = (a + b) * (a + b) /
                           (a * a / static_cast<double>(first.count - 1) + b * b / static_cast<double>(second.count - 1));
    return two_sided_p(freedom, difference / std::sqrt(a + b));
}

double kolmogorov_smirnov_p(std::size_t n, std::size_t steps) {
    if (n == 0) return nan;
    if (steps == 0) return 1;
    double sum = 0;
    for (std::size_t j = 1; j * steps <= n; ++j) {
        // C(2n, n − m)/C(2n, n) = Π_{i=1..m} (n − m + i)/(n + i)
        std::size_t const m = j * steps;
        double ratio = 1;
        for (std::size_t i = 1; i <= m; ++i) ratio *= static_cast<double>(n - m + i) / static_cast<double>(n + i);
        sum += j % 2 == 1 ? ratio : -ratio;
    }
    return std::clamp(2 * sum, 0.0, 1.0);
}

PairedComparison compare_pairs(std::span<double const> first, std::span<double const> second, double slack, double level) {
    std::vector<double> a, b, differences;
    for (std::size_t i = 0; i < std::min(first.size(), second.size()); ++i) {
        if (std::isnan(first[i]) || std::isnan(second[i])) continue;
        a.push_back(first[i]);
        b.push_back(second[i]);
        differences.push_back(second[i] - first[i]);
    }
    Summary const of_difference = summarise(differences);
    PairedComparison result;
    result.pairs = differences.size();
    result.first = summarise(a).mean;
    result.second = summarise(b).mean;
    result.difference = of_difference.mean;
    result.interval = mean_interval(of_difference, level);
    result.p_mean = paired_t_p(of_difference);
    std::sort(a.begin(), a.end());
    std::sort(b.begin(), b.end());
    result.p_distribution = kolmogorov_smirnov_p(a.size(), std::max(lead_of(a, b, slack), lead_of(b, a, slack)));
    return result;
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
