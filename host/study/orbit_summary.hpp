// What a result file tells about the orbits of its members: exponents and sections.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "host/chaos/exponent_sign.hpp"
#include "host/statistics/summary.hpp"
#include "host/store/result_view.hpp"

namespace slideway {

/// One exponent over the members that finished [1/s].
struct ExponentSummary : ExponentOfMembers {
    Summary values;
    double low, high;  // 5 % and 95 % quantiles
};

/// The largest mean first; empty if the file holds none.
std::vector<ExponentSummary> summarise_exponents(ResultView const& results);

/// The first exponent as growth in a turn of the crank, over the members that finished; nothing if the file has none of cranks that turn freely.
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

}  // namespace slideway
