// Blocks on a card: many, large, at the same time, and ended before their time.
#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include "kernels/laws/list.hpp"
#include "tests/cuda/card.hpp"

namespace slideway::card_blocks_test {
namespace {

using testing::difference;
using testing::OwnedBlock;

class CardBlocks : public testing::Card {};

TEST_F(CardBlocks, SayWhoRunsThem) {
    EXPECT_EQ(card_->name(), "cuda");
    EXPECT_TRUE(card_->isa().starts_with("sm_")) << card_->isa();
    EXPECT_FALSE(card_->machine().empty());
    EXPECT_NE(card_->flags().find(has_bits_of_the_processor() ? "--fmad=false" : "--fmad=true"), std::string::npos);
}

TEST_F(CardBlocks, AreTheSameFromRunToRun) {
    for (Law const law : {Law::paper, Law::conservative}) {
        auto const plan = testing::sampled_block(200, {law, Damping::point, true, false});
        OwnedBlock first(plan), second(plan);
        run(first);
        run(second);
        EXPECT_EQ(difference(first, second), "");
        auto const fresh = cuda_backend();
        OwnedBlock third(plan);
        kernel_of(*fresh, plan)(third.block);
        EXPECT_EQ(difference(first, third), "");
    }
}

TEST_F(CardBlocks, MayHaveMoreMembersThanTheCardHasThreads) {
    testing::BlockPlan plan;
    plan.members = testing::scattered_starts(card_->bounds({}).least + 37);
    plan.settings.end_time = 2e-4;
    plan.order.resize(plan.members.size());
    for (std::size_t i = 0; i < plan.order.size(); ++i)
        plan.order[plan.order.size() - 1 - i] = static_cast<std::uint32_t>(i);
    OwnedBlock here(plan), there(plan);
    run(there);
    run_on_processor(here);
    for (std::size_t i = 0; i < plan.members.size(); ++i) {
        ASSERT_EQ(there.record(i).status, Status::finished) << i;
        ASSERT_EQ(there.record(i).time, 2e-4) << i;
    }
    if (has_bits_of_the_processor()) {
        EXPECT_EQ(difference(there, here), "");
    }
}

TEST_F(CardBlocks, MayHaveNoMembers) {
    OwnedBlock empty{testing::BlockPlan{}};
    run(empty);
    EXPECT_EQ(empty.block.lane_steps_executed, 0u);
}

TEST_F(CardBlocks, OfSeveralWorkersAtOnceDoNotMix) {
    // Alternately large and small, with and without shadows: what a stream holds is used again.
    auto const plan_of = [](std::size_t i) {
        auto const all = testing::all_parts();
        Parts const parts = all[13 * i % all.size()];
        return i % 2 == 0 ? testing::sampled_block(5 + i % 7, parts) : testing::shadowed_block(1 + i % 3, parts);
    };
    std::vector<std::string> wrong(24);
    std::vector<std::thread> workers;
    for (std::size_t worker = 0; worker < 4; ++worker) {
        workers.emplace_back([&, worker] {
            for (std::size_t i = worker; i < wrong.size(); i += 4) {
                auto const plan = plan_of(i);
                OwnedBlock alone(plan), together(plan);
                if (has_bits_of_the_processor()) run_on_processor(alone);
                run(together);
                if (!has_bits_of_the_processor()) run(alone);
                wrong[i] = difference(together, alone);
            }
        });
    }
    for (std::thread& worker : workers) worker.join();
    for (std::size_t i = 0; i < wrong.size(); ++i) EXPECT_EQ(wrong[i], "") << "block " << i;
}

TEST_F(CardBlocks, EndSoonWhenTheyAreToldTo) {
    auto plan = testing::sampled_block(40, {Law::conservative, Damping::point, true, false});
    plan.settings.end_time = 1e5;
    plan.settings.stiff_max_step = 1e-4;  // a slider at rest has an hour of them
    plan.settings.max_steps = 1'000'000'000'000;
    plan.members[7].y = 1.0;  // ends at once
    OwnedBlock block(plan);
    using Clock = std::chrono::steady_clock;
    auto const end = Clock::now() + std::chrono::milliseconds(100);
    block.block.stop = [](void const* time, double) { return Clock::now() > *static_cast<Clock::time_point const*>(time); };
    block.block.stop_context = &end;
    run(block);
    EXPECT_LT(Clock::now() - end, std::chrono::seconds(5));
    EXPECT_EQ(block.record(7).status, Status::geometry);
    for (std::size_t i = 0; i < 40; ++i) {
        if (i == 7) continue;
        EXPECT_EQ(block.record(i).status, Status::not_run);
        EXPECT_EQ(block.state(i)[0], testing::untouched);
        double const sample = block.left_by(i)[3].numbers[0];
        EXPECT_TRUE(std::isnan(sample) || sample == testing::untouched) << sample;
    }
    // Its stream serves the next block as if nothing had been.
    auto const next = testing::sampled_block(3, plan.parts);
    OwnedBlock first(next), second(next);
    run(first);
    kernel_of(*cuda_backend(), next)(second.block);
    EXPECT_EQ(first.record(2).status, Status::finished);
    EXPECT_EQ(difference(first, second), "");
}

}  // namespace
}  // namespace slideway::card_blocks_test
