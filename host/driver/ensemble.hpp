// Runs an ensemble: blocks of members over threads, results to a sink.
#pragma once

#include <array>
#include <cstdint>

#include "host/backend/backend.hpp"
#include "host/driver/block_buffers.hpp"
#include "host/driver/block_result.hpp"
#include "host/driver/progress.hpp"
#include "host/driver/stop.hpp"

namespace slideway {

struct EnsemblePlan {
    std::uint64_t first_member = 0;
    std::uint64_t members = 1;
    std::size_t block_members = 64;
    int threads = 1;
    BlockRequest request;
    MemberSource source;
};

/// What a run came to.  Sums of whole numbers, so the same for every order of the blocks.
struct EnsembleTotals {
    std::array<std::uint64_t, status_count> ended{};  // by status
    std::uint64_t not_run = 0;
    std::uint64_t steps_accepted = 0, steps_rejected = 0, stiff_steps = 0;
    std::uint64_t rhs_evaluations = 0, jacobian_evaluations = 0;
    std::uint64_t lane_steps_executed = 0, lane_steps_useful = 0;
    double seconds = 0;                     // wall time
    StopReason stopped = StopReason::none;  // none if every member ran, whatever was asked for

    std::uint64_t failed() const;     // members that ended otherwise than finished
    double lane_utilisation() const;  // useful / executed lane steps; 1 if there were none
    EnsembleTotals& operator+=(EnsembleTotals const& later);
};

/// Threads that this process may use at once (OMP_NUM_THREADS, else the processors it may run on).
int default_threads();

/// A multiple of the lanes, at most 512: enough members to keep the lanes full, few enough for several blocks a thread.
std::size_t default_block_members(std::uint64_t members, int threads, int lanes);

/// Integrates every member of the plan, or those that were handed out before `stop` said to end.  A member's result
/// depends neither on the threads nor on the blocks.  `progress` may be nullptr.
/// @throws what the sink or the member source throws first, after the blocks in work have ended.
EnsembleTotals run_ensemble(EnsemblePlan const& plan, KernelInstance const& kernel, BlockSink const& sink,
                            StopRequest const& stop, Progress* progress = nullptr);

}  // namespace slideway
