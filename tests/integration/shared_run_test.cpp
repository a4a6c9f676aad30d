// Runs whose queue others share, and workers that follow a program.
#include <atomic>
#include <stdexcept>

#include "tests/support/known_results.hpp"

namespace slideway::shared_run_test {
namespace {

TEST(SharedQueue, LeavesToOthersWhatTheyTookFromTheQueue) {
    StopRequest const stop;
    EnsemblePlan const plan = small_plan(20, 3, 2);
    LocalQueue queue(20);
    EXPECT_EQ(queue.take(7, 0).count, 7u);
    Collected collected;
    EnsembleTotals const totals = run_ensemble(plan, queue, known_results, collected.sink(), stop);
    EXPECT_EQ(totals.done(), 13u);
    ASSERT_EQ(collected.members.size(), 13u);
    EXPECT_EQ(collected.members.begin()->first, 7u);
}

/// A queue that keeps what it was told.
class Ledger final : public MemberQueue {
public:
    explicit Ledger(std::uint64_t places) : queue_(places) {}
    Stretch take(std::uint64_t wanted, std::uint64_t finished) override {
        reported += finished;
        return queue_.take(wanted, 0);
    }
    void abandon() override {
        abandoned = true;
        queue_.abandon();
    }
    std::uint64_t left() const override { return queue_.left(); }
    std::atomic<std::uint64_t> reported = 0;
    std::atomic<bool> abandoned = false;

private:
    LocalQueue queue_;
};

TEST(SharedQueue, ReportsToTheQueueWhatItFinished) {
    for (int const threads : {1, 3}) {
        StopRequest const stop;
        Ledger ledger(101);
        run_ensemble(
            small_plan(101, 10, threads), ledger, known_results, [](BlockResult const&) {}, stop);
        EXPECT_EQ(ledger.reported, 101u);
        EXPECT_FALSE(ledger.abandoned);
    }
}

TEST(SharedQueue, AbandonsTheQueueOfAllWhenItFails) {
    StopRequest const stop;
    Ledger ledger(100);
    EXPECT_THROW(run_ensemble(
                     small_plan(100, 10, 2), ledger, known_results,
                     [](BlockResult const&) { throw std::runtime_error("disk full"); }, stop),
                 std::runtime_error);
    EXPECT_TRUE(ledger.abandoned);
    EXPECT_EQ(ledger.left(), 0u);
}

TEST(SharedQueue, HandsPlacesToAProgramWhichEmitsWhatItWill) {
    for (int const threads : {1, 4}) {
        StopRequest const stop;
        EnsemblePlan plan = small_plan(12, 5, threads);
        BlockKernel const kernel = known_results;
        // Each place becomes two members, in blocks of one.
        plan.program = [&](BlockKernel const&, BlockBuffers& buffers, std::span<std::uint64_t const> places, BlockEmit const& emit) {
            for (std::uint64_t const place : places) {
                for (std::uint64_t const member : {place, place + 1000}) {
                    buffers.run(kernel, plan.request, plan.source, stop, std::span(&member, 1));
                    if (!emit(buffers)) return;
                }
            }
        };
        Collected collected;
        EnsembleTotals const totals = run_ensemble(plan, kernel, collected.sink(), stop);
        EXPECT_EQ(totals.done(), 24u);
        EXPECT_EQ(collected.calls, 24);
        EXPECT_EQ(collected.twice, 0);
        EXPECT_TRUE(collected.members.contains(11));
        EXPECT_TRUE(collected.members.contains(1011));
    }
}

TEST(EnsembleTotals, AddUpOverRanks) {
    EnsembleTotals a, b;
    a.ended[0] = 5, a.ended[2] = 1, a.steps_accepted = 10, a.lane_steps_executed = 40, a.lane_steps_useful = 10;
    b.ended[0] = 2, b.steps_accepted = 7, b.lane_steps_executed = 60, b.lane_steps_useful = 65;
    a.seconds = 1, b.seconds = 2, b.stopped = StopReason::time_limit;
    a += b;
    EXPECT_EQ(a.done(), 8u);
    EXPECT_EQ(a.failed(), 1u);
    EXPECT_EQ(a.steps_accepted, 17u);
    EXPECT_EQ(a.lane_utilisation(), 0.75);
    EXPECT_EQ(a.seconds, 3);
    EXPECT_EQ(a.stopped, StopReason::time_limit);
}

}  // namespace
}  // namespace slideway::shared_run_test
