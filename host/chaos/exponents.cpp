#include "host/chaos/exponents.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <boost/math/distributions/students_t.hpp>

namespace slideway {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

std::size_t whole_records(std::span<double const> growths, std::size_t k) {
    auto const missing = std::find_if(growths.begin(), growths.end(), [](double g) { return std::isnan(g); });
    return static_cast<std::size_t>(missing - growths.begin()) / k;
}

double sum_of(std::span<double const> growths, std::size_t k, std::size_t j, std::size_t from, std::size_t to) {
    double sum = 0;
    for (std::size_t i = from; i < to; ++i) sum += growths[i * k + j];
    return sum;
}

/// Standard error of the mean of a record's growth, from batches.
double batch_error(std::span<double const> growths, std::size_t k, std::size_t j, std::size_t records) {
    if (records < 4) return nan;
    auto const root = static_cast<std::size_t>(std::sqrt(static_cast<double>(records)));
    std::size_t const batches = std::clamp<std::size_t>(root, 2, 32), length = records / batches;
    std::vector<double> means(batches);
    for (std::size_t b = 0; b < batches; ++b) {
        means[b] = sum_of(growths, k, j, b * length, (b + 1) * length) / static_cast<double>(length);
    }
    double mean = 0, squares = 0;
    for (double const m : means) mean += m / static_cast<double>(batches);
    for (double const m : means) squares += (m - mean) * (m - mean);
    return std::sqrt(squares / static_cast<double>(batches * (batches - 1)));
}

}  // namespace

FiniteTimeExponents finite_time_exponents(std::span<double const> growths, std::size_t k, double record) {
    std::size_t const records = whole_records(growths, k);
    FiniteTimeExponents exponents{std::vector<double>(k, nan), std::vector<double>(k, nan)};
    for (std::size_t j = 0; j < k && records > 0; ++j) {
        exponents.values[j] = sum_of(growths, k, j, 0, records) / (static_cast<double>(records) * record);
        exponents.errors[j] = batch_error(growths, k, j, records) / record;
    }
    return exponents;
}

std::vector<double> exponent_history(std::span<double const> growths, std::size_t k, double record,
                                     std::span<std::size_t const> after) {
    std::size_t const records = whole_records(growths, k);
    std::vector<double> history(after.size() * k, nan);
    std::vector<double> sums(k, 0.0);
    std::size_t summed = 0;
    for (std::size_t n = 0; n < after.size(); ++n) {
        if (after[n] > records || after[n] == 0) continue;
        for (; summed < after[n]; ++summed) {
            for (std::size_t j = 0; j < k; ++j) sums[j] += growths[summed * k + j];
        }
        for (std::size_t j = 0; j < k; ++j) history[n * k + j] = sums[j] / (static_cast<double>(summed) * record);
    }
    return history;
}

double kaplan_yorke_dimension(std::span<double const> exponents) {
    double sum = 0;
    for (std::size_t j = 0; j < exponents.size(); ++j) {
        if (std::isnan(exponents[j])) return nan;
        if (sum + exponents[j] < 0) return static_cast<double>(j) + sum / std::abs(exponents[j]);
        sum += exponents[j];
    }
    return nan;
}

double student_quantile(double degrees) {
    return boost::math::quantile(boost::math::students_t(degrees), 0.975);
}

MeanInterval mean_interval(std::span<double const> values) {
    MeanInterval interval{0, nan, nan};
    double sum = 0;
    for (double const x : values) {
        if (!std::isnan(x)) sum += x, ++interval.count;
    }
    if (interval.count == 0) return interval;
    auto const n = static_cast<double>(interval.count);
    interval.mean = sum / n;
    if (interval.count < 2) return interval;
    double squares = 0;
    for (double const x : values) {
        if (!std::isnan(x)) squares += (x - interval.mean) * (x - interval.mean);
    }
    interval.half_width = student_quantile(n - 1) * std::sqrt(squares / (n * (n - 1)));
    return interval;
}

}  // namespace slideway
