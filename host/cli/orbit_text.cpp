#include "host/cli/orbit_text.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "host/study/orbit_summary.hpp"

namespace slideway::cli {
namespace {

std::string number(double value) { return std::isnan(value) ? std::string("-") : fmt::format("{:.4g}", value); }

void print_history(std::vector<HistoryPoint> const& history) {
    if (history.empty()) return;
    std::size_t const shown = std::min<std::size_t>(5, history.size());
    std::string line;
    for (std::size_t i = 1; i <= shown; ++i) {
        HistoryPoint const& point = history[i * history.size() / shown - 1];
        line += fmt::format("{}{} ± {} after {:.0f}", line.empty() ? "" : ", ", number(point.mean.mean),
                            number(point.mean.half_width), point.rescalings);
    }
    fmt::print("  running mean of the largest [1/s]: {} rescalings\n", line);
}

}  // namespace

void print_exponents(ResultReader const& results) {
    auto const exponents = summarise_exponents(results);
    if (exponents.empty()) return;
    if (exponents.front().values.count == 0) {
        fmt::print("\nNo member finished: there are no exponents.\n");
        return;
    }
    fmt::print("\nLyapunov exponents [1/s] over the members that finished; ± is the 95 % interval of the mean:\n");
    fmt::print("  {:<8}  {:>22}  {:>10}  {:>10}  {:>10}  {:>10}  {:>10}\n", "exponent", "mean", "sd", "5 %", "median",
               "95 %", "max");
    for (std::size_t j = 0; j < exponents.size(); ++j) {
        ExponentSummary const& e = exponents[j];
        fmt::print("  {:<8}  {:>22}  {:>10}  {:>10}  {:>10}  {:>10}  {:>10}\n", j + 1,
                   fmt::format("{} ± {}", number(e.mean.mean), number(e.mean.half_width)), number(e.values.sd),
                   number(e.low), number(e.values.median), number(e.high), number(e.values.max));
    }
    ExponentSummary const& largest = exponents.front();
    fmt::print("  largest: {} members above zero, {} below, {} undecided by their own 95 % intervals\n", largest.positive,
               largest.negative, largest.undecided);
    print_history(exponent_history(results));
}

void print_sections(ResultReader const& results) {
    auto const sections = summarise_sections(results);
    if (!sections) return;
    fmt::print("\n");
    print_field("sections", fmt::format("{} of all members", sections->sections));
    if (sections->beyond > 0) {
        fmt::print(stderr, "warning: {} more crossings are not stored: raise study.max_crossings\n", sections->beyond);
    }
    if (sections->without > 0) {
        fmt::print(stderr, "warning: {} member{} never crossed the section: look at study.section, or at the orbit\n",
                   sections->without, sections->without == 1 ? "" : "s");
    }
}

}  // namespace slideway::cli
