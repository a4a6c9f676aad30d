// The oracle's sliders without a rod, driven and free: prescribed motion, statics, free fall, and what sensors feel.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "kernels/laws/list.hpp"
#include "kernels/mechanisms/list.hpp"
#include "tests/oracle/names.hpp"
#include "tests/oracle/oracle.hpp"
#include "tests/oracle/random_states.hpp"
#include "tests/unit/oracle/oracle_fixture.hpp"

namespace sliders_test {
namespace {

using oracle::Case;
using oracle::Result;
using oracle::State;
using oracle::testing::evaluate;
using oracle::testing::joined;
using oracle::testing::seed;
using oracle::testing::sum;
using slideway::Inputs;
using slideway::Mechanism;
using slideway::Parts;

constexpr Parts carriage{.mechanism = Mechanism::carriage}, free_slider{.mechanism = Mechanism::free_slider};
constexpr double pi = std::numbers::pi;

TEST(CarriageMotion, HasTheClosedFormsOfItsTurningPoints) {
    Inputs const in;  // 2.5 s at 60 mm/s, 20 ms of reversal
    double const period = 2 * (0.15 / 0.06 + 0.02), beyond = 0.06 * 0.02 / pi, brake = 0.06 * pi / 0.02;
    for (int turn = 0; turn < 40; ++turn) {
        double const start = turn * period;
        auto const expect = [&](double since, double x, double vx, double ax) {
            auto const got = oracle::carriage_motion(in, start + since);
            EXPECT_NEAR(static_cast<double>(got.x), x, 1e-14) << "period " << turn << ", " << since << " s";
            EXPECT_NEAR(static_cast<double>(got.vx), vx, 1e-11);
            EXPECT_NEAR(static_cast<double>(got.ax), ax, 1e-9);
        };
        expect(1.25, 0.075, 0.06, 0);
        expect(2.51, 0.15 + beyond, 0, -brake);
        expect(2.52 + 1.25, 0.075, -0.06, 0);
        expect(2.52 + 2.51, -beyond, 0, brake);
    }
}

TEST(CarriageMotion, IsContinuousInPlaceSpeedAndAcceleration) {
    Inputs in;
    in.stroke = 0.03, in.carriage_speed = 0.093, in.reversal_time = 0.07;
    long double const straight = 0.03L / 0.093, half = straight + 0.07;
    double const least = 1e-9;
    double const jerk = 0.093 * pi * pi / (0.07 * 0.07);  // the largest
    for (int k = 0; k < 400; ++k) {
        for (long double const join : {k * half + straight, (k + 1) * half}) {
            auto const before = oracle::carriage_motion(in, join - least),
                       after = oracle::carriage_motion(in, join + least);
            EXPECT_NEAR(static_cast<double>(after.x - before.x), 2 * least * static_cast<double>(before.vx), 1e-15);
            EXPECT_NEAR(static_cast<double>(after.vx - before.vx), 0, jerk * least * least + 1e-15);
            EXPECT_NEAR(static_cast<double>(after.ax - before.ax), 0, 2 * jerk * least);
        }
    }
    for (long double t = 0.01L; t < 5 * half; t += 0.0137) {
        long double const step = 1e-6L;
        auto const here = oracle::carriage_motion(in, t);
        auto const before = oracle::carriage_motion(in, t - step), after = oracle::carriage_motion(in, t + step);
        EXPECT_NEAR(static_cast<double>((after.x - before.x) / (2 * step)), static_cast<double>(here.vx), 1e-10);
        EXPECT_NEAR(static_cast<double>((after.vx - before.vx) / (2 * step)), static_cast<double>(here.ax),
                    2 * jerk * 1e-6);
    }
}

struct Driven {
    Mechanism mechanism;
    oracle::AlongTheWay (*motion)(Inputs const&, long double);
};

class DrivenSlider : public ::testing::TestWithParam<Driven> {};

TEST_P(DrivenSlider, MovesAcrossTheWayLikeAFreeSliderWithItsPlaceAndSpeed) {
    int touching = 0;
    auto cases = oracle::make_cases(seed, 600, GetParam().mechanism);
    for (Case const& c : oracle::make_cases(seed + 1, 300, GetParam().mechanism, slideway::Law::kelvin_voigt))
        cases.push_back(c);
    for (Case const& c : cases) {
        auto const motion = GetParam().motion(c.inputs, c.t);
        Case loose = c;
        loose.parts.mechanism = Mechanism::free_slider;
        loose.state[10] = static_cast<double>(motion.x), loose.state[11] = static_cast<double>(motion.vx);
        Result const driven = evaluate(c), other = evaluate(loose);
        double const load = sum(joined(driven.fn_y, driven.fn_z));
        touching += load > 0;
        // The rounding of x and vx to double moves the slider in a way that is not along X.
        double const slack = 1e-7 * (load + 1);
        for (std::size_t i = 0; i < 10; ++i) {
            double const by = i < 4 ? c.inputs.slider_mass : c.inputs.slider_inertia_x / 0.05;
            EXPECT_NEAR(driven.derivative[i], other.derivative[i], slack / std::min(by, 1e-1)) << i;
        }
        double const drive = c.inputs.slider_mass * (static_cast<double>(motion.ax) - other.derivative[11]);
        EXPECT_NEAR(driven.power_crank, drive * other.vx, slack * std::abs(other.vx));
        EXPECT_EQ(driven.acceleration[0], static_cast<double>(motion.ax));
        EXPECT_GE(driven.power_friction, 0);
        EXPECT_EQ(driven.ideal_x, driven.x);
    }
    EXPECT_GT(touching, 400);
}

INSTANTIATE_TEST_SUITE_P(Oracle, DrivenSlider,
                         ::testing::Values(Driven{Mechanism::carriage, oracle::carriage_motion},
                                           Driven{Mechanism::scotch_yoke, oracle::scotch_yoke_motion}),
                         [](auto const& p) { return oracle::name_of(p.param.mechanism); });

TEST(OracleCarriage, IsDrivenAgainstFrictionAndSlope) {
    Inputs in = oracle::completed({});
    in.inclination = pi / 6;
    Parts parts = carriage;
    parts.friction = true;
    State lying{};
    double const depth = 2e-9;
    lying[0] = -in.clearance_y - depth;
    Result const r = oracle::evaluate(in, parts, 1, lying);
    EXPECT_EQ(r.surfaces, 1);
    // k = E A/l of equal materials, and kinetic friction at 60 mm/s: the hole hangs on the top of the way,
    // so it acts above the centre.
    double const load = 2.07e11 * 0.04 * 0.03 / 0.02 * depth, weight = in.slider_mass * 9.81;
    EXPECT_NEAR(sum(joined(r.fn_y, r.fn_z)), load, 1e-9 * load);
    EXPECT_NEAR(r.power_crank, (0.1 * load + weight / 2) * 0.06, 1e-9 * load * 0.06);
    EXPECT_NEAR(r.power_friction, 0.1 * load * 0.06, 1e-9 * load * 0.06);
    EXPECT_NEAR(r.derivative[3], 0, 1e-15);
    EXPECT_NEAR(r.derivative[2], load / in.slider_mass - 9.81 * std::sqrt(3) / 2, 1e-9 * load / in.slider_mass);
    EXPECT_NEAR(r.derivative[9], 0.1 * load * 0.0101 / in.slider_inertia_z, 1e-4 * load);
}

TEST(OracleCarriage, LiesStillUnderTheLoadOfStatics) {
    Inputs in = oracle::completed({});
    in.inclination = pi / 6;
    Parts parts = carriage;
    parts.law = slideway::Law::conservative;
    // k H + 4 K δ^n + two lines of each kind: the depth by bisection, the forces by their sum.
    double shallow = 0, deep = 1e-7;
    for (int i = 0; i < 100; ++i) {
        double const depth = (shallow + deep) / 2;
        State lying{};
        lying[0] = -in.clearance_y - depth;
        (oracle::evaluate(in, parts, 1, lying).derivative[2] < 0 ? shallow : deep) = depth;
    }
    State lying{};
    lying[0] = -in.clearance_y - deep;
    Result const r = oracle::evaluate(in, parts, 1, lying);
    double const weight = in.slider_mass * 9.81 * std::sqrt(3) / 2;
    EXPECT_NEAR(sum(joined(r.fn_y, r.fn_z)), weight, 1e-6 * weight);
    EXPECT_NEAR(r.acceleration_top, 0, 1e-5);
    EXPECT_NEAR(r.acceleration_front, 0, 1e-12);
    EXPECT_EQ(r.derivative[7], 0);
    EXPECT_NEAR(deep, weight / (2.07e11 * 0.04 * 0.03 / 0.02), 0.15 * deep);  // the softer modes bear a tenth
}

TEST(OracleCarriage, StartsWhereItsTiltedWayIs) {
    Inputs in = oracle::completed({});
    in.way_pitch = 0.02, in.way_offset_y = 3e-4;
    Parts parts = carriage;
    parts.misaligned_way = true;
    State state{};
    state[0] = in.way_offset_y, state[6] = in.way_pitch;
    for (double const depth : oracle::penetrations(in, parts, 0, state)) EXPECT_NEAR(depth, -1e-4, 1e-16);
    // 75 mm on, the way is higher.
    state[0] += 0.075 * std::tan(0.02);
    for (double const depth : oracle::penetrations(in, parts, 1.25, state)) EXPECT_NEAR(depth, -1e-4, 1e-16);
}

TEST(FreeSlider, FallsAlongTheSlope) {
    Inputs in = oracle::completed({});
    in.inclination = 0.3;
    State state{};
    state[10] = 0.2, state[11] = -0.7, state[3] = 0.01;
    Result const r = oracle::evaluate(in, free_slider, 0, state);
    EXPECT_EQ(r.derivative[10], -0.7);
    EXPECT_NEAR(r.derivative[11], -9.81 * std::sin(0.3), 1e-15);
    EXPECT_NEAR(r.derivative[2], -9.81 * std::cos(0.3), 1e-15);
    EXPECT_EQ(r.derivative[3], 0);
    double const height = 0.2 * std::sin(0.3), square = 0.49 + 1e-4;
    EXPECT_NEAR(r.energy, in.slider_mass * (square / 2 + 9.81 * height), 1e-15);
    EXPECT_EQ(r.power_crank, 0);
}

TEST(Sensors, FeelTheCentreTheSpinAndNoWeight) {
    Inputs in = oracle::completed({});
    in.clearance_y = in.clearance_z = 0.05;  // nothing touches at any tilt
    State state{};
    double const roll = 0.5, wx = 3, wy = -4, wz = 5;
    state[4] = roll, state[7] = wx, state[8] = wy, state[9] = wz;
    Result const r = oracle::evaluate(in, free_slider, 0, state);
    // Falling, along the turned axes, and drawn to the centre by the spin across each sensor's arm.
    EXPECT_NEAR(r.acceleration_top, -9.81 * std::cos(roll) - 0.02 * (wx * wx + wz * wz), 1e-14);
    EXPECT_NEAR(r.acceleration_front, 9.81 * std::sin(roll) - 0.025 * (wx * wx + wy * wy), 1e-14);
    in.gravity = 0;
    state[7] = state[8] = state[9] = 0;
    EXPECT_EQ(oracle::evaluate(in, free_slider, 0, state).acceleration_top, 0);
}

}  // namespace
}  // namespace sliders_test
