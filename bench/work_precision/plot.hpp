// One diagram per problem: log error against log time per member.
#pragma once

#include <filesystem>

#include "bench/work_precision/sweep.hpp"

namespace slideway::bench {

/// Writes an SVG: a line per method, p95 solid with marks, median thin and dashed.
void write_plot(std::filesystem::path const& file, Problem const& problem, std::vector<Row> const& rows);

}  // namespace slideway::bench
