// The Lorenz equations against their algebra.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/models/fixed_step.hpp"
#include "tests/models/lorenz.hpp"

namespace slideway::lorenz_test {
namespace {

using State = std::array<double, 3>;

State rates_at(State const& s, Lorenz::Inputs const& in) {
    State rates;
    Lorenz::Report<double> report;
    Lorenz::derivative<false>(0.0, s.data(), Lorenz::parameters(in), {}, rates.data(), &report);
    return rates;
}

TEST(Lorenz, DerivativeIsTheOneOfTheEquations) {
    // x' = 10 (3 − 2), y' = 2 (28 − 5) − 3, z' = 2 · 3 − 8/3 · 5
    auto const rates = rates_at({2, 3, 5}, {});
    EXPECT_DOUBLE_EQ(rates[0], 10);
    EXPECT_DOUBLE_EQ(rates[1], 43);
    EXPECT_NEAR(rates[2], 6 - 40.0 / 3, 1e-14);
}

TEST(Lorenz, EveryParameterIsTheMembersOwn) {
    auto const rates = rates_at({2, 3, 5}, {.sigma = 4, .rho = 7, .beta = 0.5});
    EXPECT_DOUBLE_EQ(rates[0], 4);
    EXPECT_DOUBLE_EQ(rates[1], 1);
    EXPECT_DOUBLE_EQ(rates[2], 3.5);
}

TEST(Lorenz, StandsStillAtItsFixedPoints) {
    double const c = std::sqrt(8.0 / 3 * 27);
    for (State const& s : {State{0, 0, 0}, State{c, c, 27}, State{-c, -c, 27}}) {
        for (double const rate : rates_at(s, {})) EXPECT_NEAR(rate, 0, 1e-13);
    }
}

TEST(Lorenz, SettlesOnItsStableFixedPoint) {
    // For 1 < ρ < 24.74 both points off the axis attract.
    Lorenz::Inputs const in{.rho = 10};
    State end;
    fixed_step<Lorenz, double>({&in, 1, 0.01, 10'000, end.data()});
    double const c = std::sqrt(8.0 / 3 * 9);
    EXPECT_NEAR(std::abs(end[0]), c, 1e-12);
    EXPECT_NEAR(end[1], end[0], 1e-12);
    EXPECT_NEAR(end[2], 9, 1e-12);
}

TEST(Lorenz, MaximumOfZIsItsEvent) {
    Lorenz::Inputs const in;
    auto const p = Lorenz::parameters(in);
    State const s{2, 3, 5};
    auto const at = rates_at(s, in);
    double value, slope;
    Lorenz::event_values(0.0, s.data(), at.data(), p, &value, &slope);
    EXPECT_EQ(value, at[2]);
    EXPECT_EQ(Lorenz::event_table[0].direction, Direction::falling);
    EXPECT_FALSE(Lorenz::event_table[0].resets);
    // z'' by a central difference of z' along the flow's tangent.
    auto const z_rate = [&](double h) {
        return rates_at({s[0] + h * at[0], s[1] + h * at[1], s[2] + h * at[2]}, in)[2];
    };
    EXPECT_NEAR(slope, (z_rate(1e-3) - z_rate(-1e-3)) / 2e-3, 1e-9 * std::abs(slope));
}

}  // namespace
}  // namespace slideway::lorenz_test
