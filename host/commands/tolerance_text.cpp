#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "host/commands/text.hpp"

namespace slideway::cli {
namespace {

constexpr std::size_t top_inputs = 3;

/// Where lines end.
std::size_t longest_line() { return line_width() > 0 ? std::min<std::size_t>(line_width(), 120) : 120; }

std::string share(double value) { return std::isnan(value) ? std::string("-") : fmt::format("{:.3f}", value); }

/// " [0.1, 0.3]", nothing where there is no interval.
std::string interval_text(Interval const& interval) {
    if (std::isnan(interval.low) && std::isnan(interval.high)) return std::string();
    return fmt::format(" [{}, {}]", share(interval.low), share(interval.high));
}

void print_wrapped(std::string_view text) { print_out("{}\n", wrapped(text, 0, longest_line())); }

std::size_t name_width(ToleranceReport const& report) {
    std::size_t width = std::string_view("quantity").size();
    for (ColumnStatistics const& entry : report.columns) width = std::max(width, entry.column.name().size());
    return width;
}

void print_moments(ToleranceReport const& report) {
    print_out("\nMean with its {:.0f} % interval, spread and ends:\n", 100 * confidence_level);
    auto const rows = [&](int digits) {
        TextRows table{{"quantity", "unit", "n", "mean", "low", "high", "sd", "min", "max"}};
        for (ColumnStatistics const& entry : report.columns) {
            Summary const& s = entry.summary;
            auto& row = table.emplace_back(std::vector<std::string>{entry.column.name(), entry.column.unit, std::to_string(s.count)});
            for (double const value : {s.mean, entry.mean.low, entry.mean.high, s.sd, s.min, s.max}) row.push_back(cell(value, digits));
        }
        return table;
    };
    print_table(rows, 4, 2, 10);
}

void print_quantiles(ToleranceReport const& report) {
    print_out("\nQuantiles (their intervals are in the file):\n");
    auto const rows = [&](int digits) {
        TextRows table{{"quantity"}};
        for (double const p : reported_quantiles) table[0].push_back(fmt::format("{:.4g} %", 100 * p));
        for (ColumnStatistics const& entry : report.columns) {
            auto& row = table.emplace_back(std::vector<std::string>{entry.column.name()});
            for (QuantileEstimate const& quantile : entry.quantiles) row.push_back(cell(quantile.value, digits));
        }
        return table;
    };
    print_table(rows, 3, 1, 8);
}

std::string limit_text(Limit const& limit, std::string const& unit) {
    bool const low = std::isfinite(limit.low), high = std::isfinite(limit.high);
    if (low && high) return fmt::format("{:.6g} to {:.6g} {}", limit.low, limit.high, unit);
    return low ? fmt::format(">= {:.6g} {}", limit.low, unit) : fmt::format("<= {:.6g} {}", limit.high, unit);
}

void print_yields(ToleranceReport const& report) {
    if (!report.all_met) return;
    print_out("\nYield, of {} that ran, with its {:.0f} % interval:\n", counted(report.all_met->trials, "member"), 100 * confidence_level);
    auto const percent = [](double value) { return share(100 * value); };
    TextRows table{{"quantity", "limit", "met", "yield [%]", "low", "high"}};
    auto const add = [&](std::string const& limit, std::string const& range, Proportion const& met) {
        table.push_back({limit, range, std::to_string(met.successes), percent(met.value), percent(met.interval.low), percent(met.interval.high)});
    };
    for (LimitYield const& limit : report.limits) add(limit.limit.name(), limit_text(limit.limit, limit.unit), limit.met);
    add("all limits", "", *report.all_met);
    print_table([&](int) { return table; }, 3, 2, 9);
}

/// The first inputs of a ranking after the quantity's name, as many as asked for; lines go on below where they are
/// full.
void print_ranked(std::string const& name, std::size_t width, std::vector<std::string> const& cells) {
    std::string line = fmt::format("  {:<{}}", name, width);
    std::size_t const indent = line.size();
    for (std::string const& cell : cells) {
        if (line.size() > indent && line.size() + 2 + cell.size() > longest_line()) {
            print_out("{}\n", line);
            line = std::string(indent, ' ');
        }
        line += std::string("  ") + cell;
    }
    print_out("{}\n", line);
}

/// Nothing tells inputs apart for an output that varies by no more than its error.
std::vector<std::string> cells_or_dash(std::vector<std::string> cells, std::string const& why_none) {
    if (cells.empty()) cells.push_back(why_none.empty() ? "-" : "- " + why_none);
    return cells;
}

void print_indices(ToleranceReport const& report) {
    if (!report.indices) return;
    IndexReport const& indices = *report.indices;
    std::string heading = fmt::format("\nSobol indices with {:.0f} % intervals, the largest total first, of {} rows of the design", 100 * confidence_level,
                                      indices.used());
    if (indices.failed > 0) heading += fmt::format("; {} left out for a failed member", indices.failed);
    if (indices.incomplete > 0) heading += fmt::format("; {} incomplete", indices.incomplete);
    print_lines(0, heading);
    TextRows table{{"quantity", "input", "first order", "total"}};
    auto const text = [](IndexEstimate const& index) { return share(index.value) + interval_text(index.interval); };
    for (ColumnIndices const& entry : indices.columns) {
        SobolIndices const& found = entry.indices;
        std::string name = entry.column.name();
        for (std::size_t rank = 0; rank < std::min(top_inputs, entry.ranking.size()); ++rank) {
            std::size_t const input = entry.ranking[rank];
            if (std::isnan(found.total[input].value)) break;
            table.push_back({std::exchange(name, {}), report.inputs[input], text(found.first[input]), text(found.total[input])});
        }
        if (name.empty())
            table.push_back({"", "all first orders", text(found.first_sum)});
        else
            table.push_back({name, "-"});
    }
    print_table([&](int) { return table; }, 3, 2, 24);
    for (ColumnIndices const& entry : indices.columns) {
        if (!entry.why_none.empty()) print_wrapped(fmt::format("  {}: no index, it {}", entry.column.name(), entry.why_none));
    }
}

void print_correlations(ToleranceReport const& report) {
    if (report.correlations.empty()) return;
    std::size_t const width = name_width(report);
    print_out(
        "\nRank correlations, the strongest first\n  {:<{}}  R² of the linear regression; correlation [interval]\n",
        "quantity", width);
    for (ColumnCorrelations const& entry : report.correlations) {
        std::vector<std::string> cells;
        for (std::size_t rank = 0; rank < std::min(top_inputs, entry.ranking.size()); ++rank) {
            std::size_t const input = entry.ranking[rank];
            CorrelationEstimate const& estimate = entry.ranks[input];
            if (std::isnan(estimate.value)) break;
            if (cells.empty()) cells.push_back(fmt::format("{};", share(entry.regression.r_squared)));
            cells.push_back(
                fmt::format("{} {}{}", report.inputs[input], share(estimate.value), interval_text(estimate.interval)));
        }
        print_ranked(entry.column.name(), width, cells_or_dash(std::move(cells), entry.why_none));
    }
}

}  // namespace

void print_tolerance(ToleranceReport const& report) {
    print_out("\nTolerances, design {}; members by how they ended:\n", name_of(report.design));
    print_statuses(report.statuses);
    print_wrapped(report.policy);
    print_wrapped("Intervals: " + report.intervals + ".");
    if (!report.quantile_error.empty()) print_wrapped("Quantiles are sketched: " + report.quantile_error + ".");
    auto const has_values = [](ColumnStatistics const& entry) { return entry.summary.count > 0; };
    if (std::none_of(report.columns.begin(), report.columns.end(), has_values)) {
        print_out("\nThere are no distributions: no member finished, or no quantity is stored.\n");
    } else {
        print_moments(report);
        print_quantiles(report);
        print_yields(report);
        print_indices(report);
        print_correlations(report);
        return;
    }
    print_yields(report);
}

}  // namespace slideway::cli
