#include "host/run/shared_block.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <exception>
#include <vector>

#include <omp.h>

#include "host/run/stop.hpp"

namespace slideway {
namespace {

/// What the threads at work on a block have in common.
class SharedBlock {
public:
    SharedBlock(Block const& block, int threads, SharedBlockKernel::TimeLimits limits)
        : whole_(block), limits_(limits), covered_(static_cast<std::size_t>(threads)) {}

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
    bool finish(Block& block) const {
        if (failure_) std::rethrow_exception(failure_);
        block.lane_steps_executed = executed_;
        block.lane_steps_useful = useful_;
        return is_given_up_;
    }

private:
    struct Watch {
        SharedBlock* shared;
        std::atomic<double>* covered;
    };

    bool must_stop() {
        if (has_failed_ || is_given_up_) return true;
        double covered = 0;
        for (auto const& thread : covered_) covered += thread.load(std::memory_order_relaxed);
        if (whole_.stop != nullptr && whole_.stop(whole_.stop_context, covered)) return true;
        judge(covered);
        return is_given_up_;
    }

    /// Once: the rest is then known to be short, or somebody else's.
    void judge(double covered) {
        if (is_judged_.load(std::memory_order_relaxed)) return;
        double const seconds = seconds_since(begin_);
        if (seconds < limits_.trial || is_judged_.exchange(true)) return;
        is_given_up_ = seconds * static_cast<double>(whole_.members) > limits_.most * covered;
    }

    Block const whole_;
    SharedBlockKernel::TimeLimits const limits_;
    std::chrono::steady_clock::time_point const begin_ = std::chrono::steady_clock::now();
    std::vector<std::atomic<double>> covered_;  // by each thread
    std::uint64_t taken_ = 0;                   // changed by the kernel alone, with atomic additions
    std::atomic<std::uint64_t> executed_ = 0, useful_ = 0;
    std::atomic<bool> has_failed_ = false, is_judged_ = false, is_given_up_ = false;
    std::exception_ptr failure_;  // of who set has_failed_
};

}  // namespace

bool SharedBlockKernel::run(Block& block) const {
    std::size_t const packs = (block.members + lanes_ - 1) / lanes_;
    auto const team = static_cast<int>(std::min<std::size_t>(static_cast<std::size_t>(threads_), std::max<std::size_t>(packs, 1)));
    // Nobody takes so many at the start that nothing is left for others.
    std::size_t const seats = (packs + static_cast<std::size_t>(team) - 1) / static_cast<std::size_t>(team) * lanes_;
    SharedBlock shared(block, team, limits_);
#pragma omp parallel num_threads(team)
    shared.run(kernel_, omp_get_thread_num(), seats);
    return shared.finish(block);
}

}  // namespace slideway
