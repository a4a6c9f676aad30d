// A method at a tolerance, and what rows say together.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace slideway::bench {

/// One method at one tolerance.
struct Row {
    std::string method, code;
    bool ours = false;
    double tolerance = 0;
    std::size_t ensemble = 0;                // members of the run that was timed
    std::size_t members = 0;                 // those whose error counts
    std::size_t failures = 0;                // members that did not reach the end time; their error counts as infinite
    double median_error = 0, p95_error = 0;  // of Problem::measure
    double seconds = 0;                      // per member, one core, median of the repeats
    double evaluations = 0;                  // of the right-hand side, mean over the shared members
    double friction_loss = 0, damping_loss = 0;  // [J], medians; Measure::energy alone
};

/// Value below or at which a fraction of the values lies (nearest rank).  @param values not empty.
inline double percentile(std::vector<double> values, double fraction) {
    std::ranges::sort(values);
    auto const rank = static_cast<std::size_t>(std::ceil(fraction * static_cast<double>(values.size())));
    return values[std::max<std::size_t>(rank, 1) - 1];
}

/// Least cost at which a method's p95 error meets the target, between its tolerances by log-log interpolation; NaN if it never
/// does.  @param rows of a problem, each method's from coarse to fine.  @param cost what counts, e.g. &Row::evaluations.
inline double cost_to_reach(double target, std::vector<Row> const& rows, std::string_view method, std::string_view code,
                            double Row::*cost) {
    double best = std::numeric_limits<double>::infinity();
    Row const* before = nullptr;
    for (auto const& row : rows) {
        if (row.method != method || row.code != code) continue;
        if (row.p95_error <= target) {
            best = std::min(best, row.*cost);
            if (before && before->p95_error > target && std::isfinite(before->p95_error) && row.p95_error > 0) {
                double const part = std::log(before->p95_error / target) / std::log(before->p95_error / row.p95_error);
                best = std::min(best, before->*cost * std::pow(row.*cost / before->*cost, part));
            }
        }
        before = &row;
    }
    return std::isfinite(best) ? best : std::numeric_limits<double>::quiet_NaN();
}

/// The least over all methods whose name begins with `family`.
inline double least_cost(double target, std::vector<Row> const& rows, std::string_view family, std::string_view code,
                         double Row::*cost) {
    double best = std::numeric_limits<double>::quiet_NaN();
    for (auto const& row : rows) {
        if (!row.method.starts_with(family) || row.code != code) continue;
        best = std::fmin(best, cost_to_reach(target, rows, row.method, code, cost));  // ignores NaN
    }
    return best;
}

/// cost_to_reach in seconds per member.
inline double time_to_reach(double target, std::vector<Row> const& rows, std::string_view method,
                            std::string_view code) {
    return cost_to_reach(target, rows, method, code, &Row::seconds);
}

}  // namespace slideway::bench
