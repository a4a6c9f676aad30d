#include <atomic>
#include <chrono>
#include <cmath>
#include <stdexcept>

#include "tests/support/known_results.hpp"

namespace slideway::ensemble_test {
namespace {

using BlocksAndThreads = std::tuple<std::size_t, int>;
class EnsembleOverBlocks : public ::testing::TestWithParam<BlocksAndThreads> {};

TEST_P(EnsembleOverBlocks, GivesEveryMemberItsOwnResultOnce) {
    auto const [block_members, threads] = GetParam();
    Collected collected;
    StopRequest const stop;
    EnsemblePlan plan = small_plan(101, block_members, threads);
    plan.members = MemberSet({40, 101});
    EnsembleTotals const totals = run_ensemble(plan, known_results, collected.sink(), stop);

    EXPECT_EQ(collected.twice, 0);
    ASSERT_EQ(collected.members.size(), 101u);
    std::uint64_t steps = 0;
    for (auto const& [index, member] : collected.members) {
        EXPECT_TRUE(plan.members.contains(index));
        auto const number = static_cast<double>(index);
        EXPECT_EQ(member.drawn, number);
        EXPECT_EQ(member.values, known_values(number));
        EXPECT_EQ(member.record.time, 2.5);
        steps += 1 + index;
    }
    EXPECT_EQ(totals.ended[0], 101u);
    EXPECT_EQ(totals.done(), 101u);
    EXPECT_EQ(totals.failed(), 0u);
    EXPECT_EQ(totals.steps_accepted, steps);
    EXPECT_EQ(totals.steps_rejected, 2 * steps);
    EXPECT_EQ(totals.rhs_evaluations, 7 * steps);
    EXPECT_EQ(totals.lane_utilisation(), 0.75);
    EXPECT_EQ(totals.stopped, StopReason::none);
}

TEST_P(EnsembleOverBlocks, LeavesUnusableMembersOutAndKeepsTheOthersInPlace) {
    auto const [block_members, threads] = GetParam();
    Collected collected;
    StopRequest const stop;
    EnsemblePlan plan = small_plan(50, block_members, threads);
    plan.source = every_third_is_unusable;
    EnsembleTotals const totals = run_ensemble(plan, known_results, collected.sink(), stop);

    ASSERT_EQ(collected.members.size(), 50u);
    for (auto const& [index, member] : collected.members) {
        EXPECT_EQ(member.drawn, static_cast<double>(index));
        if (index % 3 == 1) {
            EXPECT_EQ(member.record.status, Status::invalid_inputs);
            EXPECT_EQ(member.record.steps_accepted, 0u);
            for (double const value : member.values) EXPECT_TRUE(std::isnan(value));
        } else {
            EXPECT_EQ(member.record.status, Status::finished);
            EXPECT_EQ(member.values, known_values(static_cast<double>(index)));
        }
    }
    EXPECT_EQ(totals.ended[static_cast<std::size_t>(Status::invalid_inputs)], 17u);  // 1, 4, …, 49
    EXPECT_EQ(totals.failed(), 17u);
}

TEST_P(EnsembleOverBlocks, RunsTheMembersOfASetWithGapsAndNoOthers) {
    auto const [block_members, threads] = GetParam();
    Collected collected;
    StopRequest const stop;
    EnsemblePlan plan = small_plan(0, block_members, threads);
    std::uint64_t const members[] = {3, 4, 5, 9, 100, 101, 77, 1000000};
    plan.members = MemberSet::of(members);
    EnsembleTotals const totals = run_ensemble(plan, known_results, collected.sink(), stop);
    EXPECT_EQ(totals.done(), 8u);
    EXPECT_EQ(collected.twice, 0);
    ASSERT_EQ(collected.members.size(), 8u);
    for (std::uint64_t const m : members) {
        ASSERT_TRUE(collected.members.contains(m)) << m;
        EXPECT_EQ(collected.members.at(m).values, known_values(static_cast<double>(m)));
    }
}

INSTANTIATE_TEST_SUITE_P(Sizes, EnsembleOverBlocks,
                         ::testing::Combine(::testing::Values(1, 7, 64, 1000), ::testing::Values(1, 2, 4)));

TEST(Ensemble, OfUnusableMembersAloneNeverCallsTheKernel) {
    Collected collected;
    StopRequest const stop;
    EnsemblePlan plan = small_plan(10, 4, 2);
    plan.source = [](std::uint64_t, Inputs&) { return false; };
    auto const totals = run_ensemble(
        plan, [](Block&) { throw std::logic_error("called"); }, collected.sink(), stop);
    EXPECT_EQ(totals.failed(), 10u);
    EXPECT_EQ(totals.lane_utilisation(), 1);
}

TEST(Ensemble, EndsWithTheErrorOfItsSink) {
    for (int const threads : {1, 4}) {
        StopRequest const stop;
        int calls = 0;
        auto const failing = [&](BlockResult const&) {
            if (++calls == 3) throw std::runtime_error("disk full");
        };
        try {
            run_ensemble(small_plan(1000, 5, threads), known_results, failing, stop);
            FAIL() << "the error was lost";
        } catch (std::runtime_error const& error) {
            EXPECT_STREQ(error.what(), "disk full");
        }
        EXPECT_EQ(calls, 3);  // no block is offered to a sink that failed
    }
}

TEST(Ensemble, EndsWithTheErrorOfAMember) {
    StopRequest const stop;
    EnsemblePlan plan = small_plan(100, 5, 3);
    plan.source = [](std::uint64_t member, Inputs&) -> bool {
        if (member == 50) throw std::runtime_error("no such member");
        return true;
    };
    EXPECT_THROW(run_ensemble(
                     plan, known_results, [](BlockResult const&) {}, stop),
                 std::runtime_error);
}

TEST(Ensemble, WhoseKernelFailsKeepsWhatOthersHaveInWork) {
    StopRequest const stop;
    std::atomic<int> begun = 0;
    bool was_told = false;
    auto const kernel = [&](Block& block) {
        if (++begun == 2) throw DeviceError("the card is lost");
        // The first block is told that the second has failed; its last member has not ended by then.
        for (int i = 0; i < 10'000 && !was_told; ++i) {
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
            was_told = block.stop(block.stop_context, 0);
        }
        known_results(block);
        block.records[4] = {};
    };
    std::vector<Status> kept;
    EXPECT_THROW(run_ensemble(
                     small_plan(100, 5, 2), kernel,
                     [&](BlockResult const& block) {
                         for (MemberRecord const& record : block.records) kept.push_back(record.status);
                     },
                     stop),
                 DeviceError);
    EXPECT_TRUE(was_told);
    EXPECT_EQ(kept,
              (std::vector{Status::finished, Status::finished, Status::finished, Status::finished, Status::not_run}));
    EXPECT_EQ(begun, 2);
}

TEST(Ensemble, WhoseWorkerFailsEndsTheProgramsOfOthers) {
    StopRequest const stop;
    std::atomic<int> begun = 0;
    int emitted = 0, kept = 0;
    EnsemblePlan plan = small_plan(2, 1, 2);
    plan.program = [&](BlockKernel const&, BlockBuffers& buffers, std::span<std::uint64_t const> places, BlockEmit const& emit) {
        if (++begun == 2) throw DeviceError("the card is lost");
        // A chain of blocks goes on for as long as it is told to.
        do {
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
            buffers.run(known_results, plan.request, plan.source, stop, places);
            ++emitted;
        } while (emitted < 10'000 && emit(buffers));
    };
    EXPECT_THROW(run_ensemble(
                     plan, known_results, [&](BlockResult const&) { ++kept; }, stop),
                 DeviceError);
    EXPECT_LT(emitted, 10'000);
    EXPECT_EQ(kept, emitted);
}

TEST(Ensemble, StoppedBeforeItsStartRunsNothing) {
    StopRequest stop;
    stop.request();
    Collected collected;
    auto const totals = run_ensemble(small_plan(30, 4, 2), known_results, collected.sink(), stop);
    EXPECT_EQ(collected.calls, 0);
    EXPECT_EQ(totals.done(), 0u);
    EXPECT_EQ(totals.stopped, StopReason::signal);
}

TEST(Ensemble, StoppedOnItsWayKeepsWhatIsFinished) {
    StopRequest stop;
    Collected collected;
    auto const collect = collected.sink();
    auto const stopping = [&](BlockResult const& block) {
        collect(block);
        if (collected.calls == 2) stop.request();
    };
    auto const totals = run_ensemble(small_plan(40, 4, 1), known_results, stopping, stop);
    EXPECT_EQ(collected.members.size(), 8u);
    EXPECT_EQ(totals.ended[0], 8u);
    EXPECT_EQ(totals.done(), 8u);
    EXPECT_EQ(totals.stopped, StopReason::signal);
}

TEST(Ensemble, StopsWhenItsTimeIsUp) {
    StopRequest stop;
    stop.stop_after(std::chrono::milliseconds(50));
    Collected collected;
    auto const totals = run_ensemble(small_plan(1000, 1, 2), slow_results, collected.sink(), stop);
    EXPECT_EQ(totals.stopped, StopReason::time_limit);
    EXPECT_GT(totals.ended[0], 0u);
    EXPECT_LT(totals.done(), 1000u);
    EXPECT_EQ(totals.ended[0], totals.done());
    EXPECT_EQ(collected.members.size(), totals.ended[0]);
}

TEST(Ensemble, TellsOfARequestThatCameWithItsLastBlock) {
    StopRequest stop;
    auto const totals = run_ensemble(
        small_plan(8, 4, 1), known_results,
        [&](BlockResult const& block) {
            if (block.members[0] == 4) stop.request();
        },
        stop);
    EXPECT_EQ(totals.done(), 8u);
    EXPECT_EQ(totals.stopped, StopReason::signal);
}

/// known_results of the members that a thread takes from the block's queue, `pause` for each.
BlockKernel sharing(std::chrono::milliseconds pause) {
    return [pause](Block& block) {
        std::uint64_t own = 0, ended = 0;
        for (;;) {
            std::uint64_t const place = block.taken != nullptr ? __atomic_fetch_add(block.taken, 1, __ATOMIC_RELAXED) : own++;
            if (place >= block.members) return;
            if (block.stop(block.stop_context, static_cast<double>(ended))) return;
            std::this_thread::sleep_for(pause);
            known_result(block, place);
            ++ended;
        }
    };
}

TEST(Ensemble, OfFewMembersIsOneBlockOfAllThreads) {
    Collected collected;
    StopRequest const stop;
    auto const totals = run_ensemble(small_plan(300, 0, 2), sharing(std::chrono::milliseconds(0)), collected.sink(), stop);
    EXPECT_EQ(collected.calls, 1);
    EXPECT_EQ(collected.members.size(), 300u);
    EXPECT_EQ(totals.ended[0], 300u);
}

TEST(Ensemble, OfFewMembersThatTakeLongHasBlocksThatAKilledProcessKeeps) {
    Collected collected;
    StopRequest const stop;
    auto plan = small_plan(100, 0, 2);
    plan.blocks.seconds = 0.5;
    // A second and a half for two threads, a second of which was to be enough.
    auto const totals = run_ensemble(plan, sharing(std::chrono::milliseconds(30)), collected.sink(), stop);
    EXPECT_GT(collected.calls, 4);
    EXPECT_EQ(collected.twice, 0);
    EXPECT_EQ(collected.members.size(), 100u);
    EXPECT_EQ(totals.ended[0], 100u);
    EXPECT_EQ(totals.stopped, StopReason::none);
}

TEST(Ensemble, OfOneBlockKeepsWhatHadEndedWhenItWasStopped) {
    Collected collected;
    StopRequest stop;
    stop.stop_after(std::chrono::milliseconds(200));
    auto const totals = run_ensemble(small_plan(400, 0, 2), sharing(std::chrono::milliseconds(10)), collected.sink(), stop);
    EXPECT_EQ(totals.stopped, StopReason::time_limit);
    EXPECT_GT(totals.ended[0], 4u);
    EXPECT_LT(totals.ended[0], 200u);
}

}  // namespace
}  // namespace slideway::ensemble_test
