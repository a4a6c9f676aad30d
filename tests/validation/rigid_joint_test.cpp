// Rigid contacts of a free slider in closed form (model.md 13): flat bounces, their end, rest, corners, and the angle of friction.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "kernels/mechanisms/list.hpp"
#include "tests/support/rigid_joint.hpp"

namespace slideway::rigid_joint_test {
namespace {

using testing::energy_of;
using testing::joint_samples;
using testing::joint_state;
using testing::rigid_joint_parts;
using testing::rigid_options;

Inputs slider(double e, double friction = 0) {
    Inputs in;
    in.restitution = e;
    in.friction_static = in.friction_kinetic = friction;
    return complete_inputs(in);
}

/// A ball that falls by `fall` under the acceleration g and bounces.
struct Ball {
    long double g, fall, e;

    [[nodiscard]] long double first() const { return std::sqrt(2 * fall / g); }
    [[nodiscard]] long double end() const { return first() * (1 + 2 * e / (1 - e)); }
    /// Height above the floor, and speed upwards.
    [[nodiscard]] std::array<long double, 2> at(long double t) const {
        long double speed = std::sqrt(2 * g * fall), begun = -first();  // of a bounce whose top is at t = 0
        for (t -= begun; speed > 0 && t > 2 * speed / g; speed *= e) t -= 2 * speed / g;
        return {t * (speed - g * t / 2), speed - g * t};
    }
    [[nodiscard]] long double top(int bounce) const {
        return first() * (1 + 2 * e * (1 - std::pow(e, static_cast<long double>(bounce - 1))) / (1 - e) + std::pow(e, static_cast<long double>(bounce)));
    }
};

std::vector<std::vector<testing::JointState>> sampled(Parts const& parts, Inputs const& in, std::vector<double> const& times, double tolerance = 1e-12) {
    auto o = rigid_options(parts, tolerance, times.back());
    o.series = selections::twelve_states;
    o.sample_times = times;
    auto const r = testing::run(best_isa(), o, {in});
    EXPECT_EQ(r.records[0].status, Status::finished);
    return joint_samples(r, 1, times.size());
}

/// A bounce costs one attempt, what is looked up where it ends, and its start anew: a second attempt that ends there would be six more.
TEST(RigidJoint, BouncesCostOneAttemptEach) {
    auto const in = slider(0.95);
    Ball const ball{in.gravity, in.clearance_y, in.restitution};
    auto o = rigid_options(rigid_joint_parts(false), 1e-6, static_cast<double>(ball.top(60)));
    o.settings.max_step = 0.02;
    auto const r = testing::run(best_isa(), o, {in});
    ASSERT_EQ(r.records[0].status, Status::finished);
    EXPECT_LT(static_cast<double>(r.records[0].rhs_evaluations), 60 * 12);
}

/// With rigid contacts `auto` is `dopri5` at loose tolerances too.
TEST(RigidJoint, OfAutoAreThoseOfDormandPrince) {
    auto const in = slider(0.6, 0.1);
    auto o = rigid_options(rigid_joint_parts(true), 1e-3, 0.01);
    o.settings.method = Method::automatic;
    auto const of_auto = testing::run(best_isa(), o, {in});
    o.settings.method = Method::dopri5;
    auto const same = testing::run(best_isa(), o, {in});
    o.settings.method = Method::verner65;
    auto const other = testing::run(best_isa(), o, {in});
    EXPECT_EQ(of_auto.records[0].rhs_evaluations, same.records[0].rhs_evaluations);
    EXPECT_NE(of_auto.records[0].rhs_evaluations, other.records[0].rhs_evaluations);
}

/// The crank's slider lies on its way at a dead centre, away from the middle.
testing::EnsembleResult sliding(double crank_speed, double turned, Method method, double tolerance) {
    Inputs in = slider(0.5, 0.1);
    in.crank_speed = crank_speed;
    in.y = -in.clearance_y, in.z = 0.3 * in.clearance_z;
    auto o = rigid_options(rigid_joint_parts(true, false, Mechanism::slider_crank), tolerance, turned / crank_speed);
    o.settings.method = method;
    o.settings.max_step = 0.05;
    o.settings.stiff_max_step = 2 * std::numbers::pi / crank_speed / 50;
    auto r = testing::run(best_isa(), o, {in});
    EXPECT_EQ(r.records[0].status, Status::finished);
    return r;
}

/// Friction takes a sideways slip v back at the rate μ g/v, and more than a hundred thousand explicit steps would follow it for each radian.
TEST(RigidJoint, SlowSlidingHasThePaceOfTheDrive) {
    for (double const speed : {0.1, 0.01}) {
        auto const record = sliding(speed, 3, Method::automatic, 1e-6).records[0];
        EXPECT_LT(record.steps_accepted + record.steps_rejected, 1000u) << speed;
        EXPECT_GT(record.stiff_steps, 50u) << speed;
    }
    auto const slow = sliding(0.2, 3, Method::automatic, 1e-8).states[0], reference = sliding(0.2, 3, Method::dopri5, 1e-10).states[0];
    Inputs const in = slider(0.5);
    EXPECT_GT(std::abs(reference[1] - 0.3 * in.clearance_z), 1e-3 * in.clearance_z) << "it is moved to the side";
    EXPECT_NEAR(slow[1], reference[1], 1e-6 * in.clearance_z);
    EXPECT_NEAR(slow[5], reference[5], 1e-6 * in.clearance_z / in.slider_length);
}

TEST(RigidJoint, RestCostsAFreeSliderFewSteps) {
    Inputs in = slider(0.5, 0.3);
    in.inclination = 0.05, in.y = -in.clearance_y, in.vx = 0.01;
    auto o = rigid_options(rigid_joint_parts(true), 1e-6, 10);
    o.settings.max_step = 0.05;
    auto const r = testing::run(best_isa(), o, {in});
    ASSERT_EQ(r.records[0].status, Status::finished);
    EXPECT_NEAR(r.states[0][11], 0, 1e-6) << "friction holds it";
    EXPECT_LT(r.records[0].steps_accepted + r.records[0].steps_rejected, 5000u) << "500 a second";
}

TEST(RigidJoint, FlatBouncesHaveTheirHeightsAndTimes) {
    for (double const e : {0.3, 0.6, 0.9}) {
        auto const in = slider(e);
        Ball const ball{in.gravity, in.clearance_y, e};
        std::vector<double> tops;
        for (int i = 1; i <= 8; ++i) tops.push_back(static_cast<double>(ball.top(i)));
        auto const samples = sampled(rigid_joint_parts(false), in, tops);
        for (std::size_t i = 0; i < tops.size(); ++i) {
            auto const& s = samples[0][i];
            double const height = in.clearance_y * std::pow(e, 2.0 * static_cast<double>(i + 1));
            EXPECT_NEAR(static_cast<double>(s.y) + in.clearance_y, height, 1e-10 * in.clearance_y) << e << " " << i;
            // An impact is found to 1e-13 of the clearance: of the last of them, which are 5e-9 of it high, that is more of the time.
            double const located = 1e-13 * in.clearance_y / std::sqrt(2 * in.gravity * height);
            EXPECT_LT(std::abs(static_cast<double>(s.vy)) / in.gravity, std::max(1e-10 * tops[i], located)) << e << " " << i;
            for (long double const still : {s.z, s.vz, s.roll, s.yaw, s.pitch, s.wx, s.wy, s.wz, s.x, s.vx}) EXPECT_LT(std::abs(static_cast<double>(still)), 1e-14);
        }
    }
}

TEST(RigidJoint, ImpactsAHairBeforeTheEndAreThere) {
    double const e = 0.6;
    auto const in = slider(e);
    double const first = static_cast<double>(Ball{in.gravity, in.clearance_y, e}.first());
    for (double hair = 1e-4; hair > 1e-15; hair /= 3) {
        auto o = rigid_options(rigid_joint_parts(false), 1e-9, first * (1 + hair));
        o.settings.max_steps = 1000;
        auto const r = testing::run(best_isa(), o, {in});
        ASSERT_EQ(r.records[0].status, Status::finished) << hair;
        if (hair > 1e-12) {
            EXPECT_NEAR(r.states[0][2], e * in.gravity * first, 1e-9 + 2 * hair) << hair;
        }
    }
}

TEST(RigidJoint, FlatBouncesEndWithTheirGeometricSum) {
    for (Mechanism const mechanism : {Mechanism::free_slider, Mechanism::carriage, Mechanism::scotch_yoke}) {
        for (double const e : {0.3, 0.6, 0.9}) {
            auto const in = slider(e);
            double const sum = static_cast<double>(Ball{in.gravity, in.clearance_y, e}.end()), end = sum + 0.5;
            auto o = rigid_options(rigid_joint_parts(false, false, mechanism), 1e-12, end);
            o.settings.max_step = 1e-2;
            auto const r = testing::run(best_isa(), o, {in});
            ASSERT_EQ(r.records[0].status, Status::finished) << static_cast<int>(mechanism) << " " << e;
            EXPECT_NEAR(r.value(0, Quantity::mode_time, 0), sum, 1e-9) << e;
            EXPECT_NEAR(r.value(0, Quantity::mode_time, 3), end - sum, 1e-9) << e;
            EXPECT_NEAR(r.value(0, Quantity::damping_loss), in.slider_mass * in.gravity * in.clearance_y, 1e-15) << e;
            // From rest to rest: impulses of impacts and forces of what lasts are those of the weight.
            EXPECT_NEAR(r.value(0, Quantity::mean_normal_force), in.slider_mass * in.gravity, 1e-9) << e;
            // Rest is rest, and costs nothing.
            EXPECT_NEAR(r.states[0][0], -in.clearance_y, 1e-17);
            for (std::size_t i = 1; i < 10; ++i) EXPECT_LT(std::abs(r.states[0][i]), 1e-12) << i;
            EXPECT_LT(r.records[0].steps_accepted, 600u) << e;
        }
    }
}

TEST(RigidJoint, FlatBouncesOfAMisalignedWayAreThoseAcrossIt) {
    double const e = 0.6;
    auto in = slider(e);
    in.way_pitch = 0.02, in.way_roll = 0.3, in.way_yaw = -0.01, in.way_offset_y = 3e-5, in.way_offset_z = -2e-5;
    // The slider sits in the middle of its way, aligned with it.
    in.pitch = in.way_pitch, in.roll = in.way_roll, in.yaw = in.way_yaw, in.y = in.way_offset_y, in.z = in.way_offset_z;
    long double const a = in.way_roll, b = in.way_yaw, c = in.way_pitch;
    // Weight along the way's axes: rows of (Rz Ry Rx)ᵀ times (0, −g, 0).
    long double const up = std::cos(c) * std::cos(a) + std::sin(c) * std::sin(b) * std::sin(a);
    long double const side = -std::cos(c) * std::sin(a) + std::sin(c) * std::sin(b) * std::cos(a);
    long double const along = std::sin(c) * std::cos(b);
    ASSERT_LT(side, 0);
    long double const g = in.gravity;
    Ball const y{g * up, in.clearance_y, e}, z{-g * side, in.clearance_z, e};
    std::vector<double> times;
    for (int i = 1; i <= 40; ++i) times.push_back(0.4e-3 * i);
    ASSERT_LT(times.back(), static_cast<double>(y.end()));
    auto const samples = sampled(rigid_joint_parts(false, true), in, times);
    for (std::size_t i = 0; i < times.size(); ++i) {
        auto const& s = samples[0][i];
        long double const dx = s.x, dy = s.y - in.way_offset_y, dz = s.z - in.way_offset_z;
        // Columns of Rz Ry Rx are the way's axes.
        long double const of_x = std::cos(c) * std::cos(b) * dx + std::sin(c) * std::cos(b) * dy - std::sin(b) * dz;
        long double const of_y = (std::cos(c) * std::sin(b) * std::sin(a) - std::sin(c) * std::cos(a)) * dx + up * dy + std::cos(b) * std::sin(a) * dz;
        long double const of_z = (std::cos(c) * std::sin(b) * std::cos(a) + std::sin(c) * std::sin(a)) * dx + side * dy + std::cos(b) * std::cos(a) * dz;
        long double const t = times[i], tolerance = 1e-10L * in.clearance_y;
        EXPECT_NEAR(static_cast<double>(of_y + in.clearance_y - y.at(t)[0]), 0, static_cast<double>(tolerance)) << i;
        EXPECT_NEAR(static_cast<double>(in.clearance_z - of_z - z.at(t)[0]), 0, static_cast<double>(tolerance)) << i;
        EXPECT_NEAR(static_cast<double>(of_x + g * along * t * t / 2), 0, static_cast<double>(tolerance)) << i;
        EXPECT_NEAR(static_cast<double>(s.roll), in.way_roll, 1e-12) << i;
    }
}

/// A slider in a way that is rolled by 0.4: it lies on a Y and a Z face at once.
Inputs in_a_corner(double slope, double friction) {
    auto in = slider(0.5, friction);
    in.inclination = slope;
    in.way_roll = in.roll = 0.4;
    // On both faces: −c along the way's Y, +c along its Z, onto which the weight pushes it.
    double const s = std::sin(0.4), c = std::cos(0.4);
    in.y = -in.clearance_y * c - in.clearance_z * s;
    in.z = -in.clearance_y * s + in.clearance_z * c;
    return in;
}

TEST(RigidJoint, CornerHoldsWhatLiesInIt) {
    auto in = in_a_corner(0, 0);
    auto const y = in.y, z = in.z;
    auto o = rigid_options(rigid_joint_parts(false, true), 1e-10, 0.5);
    o.settings.max_step = 1e-2;
    o.series = selections::of({Series::normal_force});
    o.sample_times = {0.25};
    auto const r = testing::run(best_isa(), o, {in});
    ASSERT_EQ(r.records[0].status, Status::finished);
    EXPECT_NEAR(r.states[0][0], y, 1e-15);
    EXPECT_NEAR(r.states[0][1], z, 1e-15);
    for (std::size_t i = 2; i < 12; ++i) EXPECT_NEAR(r.states[0][i], i == 4 ? 0.4 : 0, 1e-9) << i;
    EXPECT_NEAR(r.series[0], in.slider_mass * in.gravity * (std::sin(0.4) + std::cos(0.4)), 1e-9);
}

TEST(RigidJoint, FallsIntoACornerAndStays) {
    auto in = in_a_corner(0, 0);
    in.y = in.z = 0;
    auto const at_rest = in_a_corner(0, 0);
    auto o = rigid_options(rigid_joint_parts(false, true), 1e-10, 0.3);
    o.settings.max_step = 1e-2;
    auto const r = testing::run(best_isa(), o, {in});
    ASSERT_EQ(r.records[0].status, Status::finished);
    EXPECT_NEAR(r.states[0][0], at_rest.y, 1e-15);
    EXPECT_NEAR(r.states[0][1], at_rest.z, 1e-15);
    for (std::size_t i = 2; i < 12; ++i) EXPECT_NEAR(r.states[0][i], i == 4 ? 0.4 : 0, 1e-9) << i;
}

/// A free slider on a slope with the friction μ: either stays, or slides by a t²/2.  @param pressed the sum of the normal forces over M g
/// @param margin of the friction above and below what holds
void expect_slope(Inputs in, bool misaligned, double pressed, double margin) {
    double const slope = in.inclination, needed = std::sin(slope) / pressed;
    for (bool const holds : {true, false}) {
        in.friction_static = in.friction_kinetic = needed * (holds ? 1 + margin : 1 - margin);
        auto const r = testing::run(best_isa(), rigid_options(rigid_joint_parts(true, misaligned), 1e-10, 0.5), {in});
        ASSERT_EQ(r.records[0].status, Status::finished) << slope << holds;
        double const moved = -r.states[0][10];
        double const expected = in.gravity * (std::sin(slope) - in.friction_kinetic * pressed) * 0.5 * 0.5 / 2;
        if (holds) EXPECT_LT(std::abs(moved), 1e-3 * std::abs(expected)) << slope;
        else EXPECT_NEAR(moved, expected, 1e-3 * expected) << slope;
        in.friction_static = in.friction_kinetic = needed * 0.7;
        auto const fast = testing::run(best_isa(), rigid_options(rigid_joint_parts(true, misaligned), 1e-12, 0.5), {in});
        ASSERT_EQ(fast.records[0].status, Status::finished) << slope;
        double const acceleration = in.gravity * (std::sin(slope) - in.friction_kinetic * pressed);
        EXPECT_NEAR(-fast.states[0][11], acceleration * 0.5, 1e-11) << slope;
        EXPECT_NEAR(-fast.states[0][10], acceleration * 0.125, 1e-11) << slope;
    }
}

TEST(RigidJoint, SlopeHoldsBelowItsAngleOfFrictionAndNotAbove) {
    for (double const slope : {0.05, 0.2, 0.6}) {
        auto in = slider(0.5);
        in.inclination = slope;
        in.y = -in.clearance_y;
        expect_slope(in, false, std::cos(slope), 1e-6);
    }
}

TEST(RigidJoint, GrooveHoldsBelowItsAngleOfFrictionAndNotAbove) {
    for (double const slope : {0.05, 0.4}) {
        expect_slope(in_a_corner(slope, 0), true, std::cos(slope) * (std::sin(0.4) + std::cos(0.4)), 1e-3);
    }
}

/// Slips are seen against the fall by the slider's own length, whatever a crank's would be: a fifth of a millisecond of static friction where it is
/// exceeded by a thousandth.
TEST(RigidJoint, SlipsAtOnceWhereStaticFrictionGivesWay) {
    for (double const clearance : {1e-6, 1e-4, 1e-3}) {
        auto in = slider(0.5);
        in.friction_static = 0.3, in.friction_kinetic = 0.2;
        in.inclination = std::atan(0.3 * (1 + 1e-3));
        in.clearance_y = in.clearance_z = clearance;
        in.y = -clearance;
        double const end = 0.1, pull = in.gravity * (std::sin(in.inclination) - in.friction_kinetic * std::cos(in.inclination));
        auto const r = testing::run(best_isa(), rigid_options(rigid_joint_parts(true), 1e-6, end), {in});
        ASSERT_EQ(r.records[0].status, Status::finished) << clearance;
        EXPECT_NEAR(r.states[0][11], -pull * end, 1e-2 * pull * end) << clearance;
        EXPECT_NEAR(r.states[0][10], -pull * end * end / 2, 1e-2 * pull * end * end / 2) << clearance;
    }
    auto slow = slider(0.5, 1e-3);
    slow.clearance_y = slow.clearance_z = 1e-7;
    slow.y = -1e-7, slow.vx = 1e-4;
    auto const r = testing::run(best_isa(), rigid_options(rigid_joint_parts(true), 1e-9, 0.02), {slow});
    EXPECT_NEAR(r.states[0][10], slow.vx * slow.vx / (2e-3 * slow.gravity), 1e-10);
}

TEST(RigidJoint, SlidesInAStraightLineUntilItStops) {
    auto in = slider(0.5, 0.2);
    in.clearance_z = 0.02;
    in.y = -in.clearance_y;
    in.vx = 0.12, in.vz = -0.05;
    double const speed = 0.13, g = in.gravity, stop = speed / (0.2 * g);
    std::vector<double> const times{0.25 * stop, 0.5 * stop, 0.9 * stop, 1.5 * stop};
    auto const samples = sampled(rigid_joint_parts(true), in, times);
    for (std::size_t i = 0; i < times.size(); ++i) {
        double const t = std::min(times[i], stop), way = speed * t - 0.1 * g * t * t;
        EXPECT_NEAR(static_cast<double>(samples[0][i].x), way * 12 / 13, 1e-11) << i;
        EXPECT_NEAR(static_cast<double>(samples[0][i].z), -way * 5 / 13, 1e-11) << i;
        EXPECT_NEAR(static_cast<double>(samples[0][i].y), -in.clearance_y, 1e-18) << i;
    }
    for (long double const rest : {samples[0][3].vx, samples[0][3].vz, samples[0][3].wy}) EXPECT_LT(std::abs(static_cast<double>(rest)), 1e-11);
}

TEST(RigidJoint, EndsWithAStatusAndMakesNoEnergyWhateverTheGeometry) {
    for (auto const mechanism : {Mechanism::free_slider, Mechanism::carriage, Mechanism::scotch_yoke, Mechanism::slider_crank}) {
        for (double const friction : {0.0, 0.5}) {
            auto const members = testing::random_rigid_sliders(64, 5, friction);
            auto o = rigid_options(rigid_joint_parts(friction > 0, false, mechanism), 1e-6, 0.03);
            o.settings.max_steps = 100'000;
            auto const r = testing::run(best_isa(), o, members);
            int finished = 0;
            for (std::size_t i = 0; i < members.size(); ++i) {
                Status const status = r.records[i].status;
                finished += status == Status::finished;
                EXPECT_TRUE(status == Status::finished || status == Status::contact_domain || status == Status::max_steps)
                    << info(mechanism).name << i << static_cast<int>(status);
                if (status != Status::finished) continue;
                double const lost = r.value(i, Quantity::friction_loss) + r.value(i, Quantity::damping_loss);
                double const scale = std::abs(r.value(i, Quantity::drive_work)) + std::abs(r.value(i, Quantity::energy_change));
                EXPECT_GT(lost, -1e-6 * scale) << info(mechanism).name << i;
                EXPECT_LT(std::abs(r.value(i, Quantity::energy_residual)), 1e-5 * scale) << info(mechanism).name << i;
            }
            EXPECT_GE(finished, 60) << info(mechanism).name << friction;
        }
    }
}

}  // namespace
}  // namespace slideway::rigid_joint_test
