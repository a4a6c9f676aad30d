#include "host/chaos/zero_one_test.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/base/numbers.hpp"
#include "host/statistics/correlation.hpp"

namespace slideway {
namespace {

std::vector<double> thinned(std::span<double const> series, ZeroOneOptions const& options) {
    std::vector<double> out;
    std::size_t const stride = std::max<std::size_t>(options.stride, 1);
    for (std::size_t i = 0; i < series.size() && out.size() < options.max_points; i += stride) out.push_back(series[i]);
    return out;
}

/// False for a constant or for numbers that are not finite.
bool remove_mean(std::vector<double>& series) {
    auto const n = static_cast<double>(series.size());
    auto const [low, high] = std::minmax_element(series.begin(), series.end());
    bool const varies = *low < *high;
    double mean = 0, size = 0;
    for (double const x : series) mean += x / n;
    for (double& x : series) size += std::abs(x -= mean);
    return varies && std::isfinite(size);
}

double growth_rate(std::vector<double> const& series, double c) {
    std::size_t const n = series.size(), longest = n / 10;
    std::vector<double> p(n), q(n);
    double sum_p = 0, sum_q = 0;
    for (std::size_t j = 0; j < n; ++j) {
        double const angle = static_cast<double>(j + 1) * c;
        p[j] = sum_p += series[j] * std::cos(angle);
        q[j] = sum_q += series[j] * std::sin(angle);
    }
    // n inside: sums side by side need no reordering to fill vector registers.
    std::vector<double> displacement(longest, 0.0), lag(longest);
    for (std::size_t j = 0; j + longest < n; ++j) {
        double const p0 = p[j], q0 = q[j];
        for (std::size_t k = 0; k < longest; ++k) {
            double const dp = p[j + 1 + k] - p0, dq = q[j + 1 + k] - q0;
            displacement[k] += dp * dp + dq * dq;
        }
    }
    for (std::size_t k = 0; k < longest; ++k) lag[k] = static_cast<double>(k + 1);
    return product_moment(lag, displacement);
}

double median(std::vector<double> values) {
    std::erase_if(values, [](double x) { return std::isnan(x); });
    if (values.empty()) return nan;
    std::sort(values.begin(), values.end());
    std::size_t const half = values.size() / 2;
    return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

}  // namespace

ZeroOneTest zero_one_test(std::span<double const> series, ZeroOneOptions const& options) {
    std::vector<double> used = thinned(series, options);
    ZeroOneTest test{nan, {}, used.size()};
    if (used.size() < fewest_for_zero_one || !remove_mean(used)) return test;
    for (std::size_t i = 1; i <= options.frequencies; ++i) {
        double const turns = static_cast<double>(i) / std::numbers::phi;
        double const c = std::numbers::pi * (0.2 + 0.6 * (turns - std::floor(turns)));
        test.k_c.push_back(growth_rate(used, c));
    }
    test.k = median(test.k_c);
    return test;
}

std::size_t zero_one_stride(double period) {
    return std::isfinite(period) && period >= 8 ? static_cast<std::size_t>(period / 4) : 1;
}

}  // namespace slideway
