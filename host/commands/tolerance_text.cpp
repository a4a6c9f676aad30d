#include "host/commands/tolerance_text.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "host/commands/text.hpp"

namespace slideway::cli {
namespace {

constexpr std::size_t line_width = 120;
constexpr std::size_t top_inputs = 3;

std::string number(double value) { return std::isnan(value) ? std::string("-") : fmt::format("{:.4g}", value); }

std::string share(double value) { return std::isnan(value) ? std::string("-") : fmt::format("{:.3f}", value); }

/// " [0.1, 0.3]", nothing where there is no interval.
std::string interval_text(Interval const& interval) {
    if (std::isnan(interval.low) && std::isnan(interval.high)) return std::string();
    return fmt::format(" [{}, {}]", share(interval.low), share(interval.high));
}

/// Words in lines of at most line_width.
void print_wrapped(std::string_view text) {
    while (text.size() > line_width) {
        std::size_t const end = text.rfind(' ', line_width);
        if (end == std::string_view::npos) break;
        fmt::print("{}\n", text.substr(0, end));
        text.remove_prefix(end + 1);
    }
    fmt::print("{}\n", text);
}

struct Names {
    std::size_t name = 8, unit = 4;  // widths
};

Names widths_of(ToleranceReport const& report) {
    Names widths;
    for (ColumnStatistics const& entry : report.columns) {
        widths.name = std::max(widths.name, entry.column.name().size());
        widths.unit = std::max(widths.unit, entry.column.unit.size());
    }
    return widths;
}

void print_moments(ToleranceReport const& report, Names const& widths) {
    fmt::print("\nMean with its {:.0f} % interval, spread and ends:\n", 100 * confidence_level);
    auto const row = [&](std::string_view name, std::string_view unit, auto const&... cells) {
        fmt::print("  {:<{}}  {:<{}}", name, widths.name, unit, widths.unit);
        (fmt::print("  {:>10}", cells), ...);
        fmt::print("\n");
    };
    row("quantity", "unit", "n", "mean", "low", "high", "sd", "min", "max");
    for (ColumnStatistics const& entry : report.columns) {
        Summary const& s = entry.summary;
        row(entry.column.name(), entry.column.unit, s.count, number(s.mean), number(entry.mean.low),
            number(entry.mean.high), number(s.sd), number(s.min), number(s.max));
    }
}

void print_quantiles(ToleranceReport const& report, Names const& widths) {
    fmt::print("\nQuantiles (their intervals are in the file):\n  {:<{}}", "quantity", widths.name);
    for (double const p : reported_quantiles) fmt::print("{:>10}", fmt::format("{:.4g} %", 100 * p));
    fmt::print("\n");
    for (ColumnStatistics const& entry : report.columns) {
        fmt::print("  {:<{}}", entry.column.name(), widths.name);
        for (QuantileEstimate const& quantile : entry.quantiles) {
            fmt::print("{:>10}", std::isnan(quantile.value) ? std::string("-") : fmt::format("{:.3g}", quantile.value));
        }
        fmt::print("\n");
    }
}

std::string range_text(Limit const& limit, std::string const& unit) {
    bool const low = std::isfinite(limit.low), high = std::isfinite(limit.high);
    if (low && high) return fmt::format("{:.6g} to {:.6g} {}", limit.low, limit.high, unit);
    return low ? fmt::format(">= {:.6g} {}", limit.low, unit) : fmt::format("<= {:.6g} {}", limit.high, unit);
}

void print_yields(ToleranceReport const& report) {
    if (!report.all_met) return;
    fmt::print("\nYield, of {} members that ran, with its {:.0f} % interval:\n", report.all_met->trials,
               100 * confidence_level);
    std::size_t name = 10, range = 5;
    for (LimitYield const& limit : report.limits) {
        name = std::max(name, limit.limit.name().size());
        range = std::max(range, range_text(limit.limit, limit.unit).size());
    }
    auto const percent = [](double value) {
        return std::isnan(value) ? std::string("-") : fmt::format("{:.3f}", 100 * value);
    };
    auto const row = [&](std::string_view limit, std::string_view text, Proportion const& met) {
        fmt::print("  {:<{}}  {:<{}}  {:>10}  {:>9}  {:>9}  {:>9}\n", limit, name, text, range, met.successes,
                   percent(met.value), percent(met.interval.low), percent(met.interval.high));
    };
    fmt::print("  {:<{}}  {:<{}}  {:>10}  {:>9}  {:>9}  {:>9}\n", "quantity", name, "limit", range, "met", "yield [%]",
               "low", "high");
    for (LimitYield const& limit : report.limits)
        row(limit.limit.name(), range_text(limit.limit, limit.unit), limit.met);
    row("all limits", "", *report.all_met);
}

/// The first inputs of a ranking after the quantity's name, as many as asked for; lines go on below where they are
/// full.
void print_ranked(std::string const& name, std::size_t width, std::vector<std::string> const& cells) {
    std::string line = fmt::format("  {:<{}}", name, width);
    std::size_t const indent = line.size();
    for (std::string const& cell : cells) {
        if (line.size() > indent && line.size() + 2 + cell.size() > line_width) {
            fmt::print("{}\n", line);
            line = std::string(indent, ' ');
        }
        line += std::string("  ") + cell;
    }
    fmt::print("{}\n", line);
}

/// Nothing tells inputs apart for an output that does not vary.
std::vector<std::string> cells_or_dash(std::vector<std::string> cells) {
    if (cells.empty()) cells.emplace_back("-");
    return cells;
}

void print_indices(ToleranceReport const& report, Names const& widths) {
    if (!report.indices) return;
    IndexReport const& indices = *report.indices;
    fmt::print("\nSobol indices with {:.0f} % intervals, the largest total first, of {} rows of the design",
               100 * confidence_level, indices.used());
    if (indices.failed > 0) fmt::print("; {} left out for a failed member", indices.failed);
    if (indices.incomplete > 0) fmt::print("; {} incomplete", indices.incomplete);
    std::size_t input_width = std::string_view("all first orders").size();
    for (std::string const& input : report.inputs) input_width = std::max(input_width, input.size());
    auto const row = [&](std::string_view quantity, std::string_view input, std::string_view first,
                         std::string_view total) {
        fmt::print("  {:<{}}  {:<{}}  {:<24}  {}\n", quantity, widths.name, input, input_width, first, total);
    };
    auto const cell = [](IndexEstimate const& index) { return share(index.value) + interval_text(index.interval); };
    fmt::print("\n");
    row("quantity", "input", "first order", "total");
    for (ColumnIndices const& entry : indices.columns) {
        SobolIndices const& found = entry.indices;
        std::string name = entry.column.name();
        for (std::size_t rank = 0; rank < std::min(top_inputs, entry.ranking.size()); ++rank) {
            std::size_t const input = entry.ranking[rank];
            // Nothing tells inputs apart for an output that does not vary.
            if (std::isnan(found.total[input].value)) break;
            row(std::exchange(name, {}), report.inputs[input], cell(found.first[input]), cell(found.total[input]));
        }
        if (name.empty())
            row("", "all first orders", cell(found.first_sum), "");
        else
            row(name, "-", "", "");
    }
}

void print_correlations(ToleranceReport const& report, Names const& widths) {
    if (report.correlations.empty()) return;
    fmt::print(
        "\nRank correlations, the strongest first\n  {:<{}}  R² of the linear regression; correlation [interval]\n",
        "quantity", widths.name);
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
        print_ranked(entry.column.name(), widths.name, cells_or_dash(std::move(cells)));
    }
}

}  // namespace

void print_tolerance(ToleranceReport const& report) {
    fmt::print("\nTolerances, design {}; members by how they ended:\n", name_of(report.design));
    print_statuses(report.statuses);
    print_wrapped(report.policy);
    print_wrapped("Intervals: " + report.intervals + ".");
    if (!report.quantile_error.empty()) print_wrapped("Quantiles are sketched: " + report.quantile_error + ".");
    auto const has_values = [](ColumnStatistics const& entry) { return entry.summary.count > 0; };
    if (std::none_of(report.columns.begin(), report.columns.end(), has_values)) {
        fmt::print("\nThere are no distributions: no member finished, or no quantity is stored.\n");
    } else {
        Names const widths = widths_of(report);
        print_moments(report, widths);
        print_quantiles(report, widths);
        print_yields(report);
        print_indices(report, widths);
        print_correlations(report, widths);
        return;
    }
    print_yields(report);
}

}  // namespace slideway::cli
