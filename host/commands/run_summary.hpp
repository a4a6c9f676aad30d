// What a run tells when it has ended.
#pragma once

#include <cstdint>
#include <optional>

#include "host/commands/commands.hpp"
#include "host/config/scene.hpp"
#include "host/run/ensemble.hpp"
#include "host/store/result_view.hpp"
#include "host/study/tolerance_report.hpp"

namespace slideway::cli {

/// Members that ended otherwise than finished.
std::uint64_t failed_count(ResultReader const& results);

/// To stderr: that numbers are not resolved.
void warn_of_results(ResultReader const& results);

/// What this run computed, and how fast.
void print_throughput(Scene const& scene, StudyOptions const& options, EnsembleTotals const& totals, int ranks);

/// All members of the file: how they ended, statistics, and what to do about those that failed.
/// @param arguments those of the command that replays a member
/// @param report of a scene that `asks_for_report`
void print_results(RunArguments const& arguments, Scene const& scene, ResultReader const& results,
                   std::optional<ToleranceReport> const& report);

}  // namespace slideway::cli
