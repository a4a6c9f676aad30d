#include "host/study/orbit_summary.hpp"

#include <algorithm>
#include <cmath>

#include "kernels/status.hpp"

namespace slideway {
namespace {

std::vector<char> finished_members(ResultReader const& results) {
    std::vector<char> finished;
    for (double const status : results.values("status")) {
        finished.push_back(static_cast<Status>(static_cast<signed char>(status)) == Status::finished);
    }
    return finished;
}

/// Column j of the rows of `width` numbers whose member finished.
std::vector<double> column_of(std::vector<double> const& values, std::vector<char> const& finished, std::size_t width,
                              std::size_t j) {
    std::vector<double> column;
    for (std::size_t i = 0; i < finished.size(); ++i) {
        if (finished[i]) column.push_back(values[i * width + j]);
    }
    return column;
}

/// 97.5 % quantile of Student's t for some 15 batches, the fewest of a member with as many records as a study has at least.
constexpr double quantile_of_batches = 2.13;

}  // namespace

std::vector<ExponentSummary> summarise_exponents(ResultReader const& results) {
    std::vector<ExponentSummary> summaries;
    if (!results.has("lyapunov_exponent")) return summaries;
    auto const finished = finished_members(results);
    auto const values = results.values("lyapunov_exponent"), errors = results.values("lyapunov_exponent_error");
    auto const resolutions = column_of(results.values("lyapunov_resolution"), finished, 1, 0);
    std::size_t const exponents = results.shape("lyapunov_exponent").at(1);
    for (std::size_t j = 0; j < exponents; ++j) {
        std::vector<double> const of_members = column_of(values, finished, exponents, j);
        std::vector<double> const their_errors = column_of(errors, finished, exponents, j);
        ExponentSummary& summary = summaries.emplace_back();
        summary.mean = mean_of_members(of_members);
        summary.values = summarise(of_members);
        std::vector<double> sorted;
        for (double const x : of_members) {
            if (!std::isnan(x)) sorted.push_back(x);
        }
        std::sort(sorted.begin(), sorted.end());
        summary.low = quantile(sorted, 0.05);
        summary.high = quantile(sorted, 0.95);
        for (std::size_t i = 0; i < of_members.size(); ++i) {
            double const reach = quantile_of_batches * their_errors[i] + resolutions[i];
            if (of_members[i] - reach > 0)
                ++summary.positive;
            else if (of_members[i] + reach < 0)
                ++summary.negative;
            else
                ++summary.undecided;
        }
    }
    return summaries;
}

std::vector<HistoryPoint> exponent_history(ResultReader const& results) {
    std::vector<HistoryPoint> history;
    if (!results.has("lyapunov_history")) return history;
    auto const finished = finished_members(results);
    auto const values = results.values("lyapunov_history"), rescalings = results.values("history");
    std::size_t const exponents = results.shape("lyapunov_history").at(2);
    for (std::size_t n = 0; n < rescalings.size(); ++n) {
        history.push_back(
            {rescalings[n],
             mean_of_members(column_of(values, finished, rescalings.size() * exponents, n * exponents))});
    }
    return history;
}

std::optional<SectionSummary> summarise_sections(ResultReader const& results) {
    if (!results.has("section_count")) return std::nullopt;
    auto const finished = finished_members(results);
    auto const counts = results.values("section_count");
    auto const crossings = results.has("section_crossings") ? results.values("section_crossings") : counts;
    SectionSummary summary;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        summary.beyond += static_cast<std::uint64_t>(crossings[i] - counts[i]);
        summary.sections += static_cast<std::uint64_t>(counts[i]);
        if (finished[i] && counts[i] == 0) ++summary.without;
    }
    return summary;
}

}  // namespace slideway
