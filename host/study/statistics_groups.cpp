#include "host/study/tolerance_report.hpp"

#include <algorithm>
#include <array>

#include <fmt/ranges.h>

#include "host/base/numbers.hpp"
#include "host/store/column.hpp"

namespace slideway {
namespace {

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

void append(std::vector<int>& values, std::uint64_t count) { values.push_back(static_cast<int>(count)); }
void append(std::vector<double>& values, double value) { values.push_back(value); }
void append(std::vector<double>& values, Interval const& interval) { values.insert(values.end(), {interval.low, interval.high}); }
template <class T> void append(std::vector<T>& values, std::vector<T> const& row) { values.insert(values.end(), row.begin(), row.end()); }

/// The same of each of several, in a row.
template <class Entries, class Of> std::vector<double> row_of(Entries const& entries, Of of) {
    std::vector<double> row;
    for (auto const& entry : entries) append(row, of(entry));
    return row;
}
std::vector<double> values_of(auto const& estimates) {
    return row_of(estimates, [](auto const& estimate) { return estimate.value; });
}
std::vector<double> intervals_of(auto const& estimates) {
    return row_of(estimates, [](auto const& estimate) { return estimate.interval; });
}

/// Writes one value, or a row of values, of each column of a quantity.
template <class Entry> class QuantityWriter {
public:
    QuantityWriter(DataFile& group, std::span<Entry const> entries) : group_(group), entries_(entries) {}

    /// @param of what there is to write of an entry: a number, an interval or a row of numbers, as many as the dimensions say
    template <class Of>
    void numbers(std::string const& suffix, std::string const& unit, std::string const& what, std::vector<std::string> const& dimensions, Of of) {
        put<double>(suffix, unit, what, dimensions, of);
    }
    template <class Of> void counts(std::string const& suffix, std::string const& what, std::vector<std::string> const& dimensions, Of of) {
        put<int>(suffix, "1", what, dimensions, of);
    }
    std::string const& unit() const { return entries_.front().column.unit; }

private:
    template <class T, class Of>
    void put(std::string const& suffix, std::string const& unit, std::string const& what, std::vector<std::string> dimensions, Of of) {
        std::vector<T> values;
        for (Entry const& entry : entries_) append(values, of(entry));
        QuantityColumn const& column = entries_.front().column;
        std::vector<std::string> coordinates;
        if (!column.dimension.empty()) {
            dimensions.insert(dimensions.begin(), column.dimension);
            coordinates.push_back(column.dimension + "_name");
        }
        if (std::ranges::count(dimensions, "input") > 0) coordinates.emplace_back("input_name");
        slideway::put(group_, {column.quantity + "_" + suffix, unit, what + ": " + column.long_name, std::move(dimensions),
                    fmt::format("{}", fmt::join(coordinates, " "))},
                   values);
    }

    DataFile& group_;
    std::span<Entry const> entries_;
};

void describe_group(DataFile& group, ToleranceReport const& report) {
    group.put(DataFile::global, "policy", report.policy);
    group.put(DataFile::global, "intervals", report.intervals);
    group.put(DataFile::global, "confidence_level", confidence_level);
    group.put(DataFile::global, "design", std::string(name_of(report.design)));
    put_labels(group, "bound", "end of an interval", {"low", "high"});
}

void write_statuses(DataFile& group, ToleranceReport const& report) {
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
    put_labels(group, "ending", "how a member ended", labels);
    put(group, {"members", "1", "members of the file that ended so", {"ending"}, "ending_name"}, members);
    put(group, {"draws", "1", "members that distributions and yields are of that ended so", {"ending"}, "ending_name"}, draws);
}

void write_distributions(DataFile& file, ToleranceReport const& report) {
    auto const held = file.add_group("statistics");
    DataFile& group = *held;
    describe_group(group, report);
    if (!report.quantile_error.empty()) group.put(DataFile::global, "quantile_error", report.quantile_error);
    write_statuses(group, report);
    group.add_dimension("probability", std::size(reported_quantiles));
    put(group, {"probability", "1", "probability of a quantile", {"probability"}}, reported_quantiles);
    group.add_dimension("bin", most_bins);
    group.add_dimension("edge", most_bins + 1);
    for (auto const& entries : by_quantity(report.columns)) {
        using Entry = ColumnStatistics;
        QuantityWriter<Entry> writer(group, entries);
        std::string const unit = writer.unit();
        writer.counts("count", "members that finished with a number", {}, [](Entry const& e) { return e.summary.count; });
        writer.numbers("mean", unit, "mean", {}, [](Entry const& e) { return e.summary.mean; });
        writer.numbers("mean_interval", unit, "confidence interval of the mean", {"bound"}, [](Entry const& e) { return e.mean; });
        writer.numbers("sd", unit, "standard deviation", {}, [](Entry const& e) { return e.summary.sd; });
        writer.numbers("min", unit, "least", {}, [](Entry const& e) { return e.summary.min; });
        writer.numbers("max", unit, "largest", {}, [](Entry const& e) { return e.summary.max; });
        writer.numbers("quantile", unit, "quantile", {"probability"}, [](Entry const& e) { return values_of(e.quantiles); });
        writer.numbers("quantile_interval", unit, "confidence interval of the quantile", {"probability", "bound"},
                       [](Entry const& e) { return intervals_of(e.quantiles); });
        writer.counts("bin_count", "members in the bin; bins beyond those in use are 0", {"bin"}, [](Entry const& e) {
            std::vector<int> counts(e.histogram.counts.begin(), e.histogram.counts.end());
            counts.resize(most_bins, 0);
            return counts;
        });
        writer.numbers("bin_edge", unit, "edges of the bins; NaN beyond those in use", {"edge"}, [](Entry const& e) {
            std::vector<double> edges = e.histogram.edges;
            edges.resize(most_bins + 1, nan);
            return edges;
        });
    }
}

void write_yields(DataFile& file, ToleranceReport const& report) {
    if (!report.all_met) return;
    auto const held = file.add_group("yield");
    DataFile& group = *held;
    describe_group(group, report);
    std::vector<std::string> names, units;
    std::vector<double> low, high, value, interval;
    std::vector<int> met;
    for (LimitYield const& limit : report.limits) {
        names.push_back(limit.limit.name());
        units.push_back(limit.unit);
        low.push_back(limit.limit.low);
        high.push_back(limit.limit.high);
        append(met, limit.met.successes);
        value.push_back(limit.met.value);
        append(interval, limit.met.interval);
    }
    std::string const unit_of("in the unit that unit_name gives");
    put_labels(group, "limit", "quantity that is limited", names);
    put_texts(group, "unit", "limit", "unit of the limited quantity", units);
    put(group, {"low", "", "least value that meets the limit, " + unit_of, {"limit"}, "limit_name"}, low);
    put(group, {"high", "", "largest value that meets the limit, " + unit_of, {"limit"}, "limit_name"}, high);
    put(group, {"met", "1", "members that meet the limit", {"limit"}, "limit_name"}, met);
    put(group, {"share", "1", "share of the members that meet the limit", {"limit"}, "limit_name"}, value);
    put(group, {"share_interval", "1", "confidence interval of the share", {"limit", "bound"}, "limit_name"}, interval);
    Proportion const& all = *report.all_met;
    put(group, {"all_met", "1", "members that meet all limits"}, static_cast<int>(all.successes));
    put(group, {"trials", "1", "members that ran, failed ones included"}, static_cast<int>(all.trials));
    put(group, {"all_share", "1", "share of the members that meet all limits"}, all.value);
    put(group, {"all_share_interval", "1", "confidence interval of the share", {"bound"}}, std::array{all.interval.low, all.interval.high});
}

/// Of each input its rank; 0 of all where the column has none.
std::vector<int> ranks_of(std::vector<std::size_t> const& ranking, std::string const& why_none) {
    std::vector<int> ranks(ranking.size());
    if (!why_none.empty()) return ranks;
    for (std::size_t rank = 0; rank < ranking.size(); ++rank) ranks[ranking[rank]] = static_cast<int>(rank) + 1;
    return ranks;
}

void write_indices(DataFile& group, IndexReport const& report) {
    put(group, {"rows_used", "1", "rows of the design in the indices"}, static_cast<int>(report.used()));
    put(group, {"rows_failed", "1", "rows left out: a member failed"}, static_cast<int>(report.failed));
    put(group, {"rows_incomplete", "1", "rows left out: a member is missing"}, static_cast<int>(report.incomplete));
    for (auto const& entries : by_quantity(report.columns)) {
        using Entry = ColumnIndices;
        QuantityWriter<Entry> writer(group, entries);
        writer.counts("rows", "rows without a missing number", {}, [](Entry const& e) { return e.indices.rows; });
        writer.numbers("first", "1", "first-order index", {"input"}, [](Entry const& e) { return values_of(e.indices.first); });
        writer.numbers("first_interval", "1", "confidence interval of the first-order index", {"input", "bound"},
                       [](Entry const& e) { return intervals_of(e.indices.first); });
        writer.numbers("total", "1", "total index", {"input"}, [](Entry const& e) { return values_of(e.indices.total); });
        writer.numbers("total_interval", "1", "confidence interval of the total index", {"input", "bound"},
                       [](Entry const& e) { return intervals_of(e.indices.total); });
        writer.numbers("first_sum", "1", "sum of the first-order indices", {}, [](Entry const& e) { return e.indices.first_sum.value; });
        writer.numbers("first_sum_interval", "1", "confidence interval of the sum of the first-order indices", {"bound"},
                       [](Entry const& e) { return e.indices.first_sum.interval; });
        writer.counts("rank", "rank of the input by its total index, 1 the largest; 0: it has none", {"input"},
                      [](Entry const& e) { return ranks_of(e.ranking, e.why_none); });
    }
}

void write_correlations(DataFile& group, std::vector<ColumnCorrelations> const& correlations) {
    for (auto const& entries : by_quantity(correlations)) {
        using Entry = ColumnCorrelations;
        QuantityWriter<Entry> writer(group, entries);
        writer.counts("count", "members in the correlations", {}, [](Entry const& e) { return e.members; });
        writer.numbers("rank_correlation", "1", "Spearman's rank correlation", {"input"}, [](Entry const& e) { return values_of(e.ranks); });
        writer.numbers("rank_correlation_interval", "1", "confidence interval of the rank correlation", {"input", "bound"},
                       [](Entry const& e) { return intervals_of(e.ranks); });
        writer.numbers("regression", "1", "standardised regression coefficient", {"input"}, [](Entry const& e) { return e.regression.coefficients; });
        writer.numbers("r_squared", "1", "share of the variance that the linear regression explains", {},
                       [](Entry const& e) { return e.regression.r_squared; });
        writer.counts("rank", "rank of the input by the magnitude of its rank correlation, 1 the largest; 0: it has none", {"input"},
                      [](Entry const& e) { return ranks_of(e.ranking, e.why_none); });
    }
}

/// Columns without sensitivities and why, as an attribute; they are NaN.
void write_reasons(DataFile& group, auto const& columns) {
    std::vector<std::string> reasons;
    for (auto const& entry : columns) {
        if (!entry.why_none.empty()) reasons.push_back(entry.column.name() + " " + entry.why_none);
    }
    if (!reasons.empty()) group.put(DataFile::global, "without_index", fmt::format("{}", fmt::join(reasons, "; ")));
}

void write_sensitivity(DataFile& file, ToleranceReport const& report) {
    if (report.inputs.empty()) return;
    auto const held = file.add_group("sensitivity");
    DataFile& group = *held;
    describe_group(group, report);
    put_labels(group, "input", "key that varies", report.inputs);
    if (report.indices) {
        write_reasons(group, report.indices->columns);
        write_indices(group, *report.indices);
    }
    write_reasons(group, report.correlations);
    write_correlations(group, report.correlations);
}

}  // namespace

void write_statistics(DataFile& file, ToleranceReport const& report) {
    write_distributions(file, report);
    write_yields(file, report);
    write_sensitivity(file, report);
}

}  // namespace slideway
