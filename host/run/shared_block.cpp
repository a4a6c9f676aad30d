#include "host/run/shared_block.hpp"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <exception>
#include <utility>
#include <vector>

#include <omp.h>

namespace slideway {
namespace {

/// What the threads at work on a block have in common.
class SharedBlock {
public:
    SharedBlock(Block const& block, int threads) : whole_(block), covered_(static_cast<std::size_t>(threads)) {}

    /// The part of one thread.
    void run(BlockKernel const& kernel, int thread, std::size_t seats) {
        Watch const watch{this, &covered_[static_cast<std::size_t>(thread)]};
        Block mine = whole_;
        mine.taken = &taken_;
        mine.seats = seats;
        mine.stop = [](void const* context, double covered) {
            auto const& [shared, place] = *static_cast<Watch const*>(context);
            place->store(covered, std::memory_order_relaxed);
            return shared->must_stop();
        };
        mine.stop_context = &watch;
        // No exception may leave the parallel region.
        try {
            kernel(mine);
        } catch (...) {
            if (!has_failed_.exchange(true)) failure_ = std::current_exception();
        }
        executed_ += mine.lane_steps_executed;
        useful_ += mine.lane_steps_useful;
    }

    /// After all threads have ended.
    void finish(Block& block) const {
        if (failure_) std::rethrow_exception(failure_);
        block.lane_steps_executed = executed_;
        block.lane_steps_useful = useful_;
    }

private:
    struct Watch {
        SharedBlock* shared;
        std::atomic<double>* covered;
    };

    bool must_stop() const {
        if (has_failed_) return true;
        if (whole_.stop == nullptr) return false;
        double covered = 0;
        for (auto const& thread : covered_) covered += thread.load(std::memory_order_relaxed);
        return whole_.stop(whole_.stop_context, covered);
    }

    Block const whole_;
    std::vector<std::atomic<double>> covered_;  // by each thread
    std::uint64_t taken_ = 0;                   // changed by the kernel alone, with atomic additions
    std::atomic<std::uint64_t> executed_ = 0, useful_ = 0;
    std::atomic<bool> has_failed_ = false;
    std::exception_ptr failure_;  // of who set has_failed_
};

}  // namespace

BlockKernel shared_by_threads(BlockKernel kernel, int threads, std::size_t lanes) {
    return [kernel = std::move(kernel), threads, lanes](Block& block) {
        std::size_t const packs = (block.members + lanes - 1) / lanes;
        auto const team = static_cast<int>(std::min<std::size_t>(static_cast<std::size_t>(threads), packs));
        if (team <= 1) return kernel(block);
        // Nobody takes so many at the start that nothing is left for others.
        std::size_t const seats = (packs + static_cast<std::size_t>(team) - 1) / static_cast<std::size_t>(team) * lanes;
        SharedBlock shared(block, team);
#pragma omp parallel num_threads(team)
        shared.run(kernel, omp_get_thread_num(), seats);
        shared.finish(block);
    };
}

}  // namespace slideway
