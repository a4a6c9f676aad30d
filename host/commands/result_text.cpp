#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/commands/text.hpp"
#include "host/study/result_summary.hpp"
#include "host/study/verification.hpp"

namespace slideway::cli {
namespace {

std::string short_number(double value) { return cell(value, 4); }

std::string text(MeanOfMembers const& mean) { return fmt::format("{} ± {}", short_number(mean.mean), short_number(mean.half_width)); }

void print_history(std::vector<HistoryPoint> const& history) {
    if (history.empty()) return;
    std::size_t const shown = std::min<std::size_t>(5, history.size());
    std::vector<std::string> means;
    for (std::size_t i = 1; i <= shown; ++i) {
        HistoryPoint const& point = history[i * history.size() / shown - 1];
        means.push_back(fmt::format("{} after {:.0f}", text(point.mean), point.rescalings));
    }
    print_text(4, "  running mean of the largest [1/s]: {} rescalings", fmt::join(means, ", "));
}

/// What makes exponents wrong without a sign in their intervals.
void print_doubts(ResultReader const& results) {
    OffsetHealth const health = offset_health(results);
    if (health.grown > 0.01) {
        tell("warning: at {:.0f} % of the rescalings an offset had grown to the size of the joint: exponents are "
                   "too small; "
                   "rescale oftener (study.rescalings_per_revolution, study.dt) or use a smaller study.d0\n",
                   100 * health.grown);
    }
    if (health.lost > 0.01) {
        tell("warning: at {:.0f} % of the rescalings an offset had shrunk into rounding: exponents are upper bounds; "
            "rescale oftener or use a larger study.d0\n",
            100 * health.lost);
    }
}

/// What the members' own signs are, and that of the mean.
void print_signs(ExponentSummary const& largest) {
    std::string const powers = largest.power_of_time > 0 ? fmt::format(" ({} of them: {})", largest.power_of_time, words_of(ExponentSign::power_of_time)) : "";
    print_text(4, "  largest: {} members above zero, {} below, {} undecided{}; their mean: {}", largest.above, largest.below, largest.undecided, powers,
               words_of(largest.sign));
    if (largest.sign == ExponentSign::power_of_time) {
        print_text(4, "  In the second half of the record offsets grew or shrank by no more than t³ does, which has no exponent: a longer run tells them "
                      "apart, a longer transient leaves out what grew early.");
    }
}

/// Columns of a sweep, all of them or every n-th.
void print_sweep_columns(ResultReader const& results) {
    auto const columns = summarise_columns(results);
    if (columns.empty()) return;
    constexpr std::size_t most = 60;
    std::string const parameter = results.attribute("sweep_parameter");
    std::size_t const every = (columns.size() + most - 1) / most;
    print_out("\nLargest exponent [1/s] per column, ± the 95 % interval of the mean, and its sign{}:\n  {:>16}  {:>10}  {:>22}\n",
               every > 1 ? fmt::format(", every {}th column", every) : "",
               fmt::format("{} [{}]", parameter, results.unit(parameter)), "finished", "exponent");
    for (std::size_t i = 0; i < columns.size(); i += every) {
        SweepColumn const& c = columns[i];
        print_out("  {:>16.6g}  {:>10}  {:>22}  {}\n", c.value, fmt::format("{} of {}", c.finished, c.members), text(c.exponent.mean),
                   c.finished > 0 ? words_of(c.exponent.sign) : "");
    }
}

}  // namespace

void print_exponents(ResultReader const& results) {
    auto const exponents = summarise_exponents(results);
    if (exponents.empty()) return;
    if (exponents.front().values.count == 0) {
        print_out("\nThere are no exponents: no member finished, or there was nothing to record.\n");
        return;
    }
    if (!results.attribute("sweep_parameter").empty()) {
        print_sweep_columns(results);
        print_doubts(results);
        return;
    }
    print_text(0, "\nLyapunov exponents [1/s] over the members that finished; ± is the 95 % interval of the mean:");
    auto const rows = [&](int digits) {
        TextRows table{{"exponent", "mean", "sd", "5 %", "median", "95 %", "max"}};
        for (std::size_t j = 0; j < exponents.size(); ++j) {
            ExponentSummary const& e = exponents[j];
            auto& row = table.emplace_back(std::vector<std::string>{std::to_string(j + 1), text(e.mean)});
            for (double const value : {e.values.sd, e.low, e.values.median, e.high, e.values.max}) row.push_back(cell(value, digits));
        }
        return table;
    };
    print_table(rows, 4, 1, 10);
    ExponentSummary const& largest = exponents.front();
    if (refutes_sign(results)) {
        print_text(4, "  largest: NOT RESOLVED: tighter tolerances do not confirm its sign (see below)");
    } else {
        print_signs(largest);
    }
    print_text(4, "  its second half alone: {}", text(largest.late));
    if (auto const turn = growth_per_turn(results)) print_text(4, "  growth of the first in a turn of the crank: {} (ln)", text(*turn));
    print_history(exponent_history(results));
    if (results.has("kaplan_yorke_dimension")) {
        Summary const dimension = summarise(results.values("kaplan_yorke_dimension"));
        print_text(4, "  Kaplan-Yorke dimension of the map over a turn: median {}, {} to {}", short_number(dimension.median),
                   short_number(dimension.min), short_number(dimension.max));
    }
    print_doubts(results);
}

void print_sections(ResultReader const& results) {
    auto const sections = summarise_sections(results);
    if (!sections) return;
    print_out("\n");
    print_field("sections", fmt::format("{} of all members", sections->sections));
    if (sections->beyond > 0) {
        tell("warning: {} more crossings are not stored: raise study.max_crossings\n", sections->beyond);
    }
    if (sections->without > 0) {
        tell("warning: {} never crossed the section: look at study.section, or at the orbit\n", counted(sections->without, "member"));
    }
}

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
    auto const text = [](Estimate const& index) { return share(index.value) + interval_text(index.interval); };
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
            Estimate const& estimate = entry.ranks[input];
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
