#include "host/run/ensemble.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <mutex>
#include <numeric>
#include <utility>
#include <vector>

#include <omp.h>

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

}  // namespace

std::uint64_t EnsembleTotals::done() const { return std::accumulate(ended.begin(), ended.end(), std::uint64_t{0}); }

std::uint64_t EnsembleTotals::failed() const { return done() - ended[static_cast<std::size_t>(Status::finished)]; }

EnsembleTotals& EnsembleTotals::operator+=(EnsembleTotals const& later) {
    for (std::size_t i = 0; i < ended.size(); ++i) ended[i] += later.ended[i];
    steps_accepted += later.steps_accepted;
    steps_rejected += later.steps_rejected;
    stiff_steps += later.stiff_steps;
    rhs_evaluations += later.rhs_evaluations;
    jacobian_evaluations += later.jacobian_evaluations;
    lane_steps_executed += later.lane_steps_executed;
    lane_steps_useful += later.lane_steps_useful;
    seconds += later.seconds;
    if (stopped == StopReason::none) stopped = later.stopped;
    return *this;
}

double EnsembleTotals::lane_utilisation() const {
    return slideway::lane_utilisation(lane_steps_useful, lane_steps_executed);
}

int default_threads() { return omp_get_max_threads(); }

namespace {

/// The threads' common part of a run.
class Team {
public:
    Team(EnsemblePlan const& plan, MemberQueue& queue, BlockSink const& sink, StopRequest const& stop,
         Progress* progress)
        : plan_(plan),
          queue_(queue),
          sink_(sink),
          stop_(stop),
          progress_(progress),
          sizer_(plan.blocks, plan.members.count(), std::max(plan.workers, plan.threads)) {}

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

    bool emit(BlockBuffers const& buffers) {
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
        add_block(totals_, buffers, result);
        auto const members = static_cast<std::uint64_t>(result.records.size());
        unreported_ += members;
        if (progress_) progress_->add(members);
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

    /// Runs a block that also ends when another has failed: members of it that have ended by then are kept.
    void run(BlockKernel const& kernel, Block& block) const {
        struct Ends {
            decltype(Block::stop) stop;
            void const* context;
            std::atomic<bool> const* failed;
        } const ends{block.stop, block.stop_context, &has_failed_};
        block.stop = [](void const* context) {
            auto const& e = *static_cast<Ends const*>(context);
            return *e.failed || (e.stop != nullptr && e.stop(e.context));
        };
        block.stop_context = &ends;
        kernel(block);
    }

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
    Progress* const progress_;
    std::mutex mutex_;  // guards what follows and the sink
    BlockSizer sizer_;
    EnsembleTotals totals_;
    std::uint64_t unreported_ = 0;  // members that the queue does not know to be finished
    StopReason reason_ = StopReason::none;
    std::exception_ptr failure_;
    bool sink_failed_ = false;
    std::atomic<bool> has_failed_ = false;  // as failure_, for those who do not hold the mutex
};

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

EnsembleTotals run_ensemble(EnsemblePlan const& plan, MemberQueue& queue, BlockKernel const& kernel,
                            BlockSink const& sink, StopRequest const& stop, Progress* progress) {
    auto const start = std::chrono::steady_clock::now();
    Team team(plan, queue, sink, stop, progress);
    BlockEmit const emit = [&team](BlockBuffers const& buffers) { return team.emit(buffers); };
    BlockKernel const watched = [&](Block& block) { team.run(kernel, block); };
    BlockProgram const once = [&](BlockBuffers& buffers, std::span<std::uint64_t const> members, BlockEmit const&) {
        buffers.run(watched, plan.request, plan.source, stop, members);
        emit(buffers);
    };
    BlockProgram const& program = plan.program ? plan.program : once;

#pragma omp parallel num_threads(plan.threads)
    {
        // No exception may leave the parallel region.
        try {
            BlockBuffers buffers;
            for (auto places = team.next_places(); !places.empty(); places = team.next_places()) {
                auto const begin = std::chrono::steady_clock::now();
                program(buffers, places, emit);
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

EnsembleTotals run_ensemble(EnsemblePlan const& plan, BlockKernel const& kernel, BlockSink const& sink,
                            StopRequest const& stop, Progress* progress) {
    LocalQueue queue(plan.members.count());
    return run_ensemble(plan, queue, kernel, sink, stop, progress);
}

}  // namespace slideway
