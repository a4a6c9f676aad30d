#include "host/study/orbit_summary.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "host/base/error.hpp"

namespace slideway {
namespace {

std::vector<char> finished_members(ResultView const& results) {
    std::vector<char> finished;
    for (double const status : results.values("status")) finished.push_back(status_of(status) == Status::finished);
    return finished;
}

/// Column j of the rows of `width` numbers whose member finished.
std::vector<double> finished_column(std::vector<double> const& values, std::vector<char> const& finished, std::size_t width,
                              std::size_t j) {
    std::vector<double> column;
    for (std::size_t i = 0; i < finished.size(); ++i) {
        if (finished[i]) column.push_back(values[i * width + j]);
    }
    return column;
}

/// What rounding may have added does not average out over members.
MeanOfMembers mean_with_rounding(std::vector<double> const& values, double resolution) {
    MeanOfMembers mean = mean_of_members(values);
    mean.half_width += resolution;
    return mean;
}

double largest_of(std::vector<double> const& values) {
    double largest = 0;
    for (double const x : values) largest = std::max(largest, std::isnan(x) ? 0.0 : x);
    return largest;
}

/// Of a member: the last of a variable's dimensions.  @throws FileError of a variable that has others, or none of them
std::size_t exponents_of(ResultView const& results, char const* variable = "lyapunov_exponent", char const* dimensions = "member, exponent") {
    auto const shape = results.shape(variable);
    auto const rank = static_cast<std::size_t>(std::ranges::count(std::string_view(dimensions), ',')) + 1;
    if (shape.size() == rank && shape.back() > 0) return shape.back();
    throw FileError(fmt::format("{}: {} is not ({})", results.path(), variable, dimensions));
}

}  // namespace

std::vector<ExponentSummary> summarise_exponents(ResultView const& results) {
    std::vector<ExponentSummary> summaries;
    if (!results.has("lyapunov_exponent")) return summaries;
    auto const finished = finished_members(results);
    std::size_t const exponents = exponents_of(results);
    std::size_t const count = finished.size() * exponents;
    auto const values = results.values("lyapunov_exponent", count), late = results.values("lyapunov_exponent_late", count);
    auto const half_widths = results.values("lyapunov_exponent_half_width", count);
    double const resolution = largest_of(finished_column(results.values("lyapunov_resolution", finished.size()), finished, 1, 0));
    for (std::size_t j = 0; j < exponents; ++j) {
        auto const of_members = finished_column(values, finished, exponents, j);
        auto const reach = finished_column(half_widths, finished, exponents, j);
        auto const of_late = finished_column(late, finished, exponents, j);
        ExponentSummary& summary = summaries.emplace_back();
        summary.mean = mean_with_rounding(of_members, resolution);
        summary.late = mean_with_rounding(of_late, resolution);
        summary.values = summarise(of_members);
        std::vector<double> sorted = of_members;
        std::erase_if(sorted, [](double x) { return std::isnan(x); });
        std::ranges::sort(sorted);
        summary.low = quantile(sorted, 0.05);
        summary.high = quantile(sorted, 0.95);
        for (std::size_t i = 0; i < of_members.size(); ++i) {
            // Of growth at the start alone nothing is left in the second half.
            if (of_members[i] - reach[i] > 0 && of_late[i] > 0)
                ++summary.positive;
            else if (of_members[i] + reach[i] < 0)
                ++summary.negative;
            else
                ++summary.undecided;
        }
    }
    std::stable_sort(summaries.begin(), summaries.end(),
                     [](auto const& a, auto const& b) { return a.mean.mean > b.mean.mean; });
    return summaries;
}

OffsetHealth offset_health(ResultView const& results) {
    auto const finished = finished_members(results);
    double const exponents = static_cast<double>(exponents_of(results));
    auto const share = [&](char const* name) {
        auto const counts = finished_column(results.values(name, finished.size()), finished, 1, 0);
        auto const rescalings = finished_column(results.values("rescalings", finished.size()), finished, 1, 0);
        double counted = 0, all = 0;
        for (std::size_t i = 0; i < counts.size(); ++i) counted += counts[i], all += exponents * rescalings[i];
        return all > 0 ? counted / all : 0.0;
    };
    return {share("lost_offsets"), share("grown_offsets")};
}

std::vector<SweepColumn> summarise_columns(ResultView const& results) {
    std::vector<SweepColumn> columns;
    std::string const parameter = results.attribute("sweep_parameter");
    if (parameter.empty()) return columns;
    auto const finished = finished_members(results);
    auto const values = results.values(parameter, finished.size());
    bool const has_exponents = results.has("lyapunov_exponent");
    std::size_t const width = has_exponents ? exponents_of(results) : 0;
    auto const exponents = has_exponents ? results.values("lyapunov_exponent", values.size() * width) : std::vector<double>{};
    std::vector<double> of_column;
    for (std::size_t i = 0; i < values.size(); ++i) {
        bool const is_new = columns.empty() || values[i] != columns.back().value;
        if (is_new) {
            columns.push_back({values[i], 0, 0, {}});
            of_column.clear();
        }
        SweepColumn& column = columns.back();
        ++column.members;
        if (!finished[i]) continue;
        ++column.finished;
        if (has_exponents) of_column.push_back(exponents[i * width]);
        column.exponent = mean_of_members(of_column);
    }
    return columns;
}

std::vector<HistoryPoint> exponent_history(ResultView const& results) {
    std::vector<HistoryPoint> history;
    if (!results.has("lyapunov_history")) return history;
    auto const finished = finished_members(results);
    auto const rescalings = results.values("history");
    std::size_t const exponents = exponents_of(results, "lyapunov_history", "member, history, exponent");
    auto const values = results.values("lyapunov_history", finished.size() * rescalings.size() * exponents);
    for (std::size_t n = 0; n < rescalings.size(); ++n) {
        history.push_back({rescalings[n], mean_of_members(finished_column(values, finished, rescalings.size() * exponents, n * exponents))});
    }
    return history;
}

std::optional<SectionSummary> summarise_sections(ResultView const& results) {
    if (!results.has("section_count")) return std::nullopt;
    auto const finished = finished_members(results);
    auto const counts = results.values("section_count", finished.size());
    auto const crossings = results.has("section_crossings") ? results.values("section_crossings", counts.size()) : counts;
    SectionSummary summary;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        summary.beyond += count_of(crossings[i] - counts[i]);
        summary.sections += count_of(counts[i]);
        if (finished[i] && counts[i] == 0) ++summary.without;
    }
    return summary;
}

}  // namespace slideway
