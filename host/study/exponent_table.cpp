#include "host/study/exponent_table.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string_view>
#include <utility>

namespace slideway {
namespace {

constexpr std::size_t from_exponents = 2;  // fewer tell no dimension
constexpr double rounding = 1e-15;  // of an offset, in the scales of the joint: the positions' last bits
constexpr double not_there = std::numeric_limits<double>::quiet_NaN();

/// The offsets by their exponents, the largest first: QR sorts them only in the limit.  As they stand where one has none.
std::vector<std::size_t> ranking(std::vector<double> const& exponents) {
    std::vector<std::size_t> order(exponents.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    if (std::any_of(exponents.begin(), exponents.end(), [](double value) { return std::isnan(value); })) return order;
    std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return exponents[a] > exponents[b]; });
    return order;
}

std::vector<double> arranged(std::vector<double> const& values, std::vector<std::size_t> const& order) {
    std::vector<double> result;
    for (std::size_t const j : order) result.push_back(values[j]);
    return result;
}

/// Where `running_mean` has its points.
std::vector<std::size_t> history_records(std::size_t records, std::size_t points) {
    std::size_t const count = std::min(records, points);
    std::vector<std::size_t> after;
    for (std::size_t i = 1; i <= count; ++i) after.push_back(i * records / count);
    return after;
}

}  // namespace

ExponentTable::ExponentTable(Scene const& scene)
    : schedule_(orbit_schedule(scene)), exponents_(static_cast<std::size_t>(shadow_plan(scene).count)), d0_(scene.chaos.d0) {
    if (exponents_ == 0) return;
    history_ = history_records(schedule_.stops.growths(), scene.chaos.history);
    StudyAxis exponent{"exponent", "1", "number of the exponent, the largest first", {}};
    for (std::size_t j = 1; j <= exponents_; ++j) exponent.values.push_back(static_cast<double>(j));
    layout_.axes.push_back(exponent);
    auto const add = [this](std::string_view name, std::string_view unit, std::string_view long_name,
                            std::vector<std::string> axes = {}) {
        layout_.columns.push_back({std::string(name), std::string(unit), std::string(long_name), std::move(axes)});
    };
    std::vector<std::string> const along_exponents(1, exponent.name);
    add("lyapunov_exponent", "s-1", "finite-time Lyapunov exponents, by shadows", along_exponents);
    add("lyapunov_exponent_error", "s-1", "standard error of the exponent, by batch means", along_exponents);
    add("lyapunov_time", "s", "time over which the exponents are taken, after the transient");
    add("lyapunov_resolution", "s-1", "rounding of the offsets: a smaller exponent is none");
    add("lost_offsets", "1", "times that an offset had shrunk into rounding: then exponents are upper bounds");
    if (exponents_ >= from_exponents) {
        add("kaplan_yorke_dimension", "1",
            "Kaplan-Yorke dimension of the section at a crank angle; one more for the flow");
    }
    if (history_.empty()) return;
    StudyAxis history{"history", "1", "rescalings after the transient", {}};
    for (std::size_t const records : history_) {
        history.values.push_back(static_cast<double>(records * schedule_.stops.growth_every));
    }
    layout_.axes.push_back(history);
    add("lyapunov_history", "s-1", "running exponents after so many rescalings", {history.name, exponent.name});
}

StudyValues ExponentTable::values(BlockResult const& block) const {
    StudyValues columns(layout_.columns.size());
    if (exponents_ == 0) return columns;
    std::size_t const records = schedule_.stops.growths(), per_member = records * exponents_;
    auto const append = [](std::vector<double>& column, std::vector<double> const& row) {
        column.insert(column.end(), row.begin(), row.end());
    };
    for (std::size_t i = 0; i < block.records.size(); ++i) {
        double const spacing = schedule_.timing(block.inputs[i]).period;
        GrowthLog const log{block.growths.subspan(i * per_member, per_member), exponents_,
                            spacing * static_cast<double>(schedule_.stops.growth_every)};
        Exponents const exponents = exponents_of(log);
        auto const order = ranking(exponents.value);
        auto const values = arranged(exponents.value, order);
        append(columns[0], values);
        append(columns[1], arranged(exponents.standard_error, order));
        columns[2].push_back(log.length * static_cast<double>(log.intervals()));
        columns[3].push_back(rounding / (d0_ * spacing));
        columns[4].push_back(static_cast<double>(block.records[i].lost_offsets));
        if (exponents_ >= from_exponents) columns[5].push_back(kaplan_yorke_dimension(values));
        if (!history_.empty()) append(columns.back(), history_of(log, order));
    }
    return columns;
}

std::vector<double> ExponentTable::history_of(GrowthLog const& log, std::vector<std::size_t> const& order) const {
    std::vector<double> history(history_.size() * exponents_, not_there);
    if (log.intervals() != schedule_.stops.growths()) return history;
    for (std::size_t j = 0; j < exponents_; ++j) {
        RunningMean const mean = running_mean(log, order[j], history_.size());
        for (std::size_t n = 0; n < history_.size(); ++n) history[n * exponents_ + j] = mean.value[n];
    }
    return history;
}

}  // namespace slideway
