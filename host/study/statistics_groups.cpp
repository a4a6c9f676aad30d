#include "host/study/tolerance_report.hpp"

#include <algorithm>
#include <limits>

#include "host/study/group_writer.hpp"

namespace slideway {
namespace {

using Description = GroupWriter::Description;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Entries of a report, one per column of a quantity, that belong to the same quantity.
template <class Entry> std::vector<std::span<Entry const>> by_quantity(std::vector<Entry> const& entries) {
    std::vector<std::span<Entry const>> groups;
    for (auto from = entries.begin(); from != entries.end();) {
        auto const to = std::find_if(from, entries.end(),
                                     [&](Entry const& e) { return e.column.quantity != from->column.quantity; });
        groups.emplace_back(from, to);
        from = to;
    }
    return groups;
}

/// Writes one value, or a row of values, of each column of a quantity.
template <class Entry> class QuantityWriter {
public:
    QuantityWriter(GroupWriter& group, std::span<Entry const> entries) : group_(group), entries_(entries) {}

    /// @param fill appends an entry's values; they are as many as the dimensions say.
    template <class Fill>
    void numbers(std::string const& suffix, std::string const& unit, std::string const& what,
                 std::vector<std::string> const& dimensions, Fill fill) {
        std::vector<double> values;
        for (Entry const& entry : entries_) fill(entry, values);
        group_.numbers(describe(suffix, unit, what, dimensions), values);
    }
    template <class Fill>
    void counts(std::string const& suffix, std::string const& what, std::vector<std::string> const& dimensions,
                Fill fill) {
        std::vector<int> values;
        for (Entry const& entry : entries_) fill(entry, values);
        group_.counts(describe(suffix, "1", what, dimensions), values);
    }
    std::string const& unit() const { return entries_.front().column.unit; }

private:
    Description describe(std::string const& suffix, std::string const& unit, std::string const& what,
                         std::vector<std::string> dimensions) const {
        QuantityColumn const& column = entries_.front().column;
        std::string coordinates;
        if (!column.dimension.empty()) {
            dimensions.insert(dimensions.begin(), column.dimension);
            coordinates = column.dimension + "_name";
        }
        if (std::find(dimensions.begin(), dimensions.end(), "input") != dimensions.end()) {
            coordinates += coordinates.empty() ? "input_name" : " input_name";
        }
        return {column.quantity + "_" + suffix, unit, what + ": " + column.long_name, std::move(dimensions),
                std::move(coordinates)};
    }

    GroupWriter& group_;
    std::span<Entry const> entries_;
};

void put(std::vector<double>& values, Interval const& interval) {
    values.push_back(interval.low);
    values.push_back(interval.high);
}

void describe_group(GroupWriter& group, ToleranceReport const& report) {
    group.attribute("policy", report.policy);
    group.attribute("intervals", report.intervals);
    group.attribute("confidence_level", confidence_level);
    group.attribute("design", std::string(name_of(report.design)));
    group.labels("bound", "end of an interval", {"low", "high"});
}

void write_statuses(GroupWriter& group, ToleranceReport const& report) {
    std::vector<std::string> labels;
    std::vector<int> members, draws;
    for (StatusCount const& status : report.statuses) {
        labels.push_back(name_of(status.status));
        members.push_back(static_cast<int>(status.members));
        draws.push_back(0);
        for (StatusCount const& draw : report.draws) {
            if (draw.status == status.status) draws.back() = static_cast<int>(draw.members);
        }
    }
    if (labels.empty()) return;
    group.labels("ending", "how a member ended", labels);
    group.counts({"members", "1", "members of the file that ended so", {"ending"}, "ending_name"}, members);
    group.counts(
        {"draws", "1", "members that distributions and yields are of that ended so", {"ending"}, "ending_name"}, draws);
}

void write_distributions(NetcdfFile& file, ToleranceReport const& report) {
    GroupWriter group(file, "statistics");
    describe_group(group, report);
    if (!report.quantile_error.empty()) group.attribute("quantile_error", report.quantile_error);
    write_statuses(group, report);
    group.dimension("probability", std::size(reported_quantiles));
    group.numbers({"probability", "1", "probability of a quantile", {"probability"}, ""}, reported_quantiles);
    group.dimension("bin", most_bins);
    group.dimension("edge", most_bins + 1);
    for (auto const& entries : by_quantity(report.columns)) {
        QuantityWriter<ColumnStatistics> writer(group, entries);
        std::string const unit = writer.unit();
        writer.counts("count", "members that finished with a number", {},
                      [](auto const& entry, auto& values) { values.push_back(static_cast<int>(entry.summary.count)); });
        writer.numbers("mean", unit, "mean", {}, [](auto const& e, auto& values) { values.push_back(e.summary.mean); });
        writer.numbers("mean_interval", unit, "confidence interval of the mean", {"bound"},
                       [](auto const& entry, auto& values) { put(values, entry.mean); });
        writer.numbers("sd", unit, "standard deviation", {},
                       [](auto const& entry, auto& values) { values.push_back(entry.summary.sd); });
        writer.numbers("min", unit, "least", {}, [](auto const& e, auto& values) { values.push_back(e.summary.min); });
        writer.numbers("max", unit, "largest", {},
                       [](auto const& e, auto& values) { values.push_back(e.summary.max); });
        writer.numbers("quantile", unit, "quantile", {"probability"}, [](auto const& entry, auto& values) {
            for (QuantileEstimate const& quantile : entry.quantiles) values.push_back(quantile.value);
        });
        writer.numbers("quantile_interval", unit, "confidence interval of the quantile", {"probability", "bound"},
                       [](auto const& entry, auto& values) {
                           for (QuantileEstimate const& quantile : entry.quantiles) put(values, quantile.interval);
                       });
        writer.counts("bin_count", "members in the bin; bins beyond those in use are 0", {"bin"},
                      [](auto const& entry, auto& values) {
                          std::size_t const room = values.size() + most_bins;
                          for (auto const count : entry.histogram.counts) values.push_back(static_cast<int>(count));
                          values.resize(room, 0);
                      });
        writer.numbers("bin_edge", unit, "edges of the bins; NaN beyond those in use", {"edge"},
                       [](auto const& entry, auto& values) {
                           std::size_t const room = values.size() + most_bins + 1;
                           values.insert(values.end(), entry.histogram.edges.begin(), entry.histogram.edges.end());
                           values.resize(room, nan);
                       });
    }
}

void write_yields(NetcdfFile& file, ToleranceReport const& report) {
    if (!report.all_met) return;
    GroupWriter group(file, "yield");
    describe_group(group, report);
    std::vector<std::string> names, units;
    std::vector<double> low, high, value, interval;
    std::vector<int> met;
    for (LimitYield const& limit : report.limits) {
        names.push_back(limit.limit.name());
        units.push_back(limit.unit);
        low.push_back(limit.limit.low);
        high.push_back(limit.limit.high);
        met.push_back(static_cast<int>(limit.met.successes));
        value.push_back(limit.met.value);
        put(interval, limit.met.interval);
    }
    std::string const unit_of("in the unit that unit_name gives");
    group.labels("limit", "quantity that is limited", names);
    group.texts("unit", "limit", "unit of the limited quantity", units);
    group.numbers({"low", "", "least value that meets the limit, " + unit_of, {"limit"}, "limit_name"}, low);
    group.numbers({"high", "", "largest value that meets the limit, " + unit_of, {"limit"}, "limit_name"}, high);
    group.counts({"met", "1", "members that meet the limit", {"limit"}, "limit_name"}, met);
    group.numbers({"share", "1", "share of the members that meet the limit", {"limit"}, "limit_name"}, value);
    group.numbers({"share_interval", "1", "confidence interval of the share", {"limit", "bound"}, "limit_name"},
                  interval);
    Proportion const& all = *report.all_met;
    interval.clear();
    put(interval, all.interval);
    int const counts[] = {static_cast<int>(all.successes), static_cast<int>(all.trials)};
    group.counts({"all_met", "1", "members that meet all limits", {}, ""}, {counts, 1});
    group.counts({"trials", "1", "members that ran, failed ones included", {}, ""}, {counts + 1, 1});
    group.numbers({"all_share", "1", "share of the members that meet all limits", {}, ""}, {&all.value, 1});
    group.numbers({"all_share_interval", "1", "confidence interval of the share", {"bound"}, ""}, interval);
}

void put_ranks(std::vector<std::size_t> const& ranking, std::vector<int>& values) {
    std::size_t const first = values.size();
    values.resize(first + ranking.size());
    for (std::size_t rank = 0; rank < ranking.size(); ++rank) {
        values[first + ranking[rank]] = static_cast<int>(rank) + 1;
    }
}

void put_values(auto const& estimates, std::vector<double>& values) {
    for (auto const& estimate : estimates) values.push_back(estimate.value);
}

void put_intervals(auto const& estimates, std::vector<double>& values) {
    for (auto const& estimate : estimates) put(values, estimate.interval);
}

void write_indices(GroupWriter& group, IndexReport const& report) {
    int const rows[] = {static_cast<int>(report.used()), static_cast<int>(report.failed),
                        static_cast<int>(report.incomplete)};
    group.counts({"rows_used", "1", "rows of the design in the indices", {}, ""}, {rows, 1});
    group.counts({"rows_failed", "1", "rows left out: a member failed", {}, ""}, {rows + 1, 1});
    group.counts({"rows_incomplete", "1", "rows left out: a member is missing", {}, ""}, {rows + 2, 1});
    for (auto const& entries : by_quantity(report.columns)) {
        QuantityWriter<ColumnIndices> writer(group, entries);
        writer.counts("rows", "rows without a missing number", {},
                      [](auto const& entry, auto& values) { values.push_back(static_cast<int>(entry.indices.rows)); });
        writer.numbers("first", "1", "first-order index", {"input"},
                       [](auto const& entry, auto& values) { put_values(entry.indices.first, values); });
        writer.numbers("first_interval", "1", "confidence interval of the first-order index", {"input", "bound"},
                       [](auto const& entry, auto& values) { put_intervals(entry.indices.first, values); });
        writer.numbers("total", "1", "total index", {"input"},
                       [](auto const& entry, auto& values) { put_values(entry.indices.total, values); });
        writer.numbers("total_interval", "1", "confidence interval of the total index", {"input", "bound"},
                       [](auto const& entry, auto& values) { put_intervals(entry.indices.total, values); });
        writer.numbers("first_sum", "1", "sum of the first-order indices", {},
                       [](auto const& entry, auto& values) { values.push_back(entry.indices.first_sum.value); });
        writer.numbers("first_sum_interval", "1", "confidence interval of the sum of the first-order indices",
                       {"bound"},
                       [](auto const& entry, auto& values) { put(values, entry.indices.first_sum.interval); });
        writer.counts("rank", "rank of the input by its total index, 1 the largest", {"input"},
                      [](auto const& entry, auto& values) { put_ranks(entry.ranking, values); });
    }
}

void write_correlations(GroupWriter& group, std::vector<ColumnCorrelations> const& correlations) {
    for (auto const& entries : by_quantity(correlations)) {
        QuantityWriter<ColumnCorrelations> writer(group, entries);
        writer.counts("count", "members in the correlations", {},
                      [](auto const& entry, auto& values) { values.push_back(static_cast<int>(entry.members)); });
        writer.numbers("rank_correlation", "1", "Spearman's rank correlation", {"input"},
                       [](auto const& entry, auto& values) { put_values(entry.ranks, values); });
        writer.numbers("rank_correlation_interval", "1", "confidence interval of the rank correlation",
                       {"input", "bound"}, [](auto const& entry, auto& values) { put_intervals(entry.ranks, values); });
        writer.numbers("regression", "1", "standardised regression coefficient", {"input"},
                       [](auto const& entry, auto& values) {
                           auto const& coefficients = entry.regression.coefficients;
                           values.insert(values.end(), coefficients.begin(), coefficients.end());
                       });
        writer.numbers("r_squared", "1", "share of the variance that the linear regression explains", {},
                       [](auto const& entry, auto& values) { values.push_back(entry.regression.r_squared); });
        writer.counts("rank", "rank of the input by the magnitude of its rank correlation, 1 the largest", {"input"},
                      [](auto const& entry, auto& values) { put_ranks(entry.ranking, values); });
    }
}

void write_sensitivity(NetcdfFile& file, ToleranceReport const& report) {
    if (report.inputs.empty()) return;
    GroupWriter group(file, "sensitivity");
    describe_group(group, report);
    group.labels("input", "key that varies", report.inputs);
    if (report.indices) write_indices(group, *report.indices);
    write_correlations(group, report.correlations);
}

}  // namespace

void write_statistics(NetcdfFile& file, ToleranceReport const& report) {
    write_distributions(file, report);
    write_yields(file, report);
    write_sensitivity(file, report);
}

}  // namespace slideway
