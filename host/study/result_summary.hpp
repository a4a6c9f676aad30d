// What a result file tells: about its ensemble and its orbits, for the end of a run and for `info`, and as tables for other programs.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "host/chaos/exponents.hpp"
#include "host/run/member_set.hpp"
#include "host/statistics/summary.hpp"
#include "host/store/block_statistics.hpp"
#include "host/store/result_view.hpp"
#include "host/store/table_file.hpp"
#include "kernels/status.hpp"

namespace slideway {

/// One column of a quantity over the members that finished; the others have no say, unstable ones neither.
struct QuantitySummary {
    std::string label;  // "drive_work", "mode_time[free]", "peak_apex_force[P1]"
    std::string unit;
    Summary values;
};
/// In the order of the file.
std::vector<QuantitySummary> summarise_quantities(ResultView const& results);

struct StatusCount {
    Status status;
    std::uint64_t members;
};
/// By a status's byte: not_run, the largest, is the last.
using StatusCounts = std::map<unsigned char, std::uint64_t>;
std::vector<StatusCount> listed(StatusCounts const& counts);
/// Statuses that occur; not_run last.
std::vector<StatusCount> count_statuses(ResultView const& results);

/// How a member ended.
struct MemberRow {
    std::uint64_t number;
    Status status;
    double time;  // [s]; NaN of one that has not run
    std::uint64_t steps_accepted, steps_rejected;
    std::string label;  // that its table gives it
};
/// Of the members whose numbers lie in the range, in the order of the file.  @throws SceneError where there are none, or the file keeps no members
std::vector<MemberRow> member_rows(ResultView const& results, MemberRange const& range);

/// The first `limit` members that ran and did not finish; where members are not stored, of those that are kept by
/// number.
std::vector<FailedMember> failed_members(ResultView const& results, std::size_t limit);

/// "finished", also "not_run".
std::string name_of(Status status);

/// One exponent over the members that finished [1/s].
struct ExponentSummary : ExponentOfMembers {
    Summary values;
    double low, high;  // 5 % and 95 % quantiles
};

/// The largest first; empty if the file holds none.
std::vector<ExponentSummary> summarise_exponents(ResultView const& results);

/// The largest exponent as growth in a turn of the crank, over the members that finished; nothing if the file has none of cranks that turn freely.
std::optional<MeanOfMembers> growth_per_turn(ResultView const& results);

/// Shares of the rescalings at which an offset had shrunk into rounding, or grown to the size of the joint.
struct OffsetHealth {
    double lost, grown;
};
OffsetHealth offset_health(ResultView const& results);

/// Members of one value of a sweep's parameter.
struct SweepColumn {
    double value;
    std::uint64_t members, finished;
    ExponentOfMembers exponent;  // the largest one; of no members without exponents
};
/// In the file's order; empty if it is no sweep.
std::vector<SweepColumn> summarise_columns(ResultView const& results);

/// Ensemble mean of the largest exponent after so many rescalings, with its confidence interval.
struct HistoryPoint {
    double rescalings;
    MeanOfMembers mean;
};
std::vector<HistoryPoint> exponent_history(ResultView const& results);

struct SectionSummary {
    std::uint64_t sections = 0;  // of all members
    std::uint64_t without = 0;   // members that finished and have none
    std::uint64_t beyond = 0;    // crossings for which there was no room
};
/// Nothing if the file holds no sections.
std::optional<SectionSummary> summarise_sections(ResultView const& results);

// The tables of a result that other programs read: members, time series, sections.

// The view must outlive the tables, which read it when they are written.  Each throws SceneError where a result has no such table.

/// What a result says of each member: number, status, label, what varies under its key, quantities, and whatever else it has a number of.
ExportTable table_of_members(ResultView const& results);

/// @param names of series; none: all  @throws SceneError also for one that is not there
ExportTable table_of_series(ResultView const& results, std::vector<std::string> const& names);

ExportTable table_of_sections(ResultView const& results);

}  // namespace slideway
