// What commands say with --json: one object on stdout, as docs/reference/json.md describes it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "host/commands/commands.hpp"
#include "host/run/ensemble.hpp"
#include "host/store/result_view.hpp"
#include "host/study/prediction.hpp"
#include "host/study/probe.hpp"
#include "host/study/series_analysis.hpp"
#include "host/study/state_table.hpp"
#include "host/study/tolerance_report.hpp"

namespace slideway::cli {

inline constexpr int json_version = 1;

/// Provenance, dimensions, statuses, statistics over the members that finished, exponents, sections and what the check of the resolution found; of a damaged
/// file provenance and dimensions alone.
/// @param report of a scene that `asks_for_report`  @param totals of the run that has just made it, or nullptr  @param left members that have not run
/// @param members to list one by one  @param scene of the run, which has labels of members
std::string result_json(char const* command, ResultReader const& results, SealCheck const& seal, std::optional<ToleranceReport> const& report,
                        EnsembleTotals const* totals = nullptr, std::uint64_t left = 0, std::optional<MemberRange> const& members = {},
                        Scene const* scene = nullptr);
/// A run that ended before its result.
std::string stopped_json(std::string const& folder, std::uint64_t left);
/// @param trial nothing where no member was tried
std::string check_json(Scene const& scene, Prediction const& prediction, std::optional<Trial> const& trial, Backend const& backend);
struct ProbedStates {
    std::string const& path;  // of the scene or the result
    StateTable const& table;
    std::vector<ProbeResult> const& results;
    std::optional<StoredState> const& stored;  // where the state is from
    bool explained;
};
std::string probe_json(ProbedStates const& probed);
std::string stats_json(StatsArguments const& arguments, std::string const& series, SeriesAnalysis const& analysis,
                       std::vector<std::pair<std::string, std::string>> const& rows);

}  // namespace slideway::cli
