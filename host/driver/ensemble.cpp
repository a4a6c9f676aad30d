#include "host/driver/ensemble.hpp"

#include <algorithm>
#include <chrono>
#include <exception>
#include <mutex>
#include <numeric>

#include <omp.h>

namespace slideway {
namespace {

void add_block(EnsembleTotals& totals, BlockBuffers const& buffers, BlockResult const& result) {
    for (MemberRecord const& record : result.records) {
        if (record.status == Status::not_run)
            ++totals.not_run;
        else
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

std::uint64_t EnsembleTotals::failed() const {
    return std::accumulate(ended.begin(), ended.end(), std::uint64_t{0}) -
           ended[static_cast<std::size_t>(Status::finished)];
}

EnsembleTotals& EnsembleTotals::operator+=(EnsembleTotals const& later) {
    for (std::size_t i = 0; i < ended.size(); ++i) ended[i] += later.ended[i];
    not_run += later.not_run;
    steps_accepted += later.steps_accepted;
    steps_rejected += later.steps_rejected;
    stiff_steps += later.stiff_steps;
    rhs_evaluations += later.rhs_evaluations;
    jacobian_evaluations += later.jacobian_evaluations;
    lane_steps_executed += later.lane_steps_executed;
    lane_steps_useful += later.lane_steps_useful;
    seconds += later.seconds;
    stopped = later.stopped;
    return *this;
}

double EnsembleTotals::lane_utilisation() const {
    if (lane_steps_executed == 0) return 1;
    return static_cast<double>(lane_steps_useful) / static_cast<double>(lane_steps_executed);
}

int default_threads() { return omp_get_max_threads(); }

std::size_t default_block_members(std::uint64_t members, int threads, int lanes) {
    // The last members of a block leave lanes idle: several for each lane keep that small, several blocks for each
    // thread keep the threads even.
    constexpr std::uint64_t largest = 512, blocks_per_thread = 2, members_per_lane = 8;
    auto const width = static_cast<std::uint64_t>(lanes), workers = static_cast<std::uint64_t>(threads);
    std::uint64_t const share = (members + workers - 1) / workers;
    std::uint64_t const least = std::clamp<std::uint64_t>(share, 1, members_per_lane * width);
    std::uint64_t const size = std::clamp(share / blocks_per_thread, least, largest);
    return static_cast<std::size_t>((size + width - 1) / width * width);
}

EnsembleTotals run_ensemble(EnsemblePlan const& plan, KernelInstance const& kernel, BlockSink const& sink,
                            StopRequest const& stop, Progress* progress) {
    auto const start = std::chrono::steady_clock::now();
    std::uint64_t const blocks = (plan.members + plan.block_members - 1) / plan.block_members;
    EnsembleTotals totals;
    std::uint64_t handed_out = 0;
    StopReason reason = StopReason::none;
    std::exception_ptr failure;
    std::mutex mutex;  // guards the four above and the sink

    auto const next_block_allowed = [&] {
        std::lock_guard const lock(mutex);
        if (reason == StopReason::none) reason = stop.reason();
        return !failure && reason == StopReason::none;
    };
    auto const run_block = [&](BlockBuffers& buffers, std::uint64_t block) {
        std::uint64_t const first = block * plan.block_members;
        auto const members =
            static_cast<std::size_t>(std::min<std::uint64_t>(plan.block_members, plan.members - first));
        buffers.run(kernel, plan.request, plan.source, stop, plan.first_member + first, members);
        BlockResult const result = buffers.result(first);
        {
            std::lock_guard const lock(mutex);
            if (failure) return;
            // Recorded before the lock is given up: no other thread may offer its block to a sink that failed.
            try {
                sink(result);
            } catch (...) {
                failure = std::current_exception();
                return;
            }
            add_block(totals, buffers, result);
            handed_out += members;
        }
        if (progress) progress->add(members);
    };

#pragma omp parallel num_threads(plan.threads)
    {
        BlockBuffers buffers;
#pragma omp for schedule(dynamic, 1)
        for (std::uint64_t block = 0; block < blocks; ++block) {
            // No exception may leave the parallel region.
            try {
                if (next_block_allowed()) run_block(buffers, block);
            } catch (...) {
                std::lock_guard const lock(mutex);
                if (!failure) failure = std::current_exception();
            }
        }
    }
    if (failure) std::rethrow_exception(failure);
    totals.not_run += plan.members - handed_out;
    // A block in work may be the first to hear of the stop.
    if (reason == StopReason::none) reason = stop.reason();
    totals.stopped = totals.not_run > 0 ? reason : StopReason::none;
    totals.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return totals;
}

}  // namespace slideway
