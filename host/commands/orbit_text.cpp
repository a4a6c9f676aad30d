#include "host/commands/text.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/study/orbit_summary.hpp"
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

}  // namespace slideway::cli
