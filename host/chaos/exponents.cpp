#include "host/chaos/exponents.hpp"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>

namespace slideway {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

double sum_of(GrowthLog const& log, std::size_t offset, std::size_t first, std::size_t last) {
    double sum = 0;
    for (std::size_t i = first; i < last; ++i) sum += log.at(i, offset);
    return sum;
}

/// s/√n of numbers, n >= 2.
double error_of_mean(std::span<double const> numbers) {
    auto const n = static_cast<double>(numbers.size());
    double mean = 0, squares = 0;
    for (double const x : numbers) mean += x / n;
    for (double const x : numbers) squares += (x - mean) * (x - mean);
    return std::sqrt(squares / (n * (n - 1)));
}

double error_by_batches(GrowthLog const& log, std::size_t offset) {
    std::size_t const n = log.intervals();
    if (n < 4) return nan;
    auto const size = static_cast<std::size_t>(std::sqrt(static_cast<double>(n)));
    std::size_t const batches = n / size, first = n - batches * size;
    std::vector<double> means;
    for (std::size_t b = 0; b < batches; ++b) {
        std::size_t const from = first + b * size;
        means.push_back(sum_of(log, offset, from, from + size) / (static_cast<double>(size) * log.length));
    }
    return error_of_mean(means);
}

}  // namespace

std::size_t GrowthLog::intervals() const {
    auto const missing = std::ranges::find_if(values, [](double x) { return std::isnan(x); });
    return static_cast<std::size_t>(missing - values.begin()) / count;
}

Exponents exponents_of(GrowthLog const& log) {
    std::size_t const n = log.intervals();
    Exponents exponents;
    for (std::size_t j = 0; j < log.count; ++j) {
        double const time = static_cast<double>(n) * log.length;
        exponents.value.push_back(n > 0 ? sum_of(log, j, 0, n) / time : nan);
        exponents.standard_error.push_back(error_by_batches(log, j));
    }
    return exponents;
}

RunningMean running_mean(GrowthLog const& log, std::size_t offset, std::size_t points) {
    std::size_t const n = log.intervals();
    points = std::min(points, n);
    RunningMean history;
    double sum = 0;
    std::size_t done = 0;
    for (std::size_t p = 1; p <= points; ++p) {
        std::size_t const until = n * p / points;
        sum += sum_of(log, offset, done, until);
        done = until;
        history.time.push_back(static_cast<double>(done) * log.length);
        history.value.push_back(sum / history.time.back());
    }
    return history;
}

double kaplan_yorke_dimension(std::span<double const> exponents) {
    if (exponents.empty() || std::ranges::any_of(exponents, [](double x) { return std::isnan(x); })) return nan;
    double sum = 0;
    for (std::size_t k = 0; k < exponents.size(); ++k) {
        double const next = sum + exponents[k];
        if (next < 0) return static_cast<double>(k) + sum / -exponents[k];
        sum = next;
    }
    return static_cast<double>(exponents.size());
}

MeanOfMembers mean_of_members(std::span<double const> values, double confidence) {
    std::vector<double> numbers;
    std::ranges::copy_if(values, std::back_inserter(numbers), [](double x) { return !std::isnan(x); });
    MeanOfMembers result{numbers.size(), nan, nan};
    if (numbers.empty()) return result;
    auto const n = static_cast<double>(numbers.size());
    result.mean = 0;
    for (double const x : numbers) result.mean += x / n;
    if (numbers.size() < 2) return result;
    boost::math::students_t const distribution(n - 1);
    result.half_width = boost::math::quantile(distribution, 0.5 + 0.5 * confidence) * error_of_mean(numbers);
    return result;
}

}  // namespace slideway
