// The oracle held against conservation laws: potential, power balance, and a turn of everything.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <tuple>
#include <utility>

#include "kernels/laws/list.hpp"
#include "kernels/mechanisms/list.hpp"
#include "tests/oracle/names.hpp"
#include "tests/oracle/oracle.hpp"
#include "tests/oracle/pairs.hpp"
#include "tests/oracle/random_states.hpp"
#include "tests/unit/oracle/oracle_fixture.hpp"

namespace conservation_test {
namespace {

using oracle::Case;
using oracle::Pairs;
using oracle::Result;
using oracle::testing::evaluate;
using oracle::testing::joined;
using oracle::testing::margin;
using oracle::testing::seed;
using oracle::testing::slope;
using oracle::testing::sum;
using slideway::Damping;
using slideway::Law;
using slideway::Mechanism;

/// The generalised normal force along each of y z φ ϑ ψ: push and torque by the motion that the coordinate makes.
std::array<double, 5> generalised_force(Case const& c, Result const& r) {
    using Eigen::AngleAxisd;
    using Eigen::Vector3d;
    double const angle = c.inputs.start_angle + c.inputs.crank_speed * c.t;
    double const above = c.state[0] - c.inputs.crank_length * std::sin(angle);
    double const along = r.x - c.inputs.crank_length * std::cos(angle);
    Vector3d const force(r.normal_force.data()), torque(r.normal_torque.data());
    AngleAxisd const pitch(c.state[6], Vector3d::UnitZ()), yaw(c.state[5], Vector3d::UnitY());
    Vector3d const roll_axis = pitch * (yaw * Vector3d::UnitX());
    Vector3d const yaw_axis = pitch * Vector3d::UnitY();
    return {force.y() - force.x() * above / along, force.z() - force.x() * c.state[1] / along, torque.dot(roll_axis),
            torque.dot(yaw_axis), torque.z()};
}

/// No term of a law that dissipates.
void take_damping_out(Case& c) {
    c.parts.damping = Damping::point;
    switch (c.parts.law) {
        case Law::paper:
        case Law::conservative:
        case Law::foundation:
            c.inputs.eta = 0;
            return;
        case Law::kelvin_voigt:
            c.inputs.law_b = 0;
            return;
    }
}

class OracleLaw : public ::testing::TestWithParam<Law> {};

TEST_P(OracleLaw, PushesByTheGradientOfItsPotential) {
    int held = 0;
    for (Case c : oracle::make_cases(seed, 1000, Mechanism::slider_crank, GetParam())) {
        c.parts.friction = false;
        take_damping_out(c);
        Result const r = evaluate(c);
        double const load = sum(joined(r.fn_y, r.fn_z));
        if (load == 0 || margin(r) < 1e-9) continue;
        ++held;
        auto const force = generalised_force(c, r);
        double const arm = c.inputs.slider_length / 2;
        constexpr int coordinates[5] = {0, 1, 4, 5, 6};
        for (int j = 0; j < 5; ++j) {
            double const lever = j < 2 ? 1 : arm;
            auto const potential = [&](double step) {
                Case moved = c;
                moved.state[coordinates[j]] += step;
                return evaluate(moved).contact_potential;
            };
            double const gradient = slope(potential, std::min(2e-3 * margin(r), 1e-7) / lever);
            EXPECT_NEAR(force[j], -gradient, 1e-6 * load * lever) << "coordinate " << j;
        }
    }
    EXPECT_GT(held, 500);
}

INSTANTIATE_TEST_SUITE_P(Laws, OracleLaw, ::testing::ValuesIn(oracle::every_law()),
                         [](auto const& p) { return oracle::name_of(p.param); });

/// A power of two that moves no pair by more than a thousandth of its distance to the face.
double small_step(Case const& c, Result const& r) {
    double fastest = 1e-9, fiercest = 1, turning = 1 + std::abs(c.inputs.crank_speed);
    for (double rate : joined(r.rate_y, r.rate_z)) fastest = std::max(fastest, std::abs(rate));
    for (int i : {2, 3}) fiercest = std::max(fiercest, std::abs(r.derivative[i]));
    for (int i : {7, 8, 9}) fiercest = std::max(fiercest, std::abs(r.derivative[i]) * c.inputs.slider_length);
    for (int i : {7, 8, 9}) turning = std::max(turning, std::abs(c.state[i]));
    if (c.parts.mechanism == Mechanism::carriage) turning += 4 / c.inputs.reversal_time;
    double const gap = 1e-3 * margin(r);
    return std::exp2(std::floor(std::log2(std::min({1e-4 / turning, gap / fastest, std::sqrt(gap / fiercest)}))));
}

class OracleMechanism : public ::testing::TestWithParam<std::tuple<Mechanism, Law>> {};

TEST_P(OracleMechanism, ChangesItsEnergyByThePowersAlone) {
    auto const [mechanism, law] = GetParam();
    int held = 0;
    for (Case c : oracle::make_cases(seed + 2, 700, mechanism, law)) {
        c.t = std::ldexp(std::round(std::ldexp(c.t, 40)), -40);  // exact in sums with the steps
        Result const r = evaluate(c);
        if (margin(r) < 1e-9) continue;
        double const step = small_step(c, r);
        auto const energy = [&](double dt) {
            Case moved = c;
            moved.t += dt;
            for (std::size_t i = 0; i < moved.state.size(); ++i) moved.state[i] += dt * r.derivative[i];
            return evaluate(moved).energy;
        };
        Pairs const rates = joined(r.rate_y, r.rate_z), forces = joined(r.fn_y, r.fn_z);
        double scale = std::abs(r.power_crank) + r.power_friction + std::abs(r.power_damping);
        for (int i = 0; i < 16; ++i) scale += forces[i] * std::abs(rates[i]);
        // Of the energy, and of the moved angles: half a digit of 0.03 rad by an arm of 0.02 m against the load.
        double const rounding = (1e-15 * (std::abs(r.energy) + 0.1) + 1e-19 * sum(forces)) / step;
        if (rounding > 1e-6 * scale) continue;
        ++held;
        EXPECT_NEAR(slope(energy, step), r.power_crank - r.power_friction - r.power_damping, 3e-6 * scale);
        EXPECT_GE(r.power_friction, 0);
        if (mechanism == Mechanism::free_slider) {
            EXPECT_EQ(r.power_crank, 0);
        }
    }
    EXPECT_GT(held, 280);
}

INSTANTIATE_TEST_SUITE_P(Spatial, OracleMechanism,
                         ::testing::Combine(::testing::ValuesIn(oracle::spatial_mechanisms()),
                                            ::testing::ValuesIn(oracle::every_law())),
                         [](auto const& p) {
                             return oracle::name_of(std::get<0>(p.param)) + "_" + oracle::name_of(std::get<1>(p.param));
                         });

TEST(Oracle, WayAndSliderTurnedTogetherPressAlike) {
    // With the crank at rest along X and no weight, a turn of everything about X changes nothing but directions.
    double const turn = 0.3;
    int touching = 0;
    for (Case c : oracle::make_cases(seed + 3, 400)) {
        c.inputs.gravity = c.inputs.start_angle = c.inputs.crank_speed = 0;
        c.inputs.way_yaw = c.inputs.way_pitch = c.inputs.way_roll = c.inputs.way_offset_y = c.inputs.way_offset_z = 0;
        c.parts.misaligned_way = false;
        Case turned = c;
        turned.parts.misaligned_way = true;
        turned.inputs.way_roll = turn;
        auto const rotate = [&](double& y, double& z) {
            std::tie(y, z) =
                std::pair{y * std::cos(turn) - z * std::sin(turn), y * std::sin(turn) + z * std::cos(turn)};
        };
        rotate(turned.state[0], turned.state[1]);
        rotate(turned.state[2], turned.state[3]);
        using Eigen::AngleAxisd;
        using Eigen::Vector3d;
        Eigen::Matrix3d const attitude =
            (AngleAxisd(turn, Vector3d::UnitX()) * AngleAxisd(c.state[6], Vector3d::UnitZ()) *
             AngleAxisd(c.state[5], Vector3d::UnitY()) * AngleAxisd(c.state[4], Vector3d::UnitX()))
                .toRotationMatrix();
        turned.state[4] = std::atan2(attitude(2, 1), attitude(2, 2));
        turned.state[5] = std::asin(-attitude(2, 0));
        turned.state[6] = std::atan2(attitude(1, 0), attitude(0, 0));

        Result straight = evaluate(c);
        Result const other = evaluate(turned);
        if (margin(straight) < 1e-8) continue;  // the turned state is rounded anew
        touching += straight.surfaces + straight.lines + straight.points > 0;
        EXPECT_EQ(straight.faces, other.faces);
        double const load = sum(joined(straight.fn_y, straight.fn_z));
        for (int i = 0; i < 8; ++i) {
            EXPECT_NEAR(straight.fn_y[i], other.fn_y[i], 1e-7 * load);
            EXPECT_NEAR(straight.fn_z[i], other.fn_z[i], 1e-7 * load);
        }
        rotate(straight.derivative[2], straight.derivative[3]);
        for (int i : {2, 3})
            EXPECT_NEAR(straight.derivative[i], other.derivative[i], 1e-6 * (1 + load / c.inputs.slider_mass));
        for (int i : {7, 8, 9})
            EXPECT_NEAR(straight.derivative[i], other.derivative[i],
                        1e-6 * (1 + load * 0.03 / c.inputs.slider_inertia_x));
    }
    EXPECT_GT(touching, 50);
}

}  // namespace
}  // namespace conservation_test
