// The laws of the oracle held against algebra: contact, friction, restitution, damping, their domains.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "tests/oracle/oracle.hpp"
#include "tests/oracle/random_states.hpp"
#include "tests/unit/oracle/oracle_fixture.hpp"

namespace oracle_laws_test {
namespace {

using oracle::Case;
using oracle::Pairs;
using oracle::Result;
using oracle::State;
using oracle::testing::evaluate;
using oracle::testing::joined;
using oracle::testing::slope;
using oracle::testing::sum;
using oracle::testing::Triple;
using slideway::Damping;
using slideway::Inputs;
using slideway::Law;

TEST(Oracle, FlatSliderBearsOnOneSurfaceByItsStiffness) {
    Inputs const in = oracle::completed({});
    double const depth = 2e-9;
    State state{};
    state[0] = -(in.clearance_y + depth);
    Result const r = oracle::evaluate(in, {}, 0, state);
    EXPECT_EQ((Triple{r.surfaces, r.lines, r.points}), (Triple{1, 0, 0}));
    // The way's top is pressed by the slider that came down: E_s A/l with E_s = E, A = 40 x 30 mm, l = 20 mm.
    EXPECT_EQ(r.faces[oracle::top], oracle::FaceKind::surface);
    double const force = 2.07e11 * 0.04 * 0.03 / 0.02 * depth;
    EXPECT_NEAR(r.normal_force[1], force, 1e-6 * force);
    for (int apex : {1, 4, 5, 8}) EXPECT_NEAR(r.fn_y[apex - 1], force / 4, 1e-6 * force);
    EXPECT_NEAR(r.contact_potential, force * depth / 2, 1e-6 * force * depth);
}

TEST(Oracle, FrictionIsSmoothAtItsTwoSpeeds) {
    Inputs const in;
    EXPECT_EQ(oracle::friction_coefficient(in, 0), 0);
    EXPECT_NEAR(oracle::friction_coefficient(in, in.friction_stick_speed), in.friction_static, 1e-15);
    EXPECT_NEAR(oracle::friction_coefficient(in, in.friction_slip_speed), in.friction_kinetic, 1e-15);
    EXPECT_EQ(oracle::friction_coefficient(in, 1), in.friction_kinetic);
    double const middle = (in.friction_stick_speed + in.friction_slip_speed) / 2;
    EXPECT_NEAR(oracle::friction_coefficient(in, middle), (in.friction_static + in.friction_kinetic) / 2, 1e-15);
    EXPECT_NEAR(oracle::friction_coefficient(in, in.friction_stick_speed / 3), in.friction_static / 2, 1e-15);
    for (double speed : {in.friction_stick_speed, in.friction_slip_speed}) {
        double const step = 1e-6 * speed, here = oracle::friction_coefficient(in, speed);
        // Continuous, and flat: a jump or a kink of first order would show as a multiple of the step.
        EXPECT_NEAR(oracle::friction_coefficient(in, speed - step), here, 1e-11);
        EXPECT_NEAR(oracle::friction_coefficient(in, speed + step), here, 1e-11);
    }
}

TEST(Oracle, LineLoadVanishesWithItsApproachAndSolvesItsEquation) {
    Inputs const in;
    double const length = 0.03, modulus = 2.07e11 / (1 - 0.29 * 0.29) / 2;
    double previous = 0;
    for (double approach = 1e-14; approach < length * length / in.edge_radius; approach *= 10) {
        double const load = oracle::line_load(in, length, approach);
        EXPECT_GT(load, previous);
        EXPECT_LT(load, std::numbers::pi * modulus * length * approach);  // W₋₁ <= -1
        double const x = load / (std::numbers::pi * modulus * length);
        EXPECT_NEAR(x * (1 - std::log(x * in.edge_radius / (length * length))), approach, 1e-14 * approach);
        auto const potential = [&](double step) { return oracle::line_potential(in, length, approach + step); };
        EXPECT_NEAR(slope(potential, 1e-3 * approach), load, 1e-9 * load);
        previous = load;
    }
    EXPECT_LT(oracle::line_load(in, length, 1e-14), 1e-4);
    EXPECT_TRUE(std::isnan(oracle::line_load(in, length, 1.001 * length * length / in.edge_radius)));
}

TEST(Oracle, RestitutionSlopeSolvesItsEquation) {
    EXPECT_NEAR(oracle::restitution_slope(0.4), 2.082498164147, 1e-12);
    EXPECT_EQ(oracle::restitution_slope(1), 0);
    for (double e : {0.02, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99, 0.9999}) {
        double const a = oracle::restitution_slope(e);
        EXPECT_GT(a, 0);
        EXPECT_LE(a, 1 / e);
        if (e >= 0.1) {
            EXPECT_NEAR(a * (1 + e), std::log1p(a) - std::log1p(-e * a), 1e-9 * a);
        }
    }
    // Just below one, two terms of the logarithms' series give 3(1 - e²)/(2(1 + e³)).
    for (double gap : {0x1p-13, 0x1p-20, 0x1p-26, 0x1p-40})
        EXPECT_NEAR(oracle::restitution_slope(1 - gap), 1.5 * gap, 3 * gap * gap);
}

/// Speed after an impact over the speed before: unit mass, Runge-Kutta, from touch to release.
double rebound(std::function<double(double)> const& elastic, double slope, double impact_speed, double duration) {
    auto const acceleration = [&](double h, double v) {
        return h > 0 ? -elastic(h) * std::max(0.0, 1 + slope * v / impact_speed) : 0.0;
    };
    double const dt = duration / 4000;
    double h = 0, v = impact_speed;
    for (int i = 0; i < 400000; ++i) {
        double const a1 = acceleration(h, v);
        double const a2 = acceleration(h + dt / 2 * v, v + dt / 2 * a1);
        double const a3 = acceleration(h + dt / 2 * (v + dt / 2 * a1), v + dt / 2 * a2);
        double const a4 = acceleration(h + dt * (v + dt / 2 * a2), v + dt * a3);
        h += dt * v + dt * dt / 6 * (a1 + a2 + a3);
        v += dt / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
        if (h <= 0) return -v / impact_speed;
    }
    return std::numeric_limits<double>::quiet_NaN();
}

TEST(Oracle, IsolatedImpactReturnsTheRestitution) {
    Inputs const in;
    for (double e : {0.1, 0.4, 0.7, 0.95, 1.0}) {
        double const a = oracle::restitution_slope(e);
        auto const spring = [](double h) { return 1e8 * h; };
        auto const hertz = [](double h) { return 1e10 * std::pow(h, 1.5); };
        auto const line = [&](double h) { return oracle::line_load(in, 0.03, h); };
        for (double speed : {1e-3, 0.5}) {
            EXPECT_NEAR(rebound(spring, a, speed, 3e-4), e, 1e-4);
            EXPECT_NEAR(rebound(hertz, a, speed, 1e-3), e, 1e-4);
            EXPECT_NEAR(rebound(line, a, speed, 1e-4), e, 1e-4);
        }
    }
}

TEST(Oracle, PointDampingFollowsItsKind) {
    Case c = oracle::testing::on_one_apex();
    c.state[2] = 0.02;
    Result const bare = [&] {
        Case still = c;
        still.inputs.eta = 0;
        return evaluate(still);
    }();
    ASSERT_EQ((Triple{bare.surfaces, bare.lines, bare.points}), (Triple{0, 0, 1}));
    auto const load = [](Result const& r) { return sum(joined(r.fn_y, r.fn_z)); };
    double const rate = 0.02 * std::cos(1e-3) * std::cos(1e-3);
    double const stiffness = 4.0 / 3 * (2.07e11 / (1 - 0.29 * 0.29) / 2) * std::sqrt(5e-4);
    double const depth = 1e-6;
    EXPECT_NEAR(load(bare), stiffness * std::pow(depth, 1.5), 1e-5 * load(bare));
    c.inputs.chi_line = c.inputs.chi_surface = 5;  // no line, no surface here
    c.parts.damping = Damping::rate;
    EXPECT_NEAR(load(evaluate(c)) - load(bare), 0.01 * stiffness * depth * rate, 1e-5 * load(bare));
    c.parts.damping = Damping::restitution;
    c.inputs.restitution = 0.4;
    c.impact_speeds.fill(0.05);
    EXPECT_NEAR(load(evaluate(c)) / load(bare), 1 + 2.082498164147 * rate / 0.05, 1e-5);
    c.state[2] = -1;  // torn off: no contact pulls
    EXPECT_EQ(load(evaluate(c)), 0);
}

TEST(Oracle, DissipatesLinesAndSurfacesByTheRateOfTheirApproach) {
    Inputs in = oracle::completed({});
    in.chi_surface = 7;
    in.chi_line = 3;
    State state{};
    state[0] = -(in.clearance_y + 1e-8);
    state[2] = -0.01;
    auto const force = [&](Damping damping) {
        return oracle::evaluate(in, {.damping = damping}, 0, state).normal_force[1];
    };
    EXPECT_NEAR(force(Damping::rate) / force(Damping::point), 1 + 7 * 0.01, 1e-9);
    state[6] = 1e-5;  // pitch lifts one end: a line is left
    EXPECT_EQ(oracle::evaluate(in, {}, 0, state).lines, 1);
    EXPECT_NEAR(force(Damping::rate) / force(Damping::point), 1 + 3 * 0.01, 1e-5);
}

TEST(Oracle, FlagsALineBeyondItsDomain) {
    Inputs in = oracle::completed({});
    State state{};
    state[0] = -(in.clearance_y + 1e-6);
    state[6] = 1e-3;
    Result const inside = oracle::evaluate(in, {}, 0, state);
    ASSERT_EQ(inside.lines, 1);
    EXPECT_FALSE(inside.contact_domain);
    in.edge_radius = 1e3;  // l²/R_e = 0.9 µm
    Result const beyond = oracle::evaluate(in, {}, 0, state);
    EXPECT_TRUE(beyond.contact_domain);
    EXPECT_FALSE(beyond.geometry);
}

}  // namespace
}  // namespace oracle_laws_test
