#include "host/driver/ensemble.hpp"

#include <atomic>
#include <bit>
#include <chrono>
#include <cmath>
#include <map>
#include <stdexcept>
#include <thread>

#include <gtest/gtest.h>

namespace slideway {
namespace {

// A kernel whose results are known: every value is made of the member's number, which travels as `y`.
double series_value(double member, int series, double time) { return 1000 * member + 10 * series + time; }

void known_results(Block& block) {
    int const selected = std::popcount(block.series);
    for (std::size_t i = 0; i < block.members; ++i) {
        double const member = block.inputs[i].y;
        auto const steps = static_cast<std::uint64_t>(member) + 1;
        block.records[i] = {Status::finished, steps, 2 * steps, 7 * steps, block.settings.end_time};
        for (int k = 0; k < state_size; ++k) block.final_states[i * state_size + k] = member + k;
        block.quantity_values[i * quantity_columns + quantity_column(Quantity::crank_work)] = -member;
        for (int s = 0; s < selected; ++s) {
            for (std::size_t t = 0; t < block.samples; ++t) {
                block.series_values[(s * block.members + i) * block.samples + t] =
                    series_value(member, s, block.sample_times[t]);
            }
        }
    }
    block.lane_steps_executed = 4 * block.members;
    block.lane_steps_useful = 3 * block.members;
}

void slow_results(Block& block) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    known_results(block);
}

bool draw_number(std::uint64_t member, Inputs& inputs) {
    inputs.y = static_cast<double>(member);
    return true;
}

bool every_third_is_unusable(std::uint64_t member, Inputs& inputs) {
    draw_number(member, inputs);
    return member % 3 != 1;
}

EnsemblePlan small_plan(std::uint64_t members, std::size_t block_members, int threads) {
    EnsemblePlan plan;
    plan.members = MemberSet({0, members});
    plan.blocks.fixed = block_members;
    plan.threads = plan.workers = threads;
    plan.request.integrator.end_time = 2.5;
    plan.request.sample_times = {0.0, 0.25, 0.5};
    plan.request.quantities = Selection{1} << static_cast<int>(Quantity::crank_work);
    plan.request.series = 0b11;
    plan.source = draw_number;
    return plan;
}

// All that a sink was given, by member.
struct Collected {
    struct Member {
        double drawn;
        MemberRecord record;
        std::vector<double> values;  // final state, crank work, series
    };
    std::map<std::uint64_t, Member> members;
    int calls = 0, twice = 0;

    BlockSink sink() {
        return [this](BlockResult const& block) {
            ++calls;
            std::size_t const count = block.records.size();
            std::size_t const samples = block.series.size() / count / 2;
            for (std::size_t i = 0; i < count; ++i) {
                Member member{block.inputs[i].y, block.records[i], {}};
                auto const state = block.final_states.subspan(i * state_size, state_size);
                member.values.assign(state.begin(), state.end());
                member.values.push_back(block.quantities[i * quantity_columns + quantity_column(Quantity::crank_work)]);
                for (std::size_t s = 0; s < 2; ++s) {
                    auto const row = block.series.subspan((s * count + i) * samples, samples);
                    member.values.insert(member.values.end(), row.begin(), row.end());
                }
                if (!members.emplace(block.members[i], member).second) ++twice;
            }
        };
    }
};

std::vector<double> known_values(double member) {
    std::vector<double> values;
    for (int k = 0; k < state_size; ++k) values.push_back(member + k);
    values.push_back(-member);
    for (int s = 0; s < 2; ++s) {
        for (double const t : {0.0, 0.25, 0.5}) values.push_back(series_value(member, s, t));
    }
    return values;
}

using BlocksAndThreads = std::tuple<std::size_t, int>;
class EnsembleOverBlocks : public testing::TestWithParam<BlocksAndThreads> {};

TEST_P(EnsembleOverBlocks, GivesEveryMemberItsOwnResultOnce) {
    auto const [block_members, threads] = GetParam();
    Collected collected;
    StopRequest const stop;
    EnsemblePlan plan = small_plan(101, block_members, threads);
    plan.members = MemberSet({40, 101});
    EnsembleTotals const totals = run_ensemble(plan, {known_results, nullptr}, collected.sink(), stop);

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
    EnsembleTotals const totals = run_ensemble(plan, {known_results, nullptr}, collected.sink(), stop);

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
    EnsembleTotals const totals = run_ensemble(plan, {known_results, nullptr}, collected.sink(), stop);
    EXPECT_EQ(totals.done(), 8u);
    EXPECT_EQ(collected.twice, 0);
    ASSERT_EQ(collected.members.size(), 8u);
    for (std::uint64_t const m : members) {
        ASSERT_TRUE(collected.members.contains(m)) << m;
        EXPECT_EQ(collected.members.at(m).values, known_values(static_cast<double>(m)));
    }
}

INSTANTIATE_TEST_SUITE_P(Sizes, EnsembleOverBlocks,
                         testing::Combine(testing::Values(1, 7, 64, 1000), testing::Values(1, 2, 4)));

TEST(Ensemble, OfUnusableMembersAloneNeverCallsTheKernel) {
    Collected collected;
    StopRequest const stop;
    EnsemblePlan plan = small_plan(10, 4, 2);
    plan.source = [](std::uint64_t, Inputs&) { return false; };
    auto const totals =
        run_ensemble(plan, {[](Block&) { throw std::logic_error("called"); }, nullptr}, collected.sink(), stop);
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
            run_ensemble(small_plan(1000, 5, threads), {known_results, nullptr}, failing, stop);
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
                     plan, {known_results, nullptr}, [](BlockResult const&) {}, stop),
                 std::runtime_error);
}

TEST(Ensemble, StoppedBeforeItsStartRunsNothing) {
    StopRequest stop;
    stop.request();
    Collected collected;
    auto const totals = run_ensemble(small_plan(30, 4, 2), {known_results, nullptr}, collected.sink(), stop);
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
    auto const totals = run_ensemble(small_plan(40, 4, 1), {known_results, nullptr}, stopping, stop);
    EXPECT_EQ(collected.members.size(), 8u);
    EXPECT_EQ(totals.ended[0], 8u);
    EXPECT_EQ(totals.done(), 8u);
    EXPECT_EQ(totals.stopped, StopReason::signal);
}

TEST(Ensemble, StopsWhenItsTimeIsUp) {
    StopRequest stop;
    stop.stop_after(std::chrono::milliseconds(50));
    Collected collected;
    auto const totals = run_ensemble(small_plan(1000, 1, 2), {slow_results, nullptr}, collected.sink(), stop);
    EXPECT_EQ(totals.stopped, StopReason::time_limit);
    EXPECT_GT(totals.ended[0], 0u);
    EXPECT_LT(totals.done(), 1000u);
    EXPECT_EQ(totals.ended[0], totals.done());
    EXPECT_EQ(collected.members.size(), totals.ended[0]);
}

TEST(Ensemble, TellsOfARequestThatCameWithItsLastBlock) {
    StopRequest stop;
    auto const totals = run_ensemble(
        small_plan(8, 4, 1), {known_results, nullptr},
        [&](BlockResult const& block) {
            if (block.members[0] == 4) stop.request();
        },
        stop);
    EXPECT_EQ(totals.done(), 8u);
    EXPECT_EQ(totals.stopped, StopReason::signal);
}

// ---- a queue that others share, and programs ----

TEST(Ensemble, LeavesToOthersWhatTheyTookFromTheQueue) {
    StopRequest const stop;
    EnsemblePlan const plan = small_plan(20, 3, 2);
    LocalQueue queue(20);
    EXPECT_EQ(queue.take(7, 0).count, 7u);
    Collected collected;
    EnsembleTotals const totals = run_ensemble(plan, queue, {known_results, nullptr}, collected.sink(), stop);
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

TEST(Ensemble, ReportsToTheQueueWhatItFinished) {
    for (int const threads : {1, 3}) {
        StopRequest const stop;
        Ledger ledger(101);
        run_ensemble(
            small_plan(101, 10, threads), ledger, {known_results, nullptr}, [](BlockResult const&) {}, stop);
        EXPECT_EQ(ledger.reported, 101u);
        EXPECT_FALSE(ledger.abandoned);
    }
}

TEST(Ensemble, AbandonsTheQueueOfAllWhenItFails) {
    StopRequest const stop;
    Ledger ledger(100);
    EXPECT_THROW(run_ensemble(
                     small_plan(100, 10, 2), ledger, {known_results, nullptr},
                     [](BlockResult const&) { throw std::runtime_error("disk full"); }, stop),
                 std::runtime_error);
    EXPECT_TRUE(ledger.abandoned);
    EXPECT_EQ(ledger.left(), 0u);
}

TEST(Ensemble, HandsPlacesToAProgramWhichEmitsWhatItWill) {
    for (int const threads : {1, 4}) {
        StopRequest const stop;
        EnsemblePlan plan = small_plan(12, 5, threads);
        KernelInstance const kernel{known_results, nullptr};
        // Each place becomes two members, in blocks of one.
        plan.program = [&](BlockBuffers& buffers, std::span<std::uint64_t const> places, BlockEmit const& emit) {
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
}  // namespace slideway
