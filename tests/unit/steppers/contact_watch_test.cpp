// What steps by the clocks of impacts leave of their contacts, and how far it is to the next: of single pairs, from what a step did to them.
#include <gtest/gtest.h>

#include <cmath>

#include "kernels/steppers/contact_watch.hpp"

namespace slideway::contact_watch_test {
namespace {

using Watch = ContactWatch<double, 1>;
using Memory = ContactMemory<double, 1>;

/// What a step finds of four pairs: their depths [m] and rates [m/s].
struct Contact { Quad<double> penetration[1], rate[1]; };

ClockedStep<double> step_of_time() { return {1e-4, {-1, 0, 0}, {-1, 0, 0}, 0}; }
/// By the clock of pair a, whose √δ goes from one root to another [√m].
ClockedStep<double> step_by_first(double from, double to, double rate) { return {1e-2, {0, from, rate}, {0, to, rate}, 0}; }

/// Four pairs at the start of a step; which of them are held to touch follows from their depths.
struct Pairs {
    Watch watch;
    Memory memory;

    explicit Pairs(Contact const& start) {
        start_memory(memory);
        watch.begin(true, start, memory, Watching::clocks);
    }
};

TEST(ContactWatch, TakesTheSpeedOfATouchAndNoneBelowTheLeast) {
    Contact const start{{{-1e-6, -1e-6, -1e-6, 2e-6}}, {{0.3, 1e-6, 0.3, 0.2}}}, end{{{1e-9, 1e-9, -1e-9, -1e-9}}, {{0.25, 1e-6, 0.3, -0.1}}};
    for (bool const remembers : {true, false}) {
        Pairs pairs(start);
        pairs.memory.impact_speed[0] = {7, 7, 7, 7};
        pairs.watch.update(true, end, pairs.memory, step_of_time(), remembers);
        auto const& speed = pairs.memory.impact_speed[0];
        EXPECT_EQ(speed.a, remembers ? 0.25 : 7) << "the rate at its touch";
        EXPECT_EQ(speed.b, remembers ? 1e-4 : 7) << "slower than v0 may be (docs/explanation/model.md 4)";
        EXPECT_EQ(speed.c, 7) << "it does not touch";
        EXPECT_EQ(speed.d, 7) << "it parts";
    }
}

TEST(ContactWatch, TellsPartingsByDepthFromThatOfTheClock) {
    // Pairs a and b touch at the start, c does not.
    Contact const start{{{1e-6, 4e-6, -1e-6, -1e-6}}, {{-0.1, -0.2, 0.1, 0}}};
    auto const after = [&](Contact const& end, ClockedStep<double> const& step, bool accepted = true) {
        Pairs pairs(start);
        return pairs.watch.update(accepted, end, pairs.memory, step, false);
    };
    double const rising = -0.1;
    // The clock's own pair: what is left of its root is little, whatever its depth in the state.
    for (double const left : {1e-12, -1e-12}) {
        auto const own = after({{{left, 3e-6, -1e-6, -1e-6}}, {{rising, -0.2, 0.1, 0}}}, step_by_first(1e-3, 1e-6, rising));
        EXPECT_TRUE(own.lanes);
        EXPECT_FALSE(own.by_depth);
    }
    // Another one leaves its face meanwhile.
    auto const other = after({{{5e-7, -1e-9, -1e-6, -1e-6}}, {{rising, -0.2, 0.1, 0}}}, step_by_first(1e-3, 7e-4, rising));
    EXPECT_TRUE(other.lanes);
    EXPECT_TRUE(other.by_depth);
    // A pair that touches does not part, one that stays does neither, and a step that is not accepted changes nothing.
    auto const touch = after({{{1e-6, 4e-6, 1e-9, -1e-6}}, {{rising, -0.2, 0.1, 0}}}, step_of_time());
    EXPECT_TRUE(touch.lanes);
    EXPECT_FALSE(touch.by_depth);
    auto const stays = after({{{1e-6, 3e-6, -1e-7, -1e-6}}, {{rising, -0.2, 0.1, 0}}}, step_of_time());
    EXPECT_FALSE(stays.lanes || stays.by_depth);
    auto const rejected = after({{{1e-6, -1e-9, 1e-9, -1e-6}}, {{rising, -0.2, 0.1, 0}}}, step_of_time(), false);
    EXPECT_FALSE(rejected.lanes || rejected.by_depth);
}

TEST(ContactWatch, KnowsTheWayToTheNextTouchAtConstantRates) {
    constexpr double located = 2e-8, half = located / 2;
    auto const way = [](Contact const& start, Contact const& end, ClockedStep<double> const& step) {
        Pairs pairs(start);
        return pairs.watch.way_to_turn(pairs.memory, end, step, located);
    };
    Quad<double> const away{-1e-3, -1e-3, -1e-3, -1e-3}, rest{0, 0, 0, 0};
    EXPECT_GE(way({{away}, {rest}}, {{away}, {rest}}, step_of_time()), 1e300) << "nothing nears";
    // By time: a sinks 3 µm at 0.2 m/s, b, which touches, rises 2 µm at 0.1 m/s; both a half of `located` beyond.
    Contact const start{{{-5e-6, 4e-6, -1e-3, -1e-3}}, {{0.2, -0.1, 0, 0}}}, end{{{-3e-6, 2e-6, -1e-3, -1e-3}}, {{0.2, -0.1, 0, 0}}};
    EXPECT_NEAR(way(start, end, step_of_time()), (3e-6 + half) / 0.2, 1e-18);
    Contact const rises{{{-5e-6, 4e-6, -1e-3, -1e-3}}, {{0.01, -0.1, 0, 0}}}, risen{{{-3e-6, 2e-6, -1e-3, -1e-3}}, {{0.01, -0.1, 0, 0}}};
    EXPECT_NEAR(way(rises, risen, step_of_time()), (2e-6 + half) / 0.1, 1e-18);
    // The other way round neither gets there.
    Contact const part{{{-5e-6, 4e-6, -1e-3, -1e-3}}, {{-0.2, 0.1, 0, 0}}}, parted{{{-6e-6, 5e-6, -1e-3, -1e-3}}, {{-0.2, 0.1, 0, 0}}};
    EXPECT_GE(way(part, parted, step_of_time()), 1e300);
}

TEST(ContactWatch, CountsThatWayByTheClockOfAnImpact) {
    constexpr double located = 2e-8, half = located / 2;
    // Pair a has the clock: u = 2e-3 √m goes out at du/ds = δ' = -0.25 m/s.  Pair b sinks 3 µm at 0.2 m/s, which the clock counts 2u times as fast.
    Contact const start{{{9e-6, -5e-6, -1e-3, -1e-3}}, {{-0.25, 0.2, 0, 0}}};
    auto const way = [&](double sinking) {
        Pairs pairs(start);
        Contact const end{{{4e-6, -3e-6, -1e-3, -1e-3}}, {{-0.25, sinking, 0, 0}}};
        return pairs.watch.way_to_turn(pairs.memory, end, step_by_first(3e-3, 2e-3, -0.25), located);
    };
    EXPECT_NEAR(way(0.0), 2e-3 / 0.25, 1e-17) << "its own way out";
    EXPECT_NEAR(way(0.2), (3e-6 + half) / (4e-3 * 0.2), 1e-17) << "the other comes first";
}

TEST(ContactWatch, CountsTheWayOfAPairThatHasJustPartedFromWhereItIs) {
    // Held apart, and left 4 nm within its face by what its parting was located to: it touches again a half of `located` deeper than there.
    constexpr double located = 2e-8, within = 4e-9;
    Pairs pairs({{{within, -1e-3, -1e-3, -1e-3}}, {{0.1, 0, 0, 0}}});
    pairs.memory.held[0].a = 0;
    Contact const end{{{within + 1e-9, -1e-3, -1e-3, -1e-3}}, {{0.1, 0, 0, 0}}};
    EXPECT_NEAR(pairs.watch.way_to_turn(pairs.memory, end, step_of_time(), located), (located / 2 - 1e-9) / 0.1, 1e-18);
}

/// The next step of four pairs whose depths and rates change as they did in the last one.
double next_step(Contact const& start, Contact const& end, double step, double next) {
    Watch watch;
    watch.keep(true, start);
    return watch.next_step(end, step, next);
}

TEST(NextStep, EndsJustBeyondTheFirstTouchOrParting) {
    // From here on a falls 5 µm into its face, at 0.02 m/s and 30 m/s²; b rises 8 µm out of its own, at 0.05 m/s, slower by 20 m/s².
    constexpr double last = 1e-4;
    Contact const start{{{-1e-5, 2e-5, -1e-3, -1e-3}}, {{0.02 - 30 * last, -0.05 - 20 * last, 0, 0}}};
    Contact const end{{{-5e-6, 8e-6, -1e-3, -1e-3}}, {{0.02, -0.05, 0, 0}}};
    double const parts = (0.05 - std::sqrt(0.05 * 0.05 - 2 * 20 * 8e-6)) / 20, touches = (std::sqrt(0.02 * 0.02 + 2 * 30 * 5e-6) - 0.02) / 30;
    ASSERT_LT(parts, touches);
    EXPECT_NEAR(next_step(start, end, last, 1e-3), 1.001 * parts, 1e-15);
    EXPECT_EQ(next_step(start, end, last, 0.9 * parts), 0.9 * parts) << "nothing comes within it";
    // Without b, a is the first.
    Contact const apart{{{-5e-6, -1e-3, -1e-3, -1e-3}}, {{0.02, 0, 0, 0}}};
    EXPECT_NEAR(next_step(start, apart, last, 1e-3), 1.001 * touches, 1e-15);
}

TEST(NextStep, CrossesWhatIsNoFartherThanAFiftiethOfIt) {
    Contact const start{{{-1e-6, -1e-3, -1e-3, -1e-3}}, {{0.1, 0, 0, 0}}}, end{{{-1e-7, -1e-3, -1e-3, -1e-3}}, {{0.1, 0, 0, 0}}};
    EXPECT_EQ(next_step(start, end, 1e-5, 1e-4), 1e-4);
    EXPECT_NEAR(next_step(start, end, 1e-5, 4e-5), 1.001e-6, 1e-18);
}

TEST(NextStep, KnowsNothingOfPairsThatTurnBackOrStay) {
    // a comes within 1 µm of its face and is gone again at the end of the step; b rests on zero depth.
    Contact const start{{{-5e-6, 0, -1e-3, -1e-3}}, {{0.3, 0, 0, 0}}}, end{{{-4e-6, 0, -1e-3, -1e-3}}, {{0.1, 0, 0, 0}}};
    EXPECT_EQ(next_step(start, end, 1e-4, 1e-3), 1e-3);
}

TEST(NextStep, SeesApproachesThatSlowDown) {
    // 5 µm at 0.1 m/s and −800 m/s²: there after 69 µs, and out of the face again after 181 µs.
    constexpr double last = 1e-5;
    Contact const start{{{-6e-6, -1e-3, -1e-3, -1e-3}}, {{0.1 + 800 * last, 0, 0, 0}}}, end{{{-5e-6, -1e-3, -1e-3, -1e-3}}, {{0.1, 0, 0, 0}}};
    EXPECT_NEAR(next_step(start, end, last, 1.5e-4), 1.001 * (0.1 - std::sqrt(0.01 - 2 * 800 * 5e-6)) / 800, 1e-15);
}

TEST(NextStep, IsByRatesAloneWhereTheLastStepIsNotKnown) {
    double const none = std::nan("");
    Contact const start{{{none, none, none, none}}, {{none, none, none, none}}}, end{{{-5e-6, -1e-3, -1e-3, -1e-3}}, {{0.1, 0, 0, 0}}};
    EXPECT_NEAR(next_step(start, end, 0, 1e-3), 1.001 * 5e-5, 1e-18);
}

TEST(NextStep, IsForMethodsThatMayShortenIt) {
    Contact const start{{{-1e-5, -1e-3, -1e-3, -1e-3}}, {{0.1, 0, 0, 0}}}, end{{{-5e-6, -1e-3, -1e-3, -1e-3}}, {{0.1, 0, 0, 0}}};
    for (bool const accepted : {true, false}) {
        Pairs pairs(start);
        double next = 1e-3;
        EXPECT_FALSE(pairs.watch.update(accepted, end, pairs.memory, nullptr, Watching::gaps, 5e-5, &next)) << "it changes no derivative";
        EXPECT_NEAR(next, accepted ? 1.001 * 5e-5 : 1e-3, 1e-18);
        EXPECT_FALSE(pairs.watch.update(accepted, end, pairs.memory, nullptr, Watching::gaps, 5e-5, nullptr));
    }
}

}  // namespace
}  // namespace slideway::contact_watch_test
