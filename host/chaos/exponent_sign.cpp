#include "host/chaos/exponent_sign.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace slideway {
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
