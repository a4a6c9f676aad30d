#include "host/study/tolerance_report.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "host/base/error.hpp"
#include "host/store/statistics_merge.hpp"
#include "host/study/tolerance_members.hpp"
#include "host/study/tolerance_policy.hpp"
#include "host/study/tolerance_sensitivity.hpp"

namespace slideway {
namespace {

std::vector<QuantityColumn> quantity_columns_of(ResultView const& results) {
    Selection stored = 0;
    for (int q = 0; q < quantity_count; ++q) {
        if (results.has(quantity_table[q].name)) stored |= selection_of(static_cast<Quantity>(q));
    }
    std::vector<QuantityColumn> columns = report_columns(stored);
    for (QuantityColumn& column : columns) {
        column.unit = results.unit(column.quantity);
        column.long_name = results.long_name(column.quantity);
    }
    return columns;
}

ColumnStatistics statistics_of(ToleranceMembers const& members, QuantityColumn const& column, bool random) {
    ColumnStatistics result{column, {}, {}, {}, {}};
    std::vector<double> values = members.column(column.quantity, column.index);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < members.size(); ++i) {
        if (members.finished(i) && members.is_draw(i)) values[kept++] = values[i];
    }
    values.resize(kept);
    result.summary = summarise(values);
    std::erase_if(values, [](double x) { return std::isnan(x); });
    std::sort(values.begin(), values.end());
    if (random) result.mean = mean_interval(result.summary, confidence_level);
    result.quantiles = estimate_quantiles(values, reported_quantiles, confidence_level);
    for (QuantileEstimate& estimate : result.quantiles) {
        if (!random) estimate.interval = Interval();
    }
    result.histogram = histogram(values);
    return result;
}

void add_yields(ToleranceReport& report, ToleranceMembers const& members, Scene const& scene,
                std::span<QuantityColumn const> columns, bool random, std::string const& path) {
    if (scene.limits.empty()) return;
    std::vector<char> all_met(members.size());
    std::uint64_t trials = 0;
    for (std::size_t i = 0; i < members.size(); ++i) {
        trials += members.is_draw(i) && members.ran(i);
        all_met[i] = members.is_draw(i) && members.finished(i);
    }
    for (Limit const& limit : scene.limits) {
        auto const column = std::find_if(columns.begin(), columns.end(), [&](QuantityColumn const& candidate) {
            return candidate.quantity == limit.quantity && candidate.label == limit.label;
        });
        if (column == columns.end()) refuse_limit(limit, path);
        std::vector<double> const values = members.column(column->quantity, column->index);
        std::uint64_t met = 0;
        for (std::size_t i = 0; i < members.size(); ++i) {
            bool const within = limit.low <= values[i] && values[i] <= limit.high;  // not of NaN
            met += members.is_draw(i) && members.finished(i) && within;
            all_met[i] = all_met[i] && within;
        }
        report.limits.push_back({limit, column->unit, yield_of(met, trials, random)});
    }
    auto const all = static_cast<std::uint64_t>(std::count(all_met.begin(), all_met.end(), 1));
    report.all_met = yield_of(all, trials, random);
}

bool is_complete(std::vector<StatusCount> const& statuses) {
    return std::none_of(statuses.begin(), statuses.end(),
                        [](StatusCount const& count) { return count.status == Status::not_run; });
}

}  // namespace

ToleranceReport tolerance_report(ResultView const& results, Scene const& scene, ReportSettings const& settings) {
    if (!results.stores_members()) {
        std::uint64_t const left = members_left(results);
        return statistics_report(stored_statistics(results), left, scene, results.path());
    }
    bool const radial = scene.design.kind == DesignKind::saltelli;
    std::size_t const width = radial ? scene.variations.size() + 2 : 0;
    std::uint64_t const size = radial ? scene.design.base * width : scene.members;
    ToleranceMembers const members(results, width, size);
    std::vector<QuantityColumn> const columns = quantity_columns_of(results);

    ToleranceReport report;
    report.design = scene.design.kind;
    report.policy = policy_of(report.design);
    report.statuses = members.count(false);
    bool const complete = is_complete(report.statuses);
    report.intervals = intervals_of(report.design, complete);
    report.draws = members.count(true);
    for (Variation const& variation : scene.variations) report.inputs.emplace_back(variation.key->name);
    bool const random = is_random(report.design) && complete;
    auto const pause = [&settings] {
        if (settings.pause) settings.pause();
    };
    for (QuantityColumn const& column : columns) {
        pause();
        report.columns.push_back(statistics_of(members, column, random));
    }
    pause();
    add_yields(report, members, scene, columns, random, results.path());
    if (radial) {
        report.indices = index_report(members, scene, columns, random, settings);
    } else {
        report.correlations = correlation_report(members, scene, columns, random, settings);
    }
    return report;
}

}  // namespace slideway
