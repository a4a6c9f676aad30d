// A card leaves what the processor leaves, bit for bit.
#include "kernels/laws/list.hpp"
#include "tests/cuda/card.hpp"

namespace slideway::card_bits_test {
namespace {

using testing::BlockPlan;
using testing::difference;
using testing::OwnedBlock;

class CardBits : public testing::Card {
protected:
    void SetUp() override {
        Card::SetUp();
        if (card_ && !has_bits_of_the_processor()) GTEST_SKIP() << "kernels built with --fmad have bits of their own";
    }

    void expect_bits_of_the_processor(BlockPlan const& plan) const {
        SCOPED_TRACE(testing::name_of(plan.parts));
        OwnedBlock here(plan), there(plan);
        run_on_processor(here);
        run(there);
        EXPECT_EQ(difference(there, here), "");
        EXPECT_EQ(there.block.lane_steps_executed, here.block.lane_steps_executed);
        EXPECT_EQ(there.block.lane_steps_useful, here.block.lane_steps_useful);
    }
};

TEST_F(CardBits, OfSeriesAndQuantities) {
    for (Parts const& parts : testing::all_parts()) expect_bits_of_the_processor(testing::sampled_block(21, parts));
}

TEST_F(CardBits, OfShadowsAndSections) {
    for (Parts const& parts : testing::all_parts()) expect_bits_of_the_processor(testing::shadowed_block(7, parts));
}

TEST_F(CardBits, OfCrossings) {
    for (Parts const& parts : testing::all_parts()) expect_bits_of_the_processor(testing::crossing_block(7, parts));
}

TEST_F(CardBits, OfEveryMethod) {
    for (int method = 0; method < method_count; ++method) {
        auto plan = testing::sampled_block(9, {Law::conservative, Damping::point, true, false});
        plan.settings.method = static_cast<Method>(method);
        plan.settings.end_time = 0.004;
        plan.settings.fixed_step = 2e-6;
        plan.sample_times = {0, 1e-3, 4e-3};
        SCOPED_TRACE(method_table[method].name);
        expect_bits_of_the_processor(plan);
    }
}

TEST_F(CardBits, OfMembersThatFail) {
    auto plan = testing::sampled_block(9, {Law::paper, Damping::rate, true, true});
    plan.members[2].vy = NAN;
    plan.members[5].y = 1.0;  // beyond the rod's reach
    plan.settings.max_steps = 100;
    expect_bits_of_the_processor(plan);
    plan = testing::shadowed_block(5, plan.parts);
    plan.members[3].wx = INFINITY;
    expect_bits_of_the_processor(plan);
}

TEST_F(CardBits, OfABlocksOrderThatIsItsOwn) {
    auto plan = testing::sampled_block(5, {Law::paper, Damping::restitution, false, false});
    plan.order = {3, 0, 4, 2, 1};
    expect_bits_of_the_processor(plan);
}

}  // namespace
}  // namespace slideway::card_bits_test
