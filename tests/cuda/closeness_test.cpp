// The comparisons of tests/cuda/closeness.hpp, on runs of the processor and on known distributions.
#include "tests/cuda/closeness.hpp"

namespace slideway {
namespace {

using testing::OwnedBlock;

// sse2 rounds each a·b + c twice, where the others round once: what is asked of a card must hold for it too.
TEST(Closeness, HoldsForAnInstructionSetWithOtherBits) {
    for (Law const law : {Law::paper, Law::conservative}) {
        auto const run = [](Isa isa, OwnedBlock& block) { find_instance(isa, block.plan().parts).run(block.block); };
        OwnedBlock once(testing::touching_block(law)), twice(once.plan());
        run(Isa::scalar, once);
        run(Isa::sse2, twice);
        EXPECT_NE(difference(once, twice), "");
        testing::expect_close(once, twice);
        OwnedBlock parted_once(testing::parted_block(law)), parted_twice(parted_once.plan());
        run(Isa::scalar, parted_once);
        run(Isa::sse2, parted_twice);
        testing::expect_one_distribution(parted_once, parted_twice, true);
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
    EXPECT_LT(testing::smirnov_probability(0.2, 200, 200), 1e-3);
    EXPECT_GT(testing::smirnov_probability(0.15, 200, 200), 1e-3);
}

}  // namespace
}  // namespace slideway
