// Forces of the two contacts of a block between walls (model.md M13.4), and the friction under which there are none (Painlevé 1895).
#include <gtest/gtest.h>

#include "kernels/rigid/pair_choice.hpp"

namespace slideway::pair_choice_test {
namespace {

/// A contact in front, alone, that slips forwards: γ_N' = approach + N (1 − 2 μ), for a push also makes the contact open less by what its friction turns.
PairAnswer<double> front_alone(double friction, double approach) {
    ContactPair<double> const pair{{{1, 0}, {0, 1}}, {{3, 0}, {0, 3}}, {{2, 0}, {0, 2}}};
    PairQuestion<double> question;
    question.before = {{approach, 0}, {1, 0}};
    question.target[0] = question.target[1] = 0;
    question.present[0] = question.slips[0] = true;
    question.present[1] = question.slips[1] = false;
    question.way[0] = 1, question.way[1] = 0;
    question.kinetic = question.holding = friction;
    return PairChoice<double>(pair, question).answer(true);
}

TEST(PairChoice, PushesAsHardAsItTakes) {
    auto const answer = front_alone(0.25, -3);
    EXPECT_TRUE(answer.fits(1));
    EXPECT_NEAR(answer.force.normal[0], 3 / (1 - 2 * 0.25), 1e-14);
    EXPECT_NEAR(answer.force.along[0], -0.25 * 6, 1e-14);
}

TEST(PairChoice, FitsNothingWhereFrictionOutweighsThePush) {
    // With μ = 1 a push of N makes the contact come nearer by N: neither open nor closed is right.
    EXPECT_FALSE(front_alone(1, -3).fits(1));
    // What opens without a push stays open under the same friction.
    auto const open = front_alone(1, 3);
    EXPECT_TRUE(open.fits(1));
    EXPECT_EQ(open.force.normal[0], 0);
    EXPECT_FALSE(open.state[0].closed);
}

}  // namespace
}  // namespace slideway::pair_choice_test
