// Runs an ensemble: blocks of members over threads, results to a sink.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numeric>
#include <span>

#include "host/backend/backend.hpp"
#include "host/run/block_buffers.hpp"
#include "host/run/member_queue.hpp"
#include "host/run/member_set.hpp"
#include "host/run/progress.hpp"
#include "host/run/stop.hpp"
#include "kernels/status.hpp"

namespace slideway {

/// How many members a worker takes at once.
struct BlockSizes {
    std::size_t fixed = 0;  // > 0: always so many
    BlockBounds bounds;
    double seconds = 10;  // that a block should take: a process that is killed loses the blocks it works on
};

/// On a processor, where workers have a core each:
/// the last members of a block leave lanes idle, so blocks should be large; a crash loses those in work, and the last ones of a run leave
/// threads idle, so they should be small.  Large ensembles begin with small blocks, whose time tells how many members make up
/// `seconds`, and how much work their ends leave undone; towards the end of the run blocks shrink with what is left.
/// On a machine that workers share a block is never less than fills it, whatever their number: two kernels that fill half a card each
/// take as long as one that fills it, and the ends of some blocks overlap with others.
class BlockSizer {
public:
    static constexpr std::uint64_t untried = 512;  // members of a block whose cost nobody knows, at most
    /// @param workers threads of all ranks.
    BlockSizer(BlockSizes const& sizes, std::uint64_t members, int workers);
    /// @param left members that nobody has taken.
    std::uint64_t next(std::uint64_t left) const;
    /// What a block took.  @param utilisation of its lanes, useful over executed lane steps
    void measured(std::uint64_t members, double seconds, double utilisation);

private:
    std::uint64_t in_time() const;

    BlockSizes const sizes_;
    std::uint64_t const members_, workers_;
    double seconds_per_member_ = 0;  // 0: not known yet
    double idle_members_ = 0;        // what the end of a block leaves idle, in members' work
};

/// Hands a block's results on.  @return whether to go on: false once the run has failed.
using BlockEmit = std::function<bool(BlockBuffers const&)>;

/// What a worker does with the places of the run that it took; what it emits need not be one block.
/// @param kernel the run's, for blocks that are emitted: their progress is told
using BlockProgram = std::function<void(BlockKernel const& kernel, BlockBuffers& buffers, std::span<std::uint64_t const> places,
                                        BlockEmit const& emit)>;

struct EnsemblePlan {
    MemberSet members;  // what is to run; with a program: its places
    BlockSizes blocks;
    int threads = 1;
    int workers = 1;  // threads of all ranks
    BlockRequest request;
    MemberSource source;
    BlockProgram program;  // empty: integrates the members it took
};

/// What a run came to.  Sums of whole numbers, so the same for every order of the blocks.
struct EnsembleTotals {
    std::array<std::uint64_t, status_count> ended{};  // by status
    std::uint64_t steps_accepted = 0, steps_rejected = 0, stiff_steps = 0;
    std::uint64_t rhs_evaluations = 0, jacobian_evaluations = 0;
    std::uint64_t lane_steps_executed = 0, lane_steps_useful = 0;
    double seconds = 0;                     // wall time
    StopReason stopped = StopReason::none;  // whatever was still to do

    std::uint64_t done() const { return std::accumulate(ended.begin(), ended.end(), std::uint64_t{0}); }  // well or not
    std::uint64_t failed() const { return done() - ended[static_cast<std::size_t>(Status::finished)]; }  // otherwise than finished
    double lane_utilisation() const;                          // useful / executed lane steps; 1 if there were none
    EnsembleTotals& operator+=(EnsembleTotals const& other);  // of another rank; seconds too
};

/// Threads that this process may use at once (OMP_NUM_THREADS, else the processors it may run on).
int default_threads();

/// Integrates the members of the plan, or those that were handed out before `stop` said to end.  A member's result depends neither on
/// the threads nor on the blocks.  `progress` may be nullptr, and hears of blocks in work too.
/// @param weight of a member's work in the progress
/// @throws what the sink, the kernel or the member source throws first; the queue is then abandoned, and the blocks in work end soon:
/// what of them is finished goes to the sink, unless that has failed.
EnsembleTotals run_ensemble(EnsemblePlan const& plan, MemberQueue& queue, BlockKernel const& kernel,
                            BlockSink const& sink, StopRequest const& stop, Progress* progress = nullptr, double weight = 1);

/// The same by this process alone.
EnsembleTotals run_ensemble(EnsemblePlan const& plan, BlockKernel const& kernel, BlockSink const& sink,
                            StopRequest const& stop, Progress* progress = nullptr, double weight = 1);

}  // namespace slideway
