// Every method over every tolerance of a problem.
#pragma once

#include <string>
#include <vector>

#include "bench/work_precision/method.hpp"

namespace slideway::bench {

/// One method at one tolerance.
struct Row {
    std::string method, code;
    bool ours = false;
    double tolerance = 0;
    std::size_t members = 0;                 // fewer than the problem's where the time allowed ended the run
    std::size_t failures = 0;                // members that did not reach the end time; their error counts as infinite
    double median_error = 0, p95_error = 0;  // of Problem::measure
    double seconds = 0;                      // per member, one core, median of the repeats
    double evaluations = 0;                  // of the right-hand side, mean per member
    double friction_loss = 0, damping_loss = 0;  // [J], medians; Measure::energy alone
};

struct SweepOptions {
    double budget = 6;    // [s] for one method at one tolerance, once
    int repeats = 3;      // at most
    double long_run = 1;  // [s] what takes this long is not repeated
};

/// Rows by method, then by tolerance.  Repeats of different methods take turns, so that a slow spell of the machine meets
/// all of them. A method that cannot do a quarter of the members within the budget is not asked for finer tolerances.
std::vector<Row> sweep(Problem const& problem, std::vector<Method> const& methods, SweepOptions const& options);

/// Value below or at which a fraction of the values lies (nearest rank).
double percentile(std::vector<double> values, double fraction);

/// Least time [s] per member in which a method's p95 error meets the target, between its tolerances by log-log
/// interpolation; NaN if it never does.
double time_to_reach(double target, std::vector<Row> const& rows, std::string const& method, std::string const& code);

}  // namespace slideway::bench
