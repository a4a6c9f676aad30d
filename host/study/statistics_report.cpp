#include "host/study/tolerance_report.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "host/base/error.hpp"
#include "host/study/tolerance_policy.hpp"

namespace slideway {
namespace {

ColumnStatistics statistics_of(ColumnAccumulator const& values, QuantityColumn const& column, bool random) {
    ColumnStatistics result{column, values.summary(), {}, {}, values.histogram()};
    if (random) result.mean = mean_interval(result.summary, confidence_level);
    for (double const p : reported_quantiles) {
        result.quantiles.push_back(
            {p, values.quantile(p), random ? values.quantile_interval(p, confidence_level) : Interval()});
    }
    return result;
}

std::vector<StatusCount> count_statuses(BlockStatistics const& statistics) {
    std::vector<StatusCount> occurring;
    for (int i = 0; i < status_count; ++i) {
        auto const status = static_cast<Status>(i);
        if (statistics.ended(status) > 0) occurring.push_back({status, statistics.ended(status)});
    }
    return occurring;
}

}  // namespace

ToleranceReport statistics_report(BlockStatistics const& statistics, std::uint64_t left, Scene const& scene,
                                  std::string const& path) {
    std::vector<QuantityColumn> const columns = report_columns(scene.quantities);
    if (columns.size() != statistics.columns().size() || scene.limits.size() != statistics.met().size()) {
        throw FileError(fmt::format(
            "{}: its statistics are of {} columns and {} limits, and the scene has {} and {}; give the "
            "scene of this result",
            path, statistics.columns().size(), statistics.met().size(), columns.size(), scene.limits.size()));
    }
    ToleranceReport report;
    report.design = scene.design.kind;
    report.policy =
        policy_of(report.design) + " Members are not stored, so there are no correlations with what varies.";
    report.intervals = intervals_of(report.design, left == 0);
    report.quantile_error = "relative error of at most 2^-10 of a member of that rank";
    static_assert(QuantileSketch::error == 0x1p-10);
    std::uint64_t const ran = statistics.members().count();
    report.statuses = report.draws = count_statuses(statistics);
    if (left > 0) report.statuses.push_back({Status::not_run, left});
    bool const random = is_random(report.design) && left == 0;
    for (std::size_t i = 0; i < columns.size(); ++i) {
        report.columns.push_back(statistics_of(statistics.columns()[i], columns[i], random));
    }
    for (std::size_t i = 0; i < scene.limits.size(); ++i) {
        Limit const& limit = scene.limits[i];
        auto const column = std::find_if(columns.begin(), columns.end(), [&](QuantityColumn const& candidate) {
            return candidate.quantity == limit.quantity && candidate.label == limit.label;
        });
        if (column == columns.end()) refuse_limit(limit, path);
        report.limits.push_back({limit, column->unit, yield_of(statistics.met()[i], ran, random)});
    }
    if (!scene.limits.empty()) report.all_met = yield_of(statistics.all_met(), ran, random);
    return report;
}

}  // namespace slideway
