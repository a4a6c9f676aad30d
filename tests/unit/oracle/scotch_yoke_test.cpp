// The oracle's scotch yoke: its motion against closed forms and differences, its drive against numbers computed by pencil.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <stdexcept>

#include "kernels/laws/list.hpp"
#include "kernels/mechanisms/list.hpp"
#include "tests/oracle/oracle.hpp"
#include "tests/oracle/spatial_runs.hpp"

namespace scotch_yoke_test {
namespace {

using oracle::Result;
using oracle::State;
using slideway::Inputs;
using slideway::Law;
using slideway::Mechanism;
using slideway::Parts;

constexpr Parts scotch_yoke{.mechanism = Mechanism::scotch_yoke};
constexpr double pi = std::numbers::pi;

/// θ = 30° at t = 0, 4 rad/s: x = 50 mm √3/2, vx = -50 mm x 4/s x 1/2 = -0.1 m/s, ax = -16/s² x = -0.692820... m/s².
Inputs at_thirty_degrees() {
    Inputs in = oracle::completed({});
    in.start_angle = pi / 6;
    in.crank_speed = 4;
    return in;
}

TEST(ScotchYoke, HasTheClosedFormsOfItsQuarters) {
    Inputs const in;  // 50 mm, π rad/s
    auto const expect = [](oracle::AlongTheWay const& got, double x, double vx, double ax) {
        EXPECT_NEAR(static_cast<double>(got.x), x, 1e-16);
        EXPECT_NEAR(static_cast<double>(got.vx), vx, 1e-15);
        EXPECT_NEAR(static_cast<double>(got.ax), ax, 1e-15);
    };
    for (int turn = 0; turn < 5; ++turn) {
        double const start = 2 * turn;
        expect(oracle::scotch_yoke_motion(in, start), 0.05, 0, -0.05 * pi * pi);
        expect(oracle::scotch_yoke_motion(in, start + 0.5), 0, -0.05 * pi, 0);
        expect(oracle::scotch_yoke_motion(in, start + 1), -0.05, 0, 0.05 * pi * pi);
        expect(oracle::scotch_yoke_motion(in, start + 1.5), 0, 0.05 * pi, 0);
    }
    expect(oracle::scotch_yoke_motion(at_thirty_degrees(), 0), 0.025 * std::sqrt(3), -0.1, -0.4 * std::sqrt(3));
}

TEST(ScotchYoke, HasTheSpeedAndAccelerationOfItsDifferences) {
    Inputs in = at_thirty_degrees();
    in.crank_length = 0.07;
    long double const step = 1e-5L;
    for (double const speed : {4.0, -9.0}) {
        in.crank_speed = speed;
        for (long double t = 0; t < 3; t += 0.037L) {
            auto const here = oracle::scotch_yoke_motion(in, t);
            auto const before = oracle::scotch_yoke_motion(in, t - step),
                       after = oracle::scotch_yoke_motion(in, t + step);
            EXPECT_NEAR(static_cast<double>((after.x - before.x) / (2 * step)), static_cast<double>(here.vx), 1e-8);
            EXPECT_NEAR(static_cast<double>((after.vx - before.vx) / (2 * step)), static_cast<double>(here.ax), 1e-7);
        }
    }
}

TEST(ScotchYoke, IsDrivenAgainstSlopeAndInertia) {
    Inputs in = at_thirty_degrees();
    in.inclination = pi / 6;
    State state{};
    state[10] = 7, state[11] = -7;  // nobody reads them
    Result const r = oracle::evaluate(in, scotch_yoke, 0, state);
    // 0.1872 kg x (-0.692820... + 9.81/2) m/s² = 0.788520035... N, which moves back at 0.1 m/s.
    double const force = 0.1872 * (4.905 - 0.4 * std::sqrt(3));
    EXPECT_NEAR(force, 0.788520035, 1e-9);
    EXPECT_NEAR(r.power_crank, -0.1 * force, 1e-14);
    EXPECT_NEAR(r.x, 0.025 * std::sqrt(3), 1e-16);
    EXPECT_NEAR(r.vx, -0.1, 1e-16);
    EXPECT_NEAR(r.acceleration[0], -0.4 * std::sqrt(3), 1e-15);
    EXPECT_EQ(r.ideal_x, r.x);
    EXPECT_NEAR(r.derivative[2], -9.81 * std::sqrt(3) / 2, 1e-14);
    EXPECT_EQ(r.derivative[10], 0);
    EXPECT_EQ(r.derivative[11], 0);
    // M vx²/2 and the height x sin β: no rod.
    EXPECT_NEAR(r.energy, 0.1872 * (0.005 + 9.81 * 0.025 * std::sqrt(3) / 2), 1e-15);
    EXPECT_EQ(r.crank_torque, 0);
    EXPECT_FALSE(r.geometry);
}

TEST(ScotchYoke, IsDrivenAgainstFriction) {
    Inputs in = at_thirty_degrees();
    in.inclination = pi / 6;
    in.law_a = 5e6;
    Parts parts = scotch_yoke;
    parts.law = Law::kelvin_voigt;
    parts.friction = true;
    State lying{};
    lying[0] = -in.clearance_y - 1e-6;
    Result const r = oracle::evaluate(in, parts, 0, lying);
    // Four apices bear 5 N each; kinetic friction of 2 N drives it on, for it moves back.
    double const force = 0.1872 * (4.905 - 0.4 * std::sqrt(3)) - 2;
    EXPECT_NEAR(r.power_crank, -0.1 * force, 1e-12);
    EXPECT_NEAR(r.power_friction, 0.2, 1e-12);
    EXPECT_NEAR(r.derivative[2], 20 / 0.1872 - 9.81 * std::sqrt(3) / 2, 1e-10);
}

TEST(ScotchYoke, TakesNoPowerAtItsDeadCentresNorAtRest) {
    Inputs in = oracle::completed({});
    in.inclination = 0.4;
    EXPECT_EQ(oracle::evaluate(in, scotch_yoke, 0, {}).power_crank, 0);
    in.start_angle = 1, in.crank_speed = 0;
    Result const r = oracle::evaluate(in, scotch_yoke, 3, {});
    EXPECT_EQ(r.power_crank, 0);
    EXPECT_NEAR(r.x, 0.05 * std::cos(1.0), 1e-16);
}

TEST(ScotchYoke, RunsOnAWayThatPassesWhereItsMiddleIs) {
    Inputs in = oracle::completed({});
    in.way_pitch = 0.02, in.way_offset_y = 3e-4;
    Parts parts = scotch_yoke;
    parts.misaligned_way = true;
    State state{};
    state[0] = in.way_offset_y, state[6] = in.way_pitch;
    for (double const depth : oracle::penetrations(in, parts, 0.5, state)) EXPECT_NEAR(depth, -1e-4, 1e-16);
    // 50 mm on, at θ = 0, the way is higher.
    state[0] += 0.05 * std::tan(0.02);
    for (double const depth : oracle::penetrations(in, parts, 0, state)) EXPECT_NEAR(depth, -1e-4, 1e-16);
}

TEST(ScotchYoke, ClosesItsBooksInFlight) {
    Inputs in = at_thirty_degrees();
    in.inclination = 0.2;
    in.crank_speed = 40;
    State state{};
    auto const run = oracle::spatial_run(in, scotch_yoke, state, 0.004L, 1e-4L);  // falls, touches nothing
    EXPECT_EQ(run.changes, 0);
    double const angle = pi / 6 + 0.16, speed = 0.05 * 40 * std::sin(angle), was = 0.05 * 40 * 0.5;
    double const along =
        0.1872 * ((speed * speed - was * was) / 2 + 9.81 * std::sin(0.2) * 0.05 * (std::cos(angle) - std::cos(pi / 6)));
    EXPECT_NEAR(static_cast<double>(run.work), along, 1e-10);
    EXPECT_NEAR(static_cast<double>(run.residual()), 0, 1e-12);
}

TEST(SpatialOracle, RefusesThePlanarMechanism) {
    Parts const planar{.mechanism = Mechanism::planar_slider_crank};
    Inputs const in = oracle::completed({});
    EXPECT_THROW(oracle::evaluate(in, planar, 0, {}), std::invalid_argument);
    EXPECT_THROW(oracle::penetrations(in, planar, 0, {}), std::invalid_argument);
}

}  // namespace
}  // namespace scotch_yoke_test
