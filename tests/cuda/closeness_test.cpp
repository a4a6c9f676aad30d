// The comparisons of tests/cuda/closeness.hpp, on runs of the processor and on known distributions.
#include "kernels/laws/list.hpp"
#include "tests/cuda/closeness.hpp"

namespace slideway::closeness_test {
namespace {

using testing::OwnedBlock;

/// The same members, one number of each rounded the other way.
testing::BlockPlan rounded_otherwise(testing::BlockPlan plan) {
    for (Inputs& member : plan.members) member.crank_speed = std::nextafter(member.crank_speed, 1e9);
    return plan;
}

// What is asked of a card must hold for the processor with another rounding too.
TEST(Closeness, HoldsForARoundingElsewhere) {
    for (Law const law : {Law::paper, Law::conservative}) {
        auto const run = [](OwnedBlock& block) { find_instance(Isa::scalar, block.plan().parts).run(block.block); };
        OwnedBlock here(testing::touching_block(law)), there(rounded_otherwise(here.plan()));
        run(here);
        run(there);
        EXPECT_NE(difference(here, there), "");
        testing::expect_close(here, there);
        OwnedBlock parted_here(testing::parted_block(law)), parted_there(rounded_otherwise(parted_here.plan()));
        run(parted_here);
        run(parted_there);
        testing::expect_one_distribution(parted_here, parted_there, true);
    }
}

TEST(Closeness, TellsDistributionsApart) {
    // Tabulated: P(λ > 1.3581) = 0.05, P(λ > 1.6276) = 0.01, P(λ > 1.9495) = 0.001; of many draws λ = √(n/2) D.
    constexpr std::size_t many = 2'000'000;
    EXPECT_NEAR(testing::smirnov_probability(1.3581 / 1000, many, many), 0.05, 1e-4);
    EXPECT_NEAR(testing::smirnov_probability(1.6276 / 1000, many, many), 0.01, 1e-4);
    EXPECT_NEAR(testing::smirnov_probability(1.9495 / 1000, many, many), 0.001, 1e-5);
    EXPECT_EQ(testing::kolmogorov_distance({1, 2, 3, 4}, {1, 2, 3, 4}), 0);
    EXPECT_EQ(testing::kolmogorov_distance({1, 2, 3, 4}, {3, 4, 5, 6}), 0.5);
    EXPECT_EQ(testing::kolmogorov_distance({1, 1, 1}, {2, 2}), 1);
    // Ties count whole: the distributions are compared behind all draws of a value.
    EXPECT_EQ(testing::kolmogorov_distance({1, 1, 1, 1}, {1, 1}), 0);
    EXPECT_EQ(testing::kolmogorov_distance({2, 1, 2, 1}, {1, 2}), 0);
    EXPECT_DOUBLE_EQ(testing::kolmogorov_distance({1, 1, 2}, {1, 2, 2}), 1 / 3.0);
    EXPECT_DOUBLE_EQ(testing::kolmogorov_distance({1, 2, 2}, {1, 1, 2}), 1 / 3.0);
    EXPECT_LT(testing::smirnov_probability(0.2, 200, 200), 1e-3);
    EXPECT_GT(testing::smirnov_probability(0.15, 200, 200), 1e-3);
}

}  // namespace
}  // namespace slideway::closeness_test
