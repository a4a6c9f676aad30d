#include "host/chaos/exponents.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "host/base/numbers.hpp"
#include "host/statistics/summary.hpp"

namespace slideway {
namespace {

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

constexpr std::size_t least_batches = 8;  // of fewer the spread is a guess
constexpr std::size_t most_batches = 16;  // more say little more of the spread, and are shorter than what growth remembers

std::size_t batch_size(GrowthLog const& log) {
    std::size_t const n = log.intervals();
    auto const root = static_cast<std::size_t>(std::sqrt(static_cast<double>(n)));
    std::size_t const wanted = std::max(root, n / most_batches);
    if (log.period == 0 || n / log.period < least_batches) return wanted;
    std::size_t const periods = std::max<std::size_t>(1, wanted / log.period);
    return periods * log.period;
}

/// Mean rates of the batches; empty with fewer than 4 intervals.
std::vector<double> batch_means(GrowthLog const& log, std::size_t offset) {
    std::vector<double> means;
    std::size_t const n = log.intervals();
    if (n < 4) return means;
    std::size_t const size = batch_size(log), batches = n / size, first = n - batches * size;
    for (std::size_t b = 0; b < batches; ++b) {
        std::size_t const from = first + b * size;
        means.push_back(sum_of(log, offset, from, from + size) / (static_cast<double>(size) * log.length));
    }
    return means;
}

double rate_from(GrowthLog const& log, std::size_t offset, std::size_t first, std::size_t last) {
    if (last <= first) return nan;
    return sum_of(log, offset, first, last) / (static_cast<double>(last - first) * log.length);
}

}  // namespace

std::size_t GrowthLog::intervals() const {
    auto const missing = std::ranges::find_if(values, [](double x) { return std::isnan(x); });
    return static_cast<std::size_t>(missing - values.begin()) / count;
}

std::vector<double> largest_first(std::span<double const> values, std::size_t count) {
    GrowthLog const log{values, count};
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t j = 0; j < count; ++j) order.emplace_back(-sum_of(log, j, 0, log.intervals()), j);
    std::ranges::sort(order);
    std::vector<double> sorted;
    for (std::size_t i = 0; i < values.size(); ++i) sorted.push_back(values[i - i % count + order[i % count].second]);
    return sorted;
}

Exponents exponents_of(GrowthLog const& log) {
    std::size_t const n = log.intervals();
    Exponents exponents;
    for (std::size_t j = 0; j < log.count; ++j) {
        auto const means = batch_means(log, j);
        double const error = means.size() < 2 ? nan : error_of_mean(means);
        bool const enough = means.size() >= least_batches;
        exponents.value.push_back(rate_from(log, j, 0, n));
        exponents.standard_error.push_back(error);
        exponents.half_width.push_back(enough ? student_quantile(means.size(), 0.95) * error : nan);
        exponents.late.push_back(n < 2 ? nan : rate_from(log, j, n / 2, n));
    }
    return exponents;
}

std::vector<double> running_exponents(GrowthLog const& log, std::size_t offset, std::span<std::size_t const> after) {
    std::size_t const there = log.intervals();
    std::vector<double> exponents;
    double sum = 0;
    std::size_t done = 0;
    for (std::size_t const n : after) {
        sum += sum_of(log, offset, done, std::min(n, there));
        done = std::min(n, there);
        exponents.push_back(n == 0 || n > there ? nan : sum / (static_cast<double>(n) * log.length));
    }
    return exponents;
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
    result.half_width = student_quantile(numbers.size(), confidence) * error_of_mean(numbers);
    return result;
}

namespace {

template <class Of> std::vector<double> numbers_of(std::span<ExponentRecord const> records, Of of) {
    std::vector<double> numbers;
    for (ExponentRecord const& record : records) numbers.push_back(of(record));
    return numbers;
}

/// Of the mean, by the growth of the members' second halves.
ExponentSign sign_of_mean(std::span<ExponentRecord const> records, MeanOfMembers const& rate, double resolution) {
    MeanOfMembers const late = mean_of_members(numbers_of(records, [](auto const& r) { return r.late_growth(); }));
    MeanOfMembers const own = mean_of_members(numbers_of(records, [](auto const& r) { return r.late_half_width(); }));
    MeanOfMembers const time = mean_of_members(numbers_of(records, [](auto const& r) { return r.time; }));
    double const swing = own.mean / std::sqrt(static_cast<double>(own.count));  // NaN where no record has an interval
    double const half_width = std::fmax(late.half_width, swing) + 0.5 * resolution * time.mean;
    return exponent_sign(rate.mean, rate.half_width, late.mean, std::isnan(late.half_width) ? late.half_width : half_width);
}

}  // namespace

ExponentSign exponent_sign(double rate, double half_width, double late, double late_half_width) {
    if (!(std::abs(rate) > half_width)) return ExponentSign::undecided;
    double const onwards = rate > 0 ? late : -late;
    if (std::isnan(onwards - late_half_width)) return ExponentSign::undecided;
    if (!(onwards - late_half_width > most_growth_of_a_power)) return ExponentSign::power_of_time;
    return rate > 0 ? ExponentSign::above_zero : ExponentSign::below_zero;
}

ExponentSign sign_of(ExponentRecord const& record) {
    return exponent_sign(record.rate, record.half_width, record.late_growth(), record.late_half_width());
}

ExponentOfMembers exponent_of_members(std::span<ExponentRecord const> records, double resolution) {
    ExponentOfMembers result{};
    result.mean = mean_of_members(numbers_of(records, [](auto const& r) { return r.rate; }));
    result.late = mean_of_members(numbers_of(records, [](auto const& r) { return r.late; }));
    if (result.mean.count > 1) {
        result.mean.half_width = std::max(result.mean.half_width, std::abs(result.mean.mean - result.late.mean));
    }
    result.mean.half_width += resolution;
    result.late.half_width += resolution;
    for (ExponentRecord const& record : records) {
        ExponentSign const sign = sign_of(record);
        result.above += sign == ExponentSign::above_zero;
        result.below += sign == ExponentSign::below_zero;
        result.power_of_time += sign == ExponentSign::power_of_time;
    }
    result.undecided = records.size() - result.above - result.below;
    result.sign = records.size() == 1 ? sign_of(records.front()) : sign_of_mean(records, result.mean, resolution);
    if (result.sign == ExponentSign::power_of_time) result.mean.half_width = std::max(result.mean.half_width, std::abs(result.mean.mean));
    return result;
}

}  // namespace slideway
