// The shared members of a problem as a file: for programs outside that are compared with ours.
#pragma once

#include <filesystem>

#include "bench/work_precision/problem.hpp"

namespace slideway::bench {

/// Writes a CSV with a row for each member whose error counts: its numbers by name, the end time, and of each component of the state the
/// scale of the error's norm and the reference.  Does nothing where the measure is not the state.
void write_members(std::filesystem::path const& file, Problem const& problem);

}  // namespace slideway::bench
