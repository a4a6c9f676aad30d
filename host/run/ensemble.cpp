#include "host/run/ensemble.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include <omp.h>

#include "host/run/block_buffers.hpp"
#include "host/run/shared_block.hpp"

namespace slideway {
namespace {

void add_block(EnsembleTotals& totals, BlockBuffers const& buffers, BlockResult const& result) {
    for (MemberRecord const& record : result.records) {
        if (record.status == Status::not_run) continue;
        ++totals.ended[static_cast<std::size_t>(record.status)];
        totals.steps_accepted += record.steps_accepted;
        totals.steps_rejected += record.steps_rejected;
        totals.stiff_steps += record.stiff_steps;
        totals.rhs_evaluations += record.rhs_evaluations;
        totals.jacobian_evaluations += record.jacobian_evaluations;
    }
    totals.lane_steps_executed += buffers.lane_steps_executed();
    totals.lane_steps_useful += buffers.lane_steps_useful();
}

/// The threads' common part of a run.
class Team {
public:
    Team(EnsemblePlan const& plan, MemberQueue& queue, BlockSink const& sink, StopRequest const& stop, int workers)
        : plan_(plan),
          queue_(queue),
          sink_(sink),
          stop_(stop),
          sizer_(plan.blocks, plan.members.count(), workers) {}

    /// Empty: there is nothing more to do.
    std::vector<std::uint64_t> next_places() {
        std::uint64_t wanted = 0, finished = 0;
        {
            std::lock_guard const lock(mutex_);
            if (reason_ == StopReason::none) reason_ = stop_.reason();
            if (failure_ || reason_ != StopReason::none) return {};
            wanted = sizer_.next(queue_.left());
            finished = std::exchange(unreported_, 0);
        }
        Stretch const stretch = queue_.take(wanted, finished);
        return plan_.members.members(stretch.first, stretch.count);
    }

    /// @return whether to go on.  @param ended how many members of the block did
    bool emit(BlockBuffers const& buffers, std::uint64_t& ended) {
        BlockResult const result = buffers.result();
        std::lock_guard const lock(mutex_);
        // A worker whose card failed does not undo what others have finished.
        if (sink_failed_) return false;
        // Recorded before the lock is given up: no other thread may offer its block to a sink that failed.
        try {
            sink_(result);
        } catch (...) {
            sink_failed_ = true;
            fail_locked(std::current_exception());
            return false;
        }
        std::uint64_t const before = totals_.done();
        add_block(totals_, buffers, result);
        ended = totals_.done() - before;
        unreported_ += ended;
        return !failure_;
    }

    void measured(std::uint64_t places, double seconds, double utilisation) {
        std::lock_guard const lock(mutex_);
        sizer_.measured(places, seconds, utilisation);
    }

    void fail(std::exception_ptr failure) {
        std::lock_guard const lock(mutex_);
        fail_locked(std::move(failure));
    }

    bool has_failed() const { return has_failed_; }

    /// After all threads have ended.
    EnsembleTotals totals() {
        if (failure_) std::rethrow_exception(failure_);
        // A block in work may be the first to hear of the stop.
        totals_.stopped = reason_ == StopReason::none ? stop_.reason() : reason_;
        return totals_;
    }

private:
    void fail_locked(std::exception_ptr failure) {
        if (failure_) return;
        failure_ = std::move(failure);
        has_failed_ = true;
        queue_.abandon();
    }

    EnsemblePlan const& plan_;
    MemberQueue& queue_;
    BlockSink const& sink_;
    StopRequest const& stop_;
    std::mutex mutex_;  // guards what follows and the sink
    BlockSizer sizer_;
    EnsembleTotals totals_;
    std::uint64_t unreported_ = 0;  // members that the queue does not know to be finished
    StopReason reason_ = StopReason::none;
    std::exception_ptr failure_;
    bool sink_failed_ = false;
    std::atomic<bool> has_failed_ = false;  // as failure_, for those who do not hold the mutex
};

/// Members of a block that others may be at work on.  What is not seen yet is seen the next time: a status is one byte.
#if defined(__GNUC__)
__attribute__((no_sanitize("thread")))
#endif
std::uint64_t ended_so_far(std::span<MemberRecord const> records) {
    static_assert(sizeof(Status) == 1);
    std::uint64_t ended = 0;
    for (std::size_t i = 0; i < records.size(); ++i) ended += records.data()[i].status != Status::not_run;
    return ended;
}

/// One thread of a team.
class Worker {
public:
    Worker(Team& team, Progress* progress, double weight) : team_(team), told_(progress != nullptr ? progress->worker(weight) : unheard_) {}

    /// Runs a block that says how far it is, and also ends when another has failed: members of it that have ended by then are kept.
    void run(BlockKernel const& kernel, Block& block) {
        Watch const watch{block.stop, block.stop_context, this, {block.records, block.members}};
        block.stop = [](void const* context, double covered) {
            auto const& [stop, of_stop, worker, records] = *static_cast<Watch const*>(context);
            worker->cover(worker->ended_ + covered);
            worker->look(records);
            return worker->team_.has_failed() || (stop != nullptr && stop(of_stop, covered));
        };
        block.stop_context = &watch;
        kernel(block);
    }

    bool emit(BlockBuffers const& buffers) {
        std::uint64_t ended = 0;
        bool const goes_on = team_.emit(buffers, ended);
        whole_ += ended;
        ended_ = static_cast<double>(whole_);
        cover(ended_);
        told_.ended.store(whole_, std::memory_order_relaxed);
        return goes_on;
    }

private:
    struct Watch {
        decltype(Block::stop) stop;
        void const* context;
        Worker* worker;
        std::span<MemberRecord const> records;
    };

    /// What members covered that were given up stays covered.
    void cover(double members) {
        if (members > told_.covered.load(std::memory_order_relaxed)) told_.covered.store(members, std::memory_order_relaxed);
    }

    /// Now and then: who asks, looks four times a second.
    void look(std::span<MemberRecord const> records) {
        constexpr auto often = std::chrono::milliseconds(100);
        auto const now = std::chrono::steady_clock::now();
        if (now < next_look_.load(std::memory_order_relaxed)) return;
        next_look_.store(now + often, std::memory_order_relaxed);
        told_.ended.store(whole_ + ended_so_far(records), std::memory_order_relaxed);
    }

    Team& team_;
    Progress::Worker unheard_, &told_;
    std::uint64_t whole_ = 0;  // members of the blocks before
    double ended_ = 0;         // the same, as a number
    std::atomic<std::chrono::steady_clock::time_point> next_look_{};  // of all who share a block
};

/// What a run has beside its plan.
struct RunContext {
    BlockSink const& sink;
    StopRequest const& stop;
    Progress* progress;
    double weight;
};

/// A run cut into blocks, a thread each.  @param workers threads that share the members; those beyond the plan's are of other ranks
EnsembleTotals run_blocks(EnsemblePlan const& plan, MemberQueue& queue, BlockProgram const& program, BlockKernel const& kernel, int workers,
                          RunContext const& context) {
    auto const start = std::chrono::steady_clock::now();
    Team team(plan, queue, context.sink, context.stop, workers);
#pragma omp parallel num_threads(std::min(workers, plan.threads))
    {
        // No exception may leave the parallel region.
        try {
            BlockBuffers buffers;
            Worker worker(team, context.progress, context.weight);
            BlockKernel const watched = [&](Block& block) { worker.run(kernel, block); };
            BlockEmit const emit = [&](BlockBuffers const& block) { return worker.emit(block); };
            for (auto places = team.next_places(); !places.empty(); places = team.next_places()) {
                auto const begin = std::chrono::steady_clock::now();
                program(watched, buffers, places, emit);
                team.measured(places.size(), seconds_since(begin), buffers.lane_utilisation());
            }
        } catch (...) {
            team.fail(std::current_exception());
        }
    }
    EnsembleTotals totals = team.totals();
    totals.seconds = seconds_since(start);
    return totals;
}

/// Whether all threads may work on one block: of so few members the ends of each thread's blocks would leave a good part of the lanes
/// idle.  Not where members are the program's, or another process takes some, or the user said how large blocks are.
bool may_be_one_block(EnsemblePlan const& plan) {
    return plan.threads > 1 && plan.workers <= plan.threads && !plan.program && plan.blocks.fixed == 0 && !plan.blocks.bounds.shared &&
           plan.members.count() <= std::min<std::uint64_t>(BlockSizer::untried, plan.blocks.bounds.most);
}

}  // namespace

int default_threads() { return omp_get_max_threads(); }

EnsembleTotals run_ensemble(EnsemblePlan const& plan, MemberQueue& queue, BlockKernel const& kernel,
                            BlockSink const& sink, StopRequest const& stop, Progress* progress, double weight) {
    RunContext const context{sink, stop, progress, weight};
    bool is_given_up = false;
    BlockProgram const once = [&](BlockKernel const& watched, BlockBuffers& buffers, std::span<std::uint64_t const> members,
                                  BlockEmit const& emit) {
        buffers.run(watched, plan.request, plan.source, stop, members);
        if (!is_given_up) emit(buffers);
    };
    if (!may_be_one_block(plan)) {
        return run_blocks(plan, queue, plan.program ? plan.program : once, kernel, std::max(plan.workers, plan.threads), context);
    }
    EnsemblePlan whole = plan;
    whole.blocks.fixed = plan.members.count();
    SharedBlockKernel const shared(kernel, plan.threads, plan.blocks.bounds.lanes, {.most = 2 * plan.blocks.seconds});
    BlockKernel const together = [&](Block& block) { is_given_up = shared.run(block) && stop.reason() == StopReason::none; };
    auto const totals = run_blocks(whole, queue, once, together, 1, context);
    if (!is_given_up) return totals;
    // Its second was lost; a process that is killed loses no more than blocks.
    is_given_up = false;
    LocalQueue again(plan.members.count());
    auto blocks = run_blocks(plan, again, once, kernel, plan.threads, context);
    blocks.seconds += totals.seconds;
    return blocks;
}

EnsembleTotals run_ensemble(EnsemblePlan const& plan, BlockKernel const& kernel, BlockSink const& sink,
                            StopRequest const& stop, Progress* progress, double weight) {
    LocalQueue queue(plan.members.count());
    return run_ensemble(plan, queue, kernel, sink, stop, progress, weight);
}

EnsembleTotals& EnsembleTotals::operator+=(EnsembleTotals const& other) {
    for (std::size_t i = 0; i < ended.size(); ++i) ended[i] += other.ended[i];
    steps_accepted += other.steps_accepted;
    steps_rejected += other.steps_rejected;
    stiff_steps += other.stiff_steps;
    rhs_evaluations += other.rhs_evaluations;
    jacobian_evaluations += other.jacobian_evaluations;
    lane_steps_executed += other.lane_steps_executed;
    lane_steps_useful += other.lane_steps_useful;
    seconds += other.seconds;
    if (stopped == StopReason::none) stopped = other.stopped;
    return *this;
}

double EnsembleTotals::lane_utilisation() const {
    return slideway::lane_utilisation(lane_steps_useful, lane_steps_executed);
}

namespace {

constexpr std::uint64_t blocks_per_worker = 2;  // of what is left, so that several workers end together
constexpr std::uint64_t enough_for_trials = 16;
// The last members of a block leave lanes idle, as much work as that of some members, whatever the block's size: 2 where all cost
// about the same, 25 where some settle and some rattle (scenes/tolerance_0.1mm.toml).
constexpr double blocks_over_idle = 40;

}  // namespace

BlockSizer::BlockSizer(BlockSizes const& sizes, std::uint64_t members, int workers)
    : sizes_(sizes), members_(members), workers_(static_cast<std::uint64_t>(workers)) {}

/// Members that make up the time that a block should take, as far as it may go.
std::uint64_t BlockSizer::in_time() const {
    auto const most = static_cast<double>(std::max<std::size_t>(sizes_.bounds.most, 1));
    return static_cast<std::uint64_t>(std::min(sizes_.seconds / seconds_per_member_, most));
}

std::uint64_t BlockSizer::next(std::uint64_t left) const {
    if (sizes_.fixed > 0) return sizes_.fixed;
    std::uint64_t const lanes = sizes_.bounds.lanes, most = std::max<std::uint64_t>(sizes_.bounds.most, 1);
    std::uint64_t const small = std::min<std::uint64_t>(sizes_.bounds.least, most);
    std::uint64_t const share = (left + workers_ - 1) / workers_;
    auto const worth_its_end = static_cast<std::uint64_t>(std::min(blocks_over_idle * idle_members_, 1e6));
    std::uint64_t const least = std::clamp<std::uint64_t>(share, 1, std::clamp(worth_its_end, small, most));
    std::uint64_t size = std::clamp<std::uint64_t>(share / (workers_ > 1 ? blocks_per_worker : 1), least, most);
    if (sizes_.bounds.shared) {
        // The first ones are no trials: they fill the machine.
        size = seconds_per_member_ > 0 ? std::max(in_time(), small) : small;
    } else if (seconds_per_member_ > 0) {
        size = std::clamp(in_time(), least, size);
    } else if (members_ >= enough_for_trials * small * workers_) {
        size = std::min(size, small);
    } else {
        // Small ensembles have no members to spare for trials.
        size = std::clamp<std::uint64_t>(untried, least, size);
    }
    std::uint64_t const rounded = (size + lanes - 1) / lanes * lanes;
    return rounded <= most ? rounded : size;
}

void BlockSizer::measured(std::uint64_t members, double seconds, double utilisation) {
    if (members == 0 || !(seconds > 0) || !(utilisation > 0)) return;
    seconds_per_member_ = seconds / static_cast<double>(members);
    // Of several blocks the dearest end counts: a later one may be as bad.
    idle_members_ = std::max(idle_members_, (1 / utilisation - 1) * static_cast<double>(members));
}

}  // namespace slideway
