// What a run came to.
#pragma once

#include <array>
#include <cstdint>

#include "host/run/stop.hpp"
#include "kernels/status.hpp"

namespace slideway {

/// What a run came to.  Sums of whole numbers, so the same for every order of the blocks.
struct EnsembleTotals {
    std::array<std::uint64_t, status_count> ended{};  // by status
    std::uint64_t steps_accepted = 0, steps_rejected = 0, stiff_steps = 0;
    std::uint64_t rhs_evaluations = 0, jacobian_evaluations = 0;
    std::uint64_t lane_steps_executed = 0, lane_steps_useful = 0;
    double seconds = 0;                     // wall time
    StopReason stopped = StopReason::none;  // whatever was still to do

    std::uint64_t done() const;                               // members that ended, well or not
    std::uint64_t failed() const;                             // otherwise than finished
    double lane_utilisation() const;                          // useful / executed lane steps; 1 if there were none
    EnsembleTotals& operator+=(EnsembleTotals const& other);  // of another rank; seconds too
};

}  // namespace slideway
