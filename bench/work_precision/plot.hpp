// One diagram per problem: log error against log time per member.
#pragma once

#include <filesystem>

#include "bench/work_precision/sweep.hpp"

namespace slideway::bench {

/// Writes an SVG: a line per method, p95 solid with marks, median thin and dashed.
/// @param methods all that may have rows, so that one method looks the same in the plots of all problems.
void write_plot(std::filesystem::path const& file, Problem const& problem, std::vector<Row> const& rows,
                std::vector<Method> const& methods);

}  // namespace slideway::bench
