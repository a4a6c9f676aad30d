#include "host/study/tolerance_report.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "host/scene/error.hpp"
#include "host/scene/labels.hpp"
#include "host/study/tolerance_members.hpp"
#include "host/study/tolerance_sensitivity.hpp"

namespace slideway {
namespace {

bool is_random(DesignKind design) { return design != DesignKind::grid && design != DesignKind::table; }

std::string policy_of(DesignKind design) {
    std::string text(
        "Moments, quantiles and histograms are of the members that finished. Members that failed are counted by status "
        "and meet no limit. Members that did not run are left out.");
    if (design == DesignKind::saltelli) {
        text +=
            " Of this saltelli design, distributions and yields are of the members of A and B; rows with a member that "
            "failed or is missing are left out of the indices whole.";
    }
    return text;
}

std::string intervals_of(DesignKind design) {
    std::string const level = fmt::format("{:.0f} % intervals of independent draws", 100 * confidence_level);
    if (!is_random(design)) return "none: the members are no random draws";
    if (design == DesignKind::mc) return level;
    return level + "; conservative, for the draws of this design are spread more evenly";
}

std::vector<QuantityColumn> quantity_columns_of(ResultView const& results) {
    std::vector<QuantityColumn> columns;
    for (QuantityInfo const& info : quantity_table) {
        if (!results.has(info.name)) continue;
        QuantityColumn column;
        column.quantity = info.name;
        column.unit = results.unit(info.name);
        column.long_name = results.long_name(info.name);
        if (info.dimension == nullptr) {
            columns.push_back(column);
            continue;
        }
        column.dimension = info.dimension;
        for (std::string const& label : labels_of(info.dimension)) {
            column.label = label;
            columns.push_back(column);
            ++column.index;
        }
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
    for (double const p : reported_quantiles) {
        result.quantiles.push_back(
            {p, quantile(values, p), random ? quantile_interval(values, p, confidence_level) : Interval()});
    }
    result.histogram = histogram(values);
    return result;
}

Proportion yield_of(std::uint64_t met, std::uint64_t trials, bool random) {
    Proportion yield = proportion(met, trials, confidence_level);
    if (!random) yield.interval = Interval();
    return yield;
}

void add_yields(ToleranceReport& report, ToleranceMembers const& members, Scene const& scene,
                std::span<QuantityColumn const> columns, std::string const& path) {
    if (scene.limits.empty()) return;
    bool const random = is_random(report.design);
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
        if (column == columns.end()) {
            throw FileError(
                fmt::format("{}: has no {}, which study.limits names; add it to study.quantities", path, limit.name()));
        }
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

}  // namespace

ToleranceReport tolerance_report(ResultView const& results, Scene const& scene) {
    bool const radial = scene.design.kind == DesignKind::saltelli;
    std::size_t const width = radial ? scene.variations.size() + 2 : 0;
    std::uint64_t const size = radial ? scene.design.base * width : scene.members;
    ToleranceMembers const members(results, width, size);
    std::vector<QuantityColumn> const columns = quantity_columns_of(results);

    ToleranceReport report;
    report.design = scene.design.kind;
    report.policy = policy_of(report.design);
    report.intervals = intervals_of(report.design);
    report.statuses = members.count(false);
    report.draws = members.count(true);
    for (Variation const& variation : scene.variations) report.inputs.emplace_back(variation.key->name);
    bool const random = is_random(report.design);
    for (QuantityColumn const& column : columns) report.columns.push_back(statistics_of(members, column, random));
    add_yields(report, members, scene, columns, results.path());
    if (radial) {
        report.indices = index_report(members, scene, columns);
    } else {
        report.correlations = correlation_report(members, scene, columns, random);
    }
    return report;
}

}  // namespace slideway
