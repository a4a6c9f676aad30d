// The oracle of the planar mechanism held against algebra, energy, and the spatial oracle where both know the answer.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <set>
#include <vector>

#include "kernels/mechanisms/list.hpp"
#include "tests/oracle/oracle.hpp"
#include "tests/oracle/planar.hpp"
#include "tests/oracle/planar_runs.hpp"

namespace planar_test {
namespace {

using oracle::Corners;
using oracle::PlanarCase;
using oracle::PlanarMechanism;
using oracle::PlanarResult;
using oracle::PlanarState;
using slideway::Damping;
using slideway::Inputs;
using slideway::Mechanism;
using slideway::Parts;
using Real = long double;

constexpr std::uint64_t seed = 2010;
constexpr Parts driven{.mechanism = Mechanism::planar_slider_crank};
constexpr Parts released{.mechanism = Mechanism::planar_slider_crank, .drive = {.by = slideway::DriveBy::nothing}};

double number(Real x) { return static_cast<double>(x); }

Real margin(PlanarResult const& r) {
    Real least = std::numeric_limits<Real>::infinity();
    for (Real const depth : r.depth) least = std::min(least, std::abs(depth));
    return least;
}
Real sum(Corners const& values) { return values[0] + values[1] + values[2] + values[3]; }

PlanarState moved(PlanarState state, PlanarState const& slope, Real by) {
    for (std::size_t i = 0; i < state.size(); ++i) state[i] += by * slope[i];
    return state;
}

/// Slope of a quantity along the flow, without its h² error.
template <class Of> Real slope_along_flow(PlanarState const& s, PlanarState const& flow, Real h, Of const& of) {
    auto const central = [&](Real step) { return (of(moved(s, flow, step)) - of(moved(s, flow, -step))) / (2 * step); };
    return (4 * central(h) - central(2 * h)) / 3;
}

/// A step that moves no corner by more than a thousandth of its distance to the wall.
Real small_step(PlanarState const& s, PlanarResult const& r) {
    Real turning = 1, fastest = 1e-9L, fiercest = 1;
    for (std::size_t i = 3; i < 6; ++i) {
        turning = std::max(turning, std::abs(s[i]));
        fiercest = std::max(fiercest, std::abs(r.derivative[i]));
    }
    for (Real const rate : r.rate) fastest = std::max(fastest, std::abs(rate));
    Real const gap = 1e-3L * margin(r);
    return std::min({1e-4L / turning, gap / fastest, std::sqrt(gap / fiercest)});
}

TEST(OraclePlanar, ChangesItsEnergyByThePowersAlone) {
    int touching = 0;
    for (PlanarCase const& c : oracle::make_planar_cases(seed, 960)) {
        PlanarMechanism const mechanism(c.inputs, c.parts);
        PlanarState const state = oracle::planar_start(c.inputs);
        Real const torque = c.parts.drive.turns_freely() ? 0.3L : 0;
        auto const at = [&](PlanarState const& s) { return mechanism.at(s, &c.impact_speeds, torque); };
        PlanarResult const r = at(state);
        Real const step = small_step(state, r);
        Real const slope =
            slope_along_flow(state, r.derivative, step, [&](PlanarState const& s) { return at(s).energy; });
        Real const rounding = 1e-18L * (std::abs(r.energy) + 0.01L) / step;
        Real scale = std::abs(r.power_drive) + r.power_friction + std::abs(r.power_damping) + 1e-9L;
        for (std::size_t i = 0; i < 4; ++i) scale += r.force[i] * std::abs(r.rate[i]);
        EXPECT_NEAR(number(slope), number(r.power_drive - r.power_friction - r.power_damping),
                    number(3e-6L * scale + rounding));
        EXPECT_GE(r.power_friction, 0);
        EXPECT_EQ(r.power_drive, r.drive_torque * state[3]);
        EXPECT_LT(rounding, 1e-3L * scale + 1e-9L);
        touching += sum(r.force) > 0;
    }
    EXPECT_GT(touching, 400);
}

TEST(OraclePlanar, HasTheRatesOfItsPlaces) {
    for (PlanarCase const& c : oracle::make_planar_cases(seed + 1, 240)) {
        PlanarMechanism const mechanism(c.inputs, c.parts);
        PlanarState const state = oracle::planar_start(c.inputs);
        PlanarResult const r = mechanism.at(state);
        Real const h = 1e-7L / (1 + std::abs(state[3]) + std::abs(state[4]) + std::abs(state[5]));
        auto const slope = [&](auto const& of) {
            return number(
                slope_along_flow(state, r.derivative, h, [&](PlanarState const& s) { return of(mechanism.at(s)); }));
        };
        for (std::size_t i = 0; i < 4; ++i)
            EXPECT_NEAR(slope([i](PlanarResult const& at) { return at.depth[i]; }), number(r.rate[i]), 1e-9);
        EXPECT_NEAR(slope([](PlanarResult const& at) { return at.x; }), number(r.vx), 1e-9);
        EXPECT_NEAR(slope([](PlanarResult const& at) { return at.y; }), number(r.vy), 1e-9);
        double const fierce = number(std::hypot(r.ax, r.ay)) + 1;
        EXPECT_NEAR(slope([](PlanarResult const& at) { return at.vx; }), number(r.ax), 1e-7 * fierce);
        EXPECT_NEAR(slope([](PlanarResult const& at) { return at.vy; }), number(r.ay), 1e-7 * fierce);
    }
}

TEST(OraclePlanar, StartsWhereTheInputsPutTheBlock) {
    for (PlanarCase const& c : oracle::make_planar_cases(seed + 2, 60)) {
        PlanarResult const r = PlanarMechanism(c.inputs, c.parts).at(oracle::planar_start(c.inputs));
        EXPECT_NEAR(number(r.y), c.inputs.y, 1e-17);
        EXPECT_NEAR(number(r.vy), c.inputs.vy, 1e-15);
        EXPECT_GT(r.x, c.inputs.crank_length * std::cos(c.inputs.start_angle));
    }
    PlanarState const check = oracle::planar_start(oracle::planar_check_inputs());
    EXPECT_NEAR(number(check[4]), -75, 1e-12);  // model.md 7
}

TEST(OraclePlanar, MovesAFreeCrankByTheTorqueOfADriveAsTheDriveDoes) {
    for (PlanarCase const& c : oracle::make_planar_cases(seed + 3, 240)) {
        Parts parts = c.parts;
        parts.drive.by = slideway::DriveBy::speed;
        PlanarState const state = oracle::planar_start(c.inputs);
        PlanarResult const held = PlanarMechanism(c.inputs, parts).at(state, &c.impact_speeds);
        parts.drive.by = slideway::DriveBy::nothing;
        PlanarMechanism const loose(c.inputs, parts);
        PlanarResult const pushed = loose.at(state, &c.impact_speeds, held.drive_torque);
        EXPECT_EQ(held.derivative[3], 0);
        Real const fierce = std::abs(held.derivative[4]) + std::abs(held.derivative[5]) + 1;
        for (std::size_t i = 0; i < 6; ++i)
            EXPECT_NEAR(number(held.derivative[i]), number(pushed.derivative[i]), number(1e-12L * fierce));
        // Without it the crank speeds up by as much as J of the mass matrix leaves of it, and never against it.
        PlanarResult const let_go = loose.at(state, &c.impact_speeds);
        EXPECT_LE(let_go.derivative[3] * held.drive_torque, 0);
    }
}

/// Depth, parallel to the wall, at which the corners of one wall carry a load together.
double depth_under(Inputs const& in, double load) {
    return std::pow(load / 2 / in.point_stiffness, 1 / in.hertz_exponent);
}

TEST(OraclePlanar, RestsUnderTheLoadsOfStatics) {
    Inputs in = oracle::planar_check_inputs();
    in.start_angle = 0.7, in.crank_speed = 0;
    double const load = (in.rod_mass / 2 + in.slider_mass) * 9.81;  // the crank pin bears the other half of the rod
    in.y = -in.clearance_y - depth_under(in, load);
    PlanarResult const r = PlanarMechanism(in, driven).at(oracle::planar_start(in));
    EXPECT_EQ(r.surfaces, 1);
    EXPECT_NEAR(number(sum(r.force)), load, 1e-9 * load);
    EXPECT_NEAR(number(r.derivative[4]), 0, 1e-6);
    EXPECT_NEAR(number(r.derivative[5]), 0, 1e-9);
    double const torque = (in.crank_mass + in.rod_mass) / 2 * 9.81 * in.crank_length * std::cos(0.7);
    EXPECT_NEAR(number(r.drive_torque), torque, 1e-8 * torque);
    double const height = in.crank_length * std::sin(0.7);  // of the pin; the block is at in.y
    double const weight =
        9.81 * (in.crank_mass * height / 2 + in.rod_mass * (height + in.y) / 2 + in.slider_mass * in.y);
    EXPECT_NEAR(number(r.energy - r.contact_potential), weight, 1e-15);
}

TEST(OraclePlanar, LetsABlockOnMasslessLinksFallFreely) {
    Inputs in = oracle::planar_check_inputs();
    in.crank_mass = in.rod_mass = in.crank_inertia = in.rod_inertia = 0;
    in.inclination = 0.3, in.start_angle = 1.1, in.crank_speed = 20;
    PlanarResult const r = PlanarMechanism(in, released).at(oracle::planar_start(in));
    EXPECT_NEAR(number(r.ax), -9.81 * std::sin(0.3), 1e-13);
    EXPECT_NEAR(number(r.ay), -9.81 * std::cos(0.3), 1e-13);
    EXPECT_EQ(r.derivative[5], 0);
}

TEST(OraclePlanar, TurnsTheBlockByTheArmOfItsCorner) {
    Inputs in = oracle::planar_check_inputs();
    Parts parts = released;
    parts.friction = true;
    double const tilt = 5e-3, depth = 1e-5;  // the corner C1 and, 0.5 mm above the wall, C4
    in.pitch = tilt;
    in.y = in.clearance_y + depth + 0.025 - 0.05 * std::sin(tilt) - 0.025 * std::cos(tilt);
    in.crank_speed = in.vy = in.wz = 0;
    in.start_angle = 0.5;
    PlanarState state = oracle::planar_start(in);
    state[3] = 2;
    PlanarResult const r = PlanarMechanism(in, parts).at(state);
    double const rate = number(r.vy);  // ψ' = 0
    double const force = 1e11 * std::pow(depth, 1.5) + 0.01 * 1e11 * depth * rate;
    EXPECT_NEAR(number(r.force[0]), force, 1e-9 * force);
    EXPECT_EQ(sum(r.force), r.force[0]);
    EXPECT_EQ(r.points, 1);
    double const friction = 0.1 * force * (r.vx > 0 ? -1 : 1);  // sliding fast, kinetic friction
    double const arm_x = 0.05 * std::cos(tilt) - 0.025 * std::sin(tilt);
    double const arm_y = 0.05 * std::sin(tilt) + 0.025 * std::cos(tilt);
    double const moment = -force * arm_x - friction * arm_y;
    EXPECT_NEAR(number(r.derivative[5]), moment / in.slider_inertia_z, 1e-8 * force / in.slider_inertia_z);
    EXPECT_NEAR(number(r.power_friction), 0.1 * force * number(std::abs(r.vx)), 1e-9 * force);
}

TEST(OraclePlanar, DampsByTheImpactSpeedOfEachCorner) {
    Inputs in = oracle::planar_check_inputs();
    in.y = -in.clearance_y - 2e-6, in.vy = -0.05;
    Parts parts = released;
    parts.damping = Damping::restitution;
    Corners const speeds = {9, 0.4L, 0, 9};  // C3 counts as 1e-4 m/s
    PlanarResult const r = PlanarMechanism(in, parts).at(oracle::planar_start(in), &speeds);
    double const elastic = 1e11 * std::pow(2e-6, 1.5), slope = 2.082498164147;  // model.md 4, e = 0.4
    EXPECT_NEAR(number(r.force[1]), elastic * (1 + slope * 0.05 / 0.4), 1e-8 * elastic);
    EXPECT_NEAR(number(r.force[2]), elastic * (1 + slope * 0.05 / 1e-4), 1e-8 * elastic * 1e3);
    in.vy = 0.5;
    EXPECT_EQ(PlanarMechanism(in, parts).at(oracle::planar_start(in), &speeds).force[2], 0);  // never pulls
}

TEST(OraclePlanar, FliesAsTheSpatialMechanismDoes) {
    Inputs in = oracle::planar_check_inputs();
    in.way_width = in.slider_height;
    in.inclination = 0.2;
    for (double angle = -3; angle < 3.1; angle += 0.25) {
        in.start_angle = angle, in.crank_speed = 40 * std::sin(5 * angle);
        in.y = 3e-4 * std::cos(7 * angle), in.vy = 0.2 * std::sin(3 * angle);
        oracle::State state{};
        state[0] = in.y, state[2] = in.vy;
        auto const spatial = oracle::evaluate(in, {}, 0, state);
        PlanarResult const planar = PlanarMechanism(in, driven).at(oracle::planar_start(in));
        EXPECT_NEAR(number(planar.ay), spatial.derivative[2], 1e-10);
        EXPECT_NEAR(number(planar.ax), spatial.acceleration[0], 1e-10);
        EXPECT_NEAR(number(planar.x), spatial.x, 1e-15);
        EXPECT_NEAR(number(planar.vx), spatial.vx, 1e-14);
        EXPECT_NEAR(number(planar.drive_torque), spatial.crank_torque_with_weight, 1e-12);
    }
}

TEST(RandomPlanarStates, TouchInEveryWayWithAllParts) {
    std::set<std::array<int, 2>> modes;
    std::set<int> parts, walls;
    std::array<std::set<double>, sizeof(Inputs) / sizeof(double)> seen;
    for (PlanarCase const& c : oracle::make_planar_cases(seed, 960)) {
        PlanarResult const r = PlanarMechanism(c.inputs, c.parts).at(oracle::planar_start(c.inputs), &c.impact_speeds);
        modes.insert({r.surfaces, r.points});
        for (int i = 0; i < 4; ++i)
            if (r.depth[static_cast<std::size_t>(i)] > 0) walls.insert(i + 4 * r.surfaces);
        parts.insert(static_cast<int>(c.parts.damping) + 3 * c.parts.friction + 6 * c.parts.drive.turns_freely());
        for (Real const rate : r.derivative) EXPECT_TRUE(std::isfinite(rate));
        auto const values = std::bit_cast<std::array<double, sizeof(Inputs) / sizeof(double)>>(c.inputs);
        for (std::size_t i = 0; i < values.size(); ++i) seen[i].insert(values[i]);
    }
    EXPECT_EQ(modes, (std::set<std::array<int, 2>>{{0, 0}, {0, 1}, {0, 2}, {1, 0}}));
    EXPECT_EQ(walls.size(), 8u);
    EXPECT_EQ(parts.size(), 12u);
    Inputs const where;
    for (double const* member : {&where.crank_length,
                                 &where.rod_length,
                                 &where.crank_speed,
                                 &where.start_angle,
                                 &where.gravity,
                                 &where.inclination,
                                 &where.crank_mass,
                                 &where.rod_mass,
                                 &where.rod_inertia,
                                 &where.crank_inertia,
                                 &where.slider_mass,
                                 &where.slider_inertia_z,
                                 &where.slider_length,
                                 &where.slider_height,
                                 &where.clearance_y,
                                 &where.point_stiffness,
                                 &where.hertz_exponent,
                                 &where.eta,
                                 &where.restitution,
                                 &where.friction_static,
                                 &where.friction_kinetic,
                                 &where.friction_stick_speed,
                                 &where.friction_slip_speed,
                                 &where.y,
                                 &where.vy,
                                 &where.pitch,
                                 &where.wz}) {
        auto const place = static_cast<std::size_t>(member - reinterpret_cast<double const*>(&where));
        EXPECT_GT(seen[place].size(), 100u) << "number " << place << " of Inputs";
    }
}

}  // namespace
}  // namespace planar_test
