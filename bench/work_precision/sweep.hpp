// Every method over every tolerance of a problem.
#pragma once

#include <vector>

#include "bench/work_precision/method.hpp"
#include "bench/work_precision/row.hpp"

namespace slideway::bench {

struct SweepOptions {
    double budget = 8;    // [s] for one method at one tolerance, once
    int repeats = 3;      // at most
    double long_run = 1;  // [s] what takes this long is not repeated
};

/// Rows by method, then by tolerance.  Repeats of different methods take turns, so that a slow spell of the machine meets
/// all of them. Peers run the shared members, ours the whole ensemble where the time allows it. A method that cannot do a quarter of the members within the budget is not asked for finer tolerances.
std::vector<Row> sweep(Problem const& problem, std::vector<Method> const& methods, SweepOptions const& options);

}  // namespace slideway::bench
