// The relief valve against its algebra, and its rules where the equations say nothing.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "tests/models/relief_valve.hpp"

namespace slideway::relief_valve_test {
namespace {

using State = std::array<double, 3>;

State rates_at(State const& s, double inflow) {
    State rates;
    ReliefValve::Report<double> report;
    ReliefValve::derivative<false>(0.0, s.data(), ReliefValve::parameters({.inflow = inflow}), {}, rates.data(),
                                   &report);
    return rates;
}

State after_impact(State s, double inflow, int event = ReliefValve::impact) {
    ReliefValve::reset(event, true, s.data(), ReliefValve::parameters({.inflow = inflow}));
    return s;
}

TEST(ReliefValve, DerivativeIsTheOneOfTheEquations) {
    // v' = −1.25 · 2 − (0.5 + 10) + 9, p' = 20 (4 − 0.5 · 3)
    auto const rates = rates_at({0.5, 2, 9}, 4);
    EXPECT_EQ(rates[0], 2);
    EXPECT_DOUBLE_EQ(rates[1], -4);
    EXPECT_DOUBLE_EQ(rates[2], 50);
}

TEST(ReliefValve, StandsStillAtItsEquilibrium) {
    // x √p = q and p = x + 10: x = 6, p = 16, q = 24.
    auto const rates = rates_at({6, 0, 16}, 24);
    for (double const rate : rates) EXPECT_EQ(rate, 0);
    EXPECT_TRUE(ReliefValve::at_rest(rates.data()));
    EXPECT_FALSE(ReliefValve::at_rest(rates_at({6, 0, 16}, 24.1).data()));
    EXPECT_FALSE(ReliefValve::at_rest(rates_at({6, 1e-3, 16}, 24).data()));
}

TEST(ReliefValve, NothingFlowsOutWithoutPressure) {
    for (double const pressure : {0.0, -1e-3, -5.0}) {
        auto const rates = rates_at({0.5, 0, pressure}, 4);
        EXPECT_EQ(rates[2], 80) << pressure;
        EXPECT_DOUBLE_EQ(rates[1], pressure - 10.5) << pressure;
    }
}

TEST(ReliefValve, NanStaysNan) {
    double const nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_TRUE(std::isnan(rates_at({0.5, 0, nan}, 4)[1]));
    EXPECT_TRUE(std::isnan(rates_at({0.5, 0, nan}, 4)[2]));
    EXPECT_TRUE(std::isnan(rates_at({nan, 0, 1}, 4)[1]));
    EXPECT_TRUE(std::isnan(rates_at({0.5, nan, 1}, 4)[0]));
}

TEST(ReliefValve, StartsWhereTheIssueSays) {
    State s;
    ReliefValve::initial_state({.inflow = 3}, s.data());
    EXPECT_EQ(s, (State{0.2, 0, 0}));
}

TEST(ReliefValve, ImpactReturnsFourFifthsOfTheSpeed) {
    auto const s = after_impact({-1e-17, -2, 7}, 4);
    EXPECT_EQ(s[0], 0);
    EXPECT_DOUBLE_EQ(s[1], 1.6);
    EXPECT_EQ(s[2], 7);
}

TEST(ReliefValve, OnlyImpactsReset) {
    State const s{0.3, 1e-17, 7};
    EXPECT_EQ(after_impact(s, 4, ReliefValve::extremum), s);
    State unchanged{-1e-17, -2, 7};
    ReliefValve::reset(ReliefValve::impact, false, unchanged.data(), ReliefValve::parameters({.inflow = 4}));
    EXPECT_EQ(unchanged, (State{-1e-17, -2, 7}));
}

TEST(ReliefValve, BouncesEndOnTheSeatBelowTheOpeningPressure) {
    EXPECT_EQ(after_impact({0, -1e-6, 7}, 4), (State{0, 0, 7}));
    EXPECT_GT(after_impact({0, -1.3e-6, 7}, 4)[1], 0) << "rebounds at 1.04e-6";
    EXPECT_GT(after_impact({0, -1e-7, 10.5}, 4)[1], 0) << "the pressure opens the valve";
    EXPECT_GT(after_impact({0, -1e-7, 9.999}, 4)[1], 0) << "the pressure will open it before the bounces end";
}

TEST(ReliefValve, StaysOnItsSeatUntilThePressureLiftsIt) {
    auto const closed = rates_at({0, 0, 9.99}, 4);
    EXPECT_EQ(closed[0], 0);
    EXPECT_EQ(closed[1], 0);
    EXPECT_EQ(closed[2], 80);
    EXPECT_NEAR(rates_at({0, 0, 10.01}, 4)[1], 0.01, 1e-14);
    // Not at rest: the pressure rises.
    EXPECT_FALSE(ReliefValve::at_rest(closed.data()));
    // A stage that passes through the seat is not on it.
    EXPECT_NEAR(rates_at({0, -1e-300, 9}, 4)[1], -1, 1e-14);
    EXPECT_NEAR(rates_at({-1e-300, 0, 9}, 4)[1], -1, 1e-14);
}

TEST(ReliefValve, EventsAreImpactsAndExtrema) {
    State const s{0.5, 2, 9};
    auto const rates = rates_at(s, 4);
    double value[2], slope[2];
    ReliefValve::event_values(0.0, s.data(), rates.data(), ReliefValve::parameters({.inflow = 4}), value, slope);
    EXPECT_EQ(value[ReliefValve::impact], 0.5);
    EXPECT_EQ(slope[ReliefValve::impact], 2);
    EXPECT_EQ(value[ReliefValve::extremum], 2);
    EXPECT_EQ(slope[ReliefValve::extremum], rates[1]);
    EXPECT_EQ(ReliefValve::event_table[ReliefValve::impact].direction, Direction::falling);
    EXPECT_TRUE(ReliefValve::event_table[ReliefValve::impact].resets);
    EXPECT_EQ(ReliefValve::event_table[ReliefValve::extremum].direction, Direction::both);
    EXPECT_FALSE(ReliefValve::event_table[ReliefValve::extremum].resets);
}

}  // namespace
}  // namespace slideway::relief_valve_test
