// What a result file tells about its ensemble, for the end of a run and for `info`.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "host/run/member_set.hpp"
#include "host/statistics/summary.hpp"
#include "host/store/block_statistics.hpp"
#include "host/store/result_view.hpp"
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

}  // namespace slideway
