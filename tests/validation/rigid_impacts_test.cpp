// Rigid contacts of the planar slider-crank in closed form (model.md 13): bounces, their end, rest, energy, the angle of friction, and what has no solution.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "tests/oracle/planar_runs.hpp"
#include "tests/support/rigid.hpp"

namespace slideway::rigid_impacts_test {
namespace {

using testing::rigid_options;
using testing::rigid_planar_parts;

/// A crank at rest along X: rod and block are a pendulum of angle θ2, y = L sin θ2, between the walls.
Inputs pendulum(double e) {
    Inputs in;
    in.crank_speed = 0;
    in.clearance_y = 1e-4;
    in.restitution = e;
    return complete_inputs(in);
}

/// The pendulum in 80-bit numbers: ½ J θ2'² = G g (y_max − y)/L.
struct Pendulum {
    long double length, rate;  // θ2'² = rate (y_max − y)

    explicit Pendulum(Inputs const& in) : length(in.rod_length) {
        long double const m2 = in.rod_mass, m3 = in.slider_mass;
        long double const inertia = in.rod_inertia + (m2 / 4 + m3) * length * length, moment = (m2 / 2 + m3) * length;
        rate = 2 * moment * static_cast<long double>(in.gravity) / (inertia * length);
    }

    /// Time from the wall to the top of a bounce: ∫dy/(L cos θ2 θ2'), with u = √(y_max − y) a smooth integral.
    [[nodiscard]] long double rise(long double wall, long double height) const {
        constexpr long double nodes[] = {0.1834346424956498049395L, 0.5255324099163289858177L, 0.7966664774136267395916L, 0.9602898564975362316836L};
        constexpr long double weights[] = {0.3626837833783619829652L, 0.3137066458778872873380L, 0.2223810344533744705444L, 0.1012285362903762591525L};
        long double const end = std::sqrt(height);
        long double sum = 0;
        for (int i = 0; i < 8; ++i) {
            long double const u = end * (1 + (i % 2 == 0 ? nodes[i / 2] : -nodes[i / 2])) / 2;
            long double const sine = (wall + height - u * u) / length;
            sum += weights[i / 2] / std::sqrt(1 - sine * sine);
        }
        return sum * end / (length * std::sqrt(rate));
    }
};

TEST(RigidImpacts, BouncesHaveTheirHeightsAndTimes) {
    double const e = 0.6;
    auto const in = pendulum(e);
    Pendulum const exact(in);
    long double const c = in.clearance_y;
    long double fall = exact.rise(-c, c), time = fall, height = c;
    std::vector<double> tops;
    std::vector<long double> heights;
    for (int i = 0; i < 8; ++i) {
        height *= static_cast<long double>(e) * e;
        long double const rise = exact.rise(-c, height);
        tops.push_back(static_cast<double>(time + rise));
        heights.push_back(height);
        time += 2 * rise;
    }
    auto o = rigid_options(rigid_planar_parts(false, false), 1e-12, tops.back() + 1e-5);
    o.series = selections::of({Series::y, Series::vy});
    o.sample_times = tops;
    auto const r = testing::run(best_isa(), o, {in});
    ASSERT_EQ(r.records[0].status, Status::finished);
    for (std::size_t i = 0; i < tops.size(); ++i) {
        EXPECT_NEAR(r.series[i] + static_cast<double>(c), static_cast<double>(heights[i]), 1e-10 * static_cast<double>(c)) << i;
        // At the top y'' is near −g: what is left of the speed tells how late it is.
        EXPECT_LT(std::abs(r.series[tops.size() + i]) / in.gravity, 1e-10 * tops[i]) << i;
    }
    EXPECT_EQ(r.value(0, Quantity::contact_onsets), 8);  // of two corners each
}

TEST(RigidImpacts, ChatterEndsWithItsGeometricSum) {
    for (double const e : {0.0, 0.3, 0.6, 0.9}) {
        auto const in = pendulum(e);
        Pendulum const exact(in);
        long double const c = in.clearance_y;
        long double time = exact.rise(-c, c), height = c;
        for (int i = 0; i < 600; ++i) {
            height *= static_cast<long double>(e) * e;
            time += 2 * exact.rise(-c, height);
        }
        double const end = static_cast<double>(time) + 0.5;
        auto o = rigid_options(rigid_planar_parts(false, false), 1e-12, end);
        o.settings.max_step = 1e-2;
        auto const r = testing::run(best_isa(), o, {in});
        ASSERT_EQ(r.records[0].status, Status::finished);
        EXPECT_NEAR(r.value(0, Quantity::mode_time, 0), static_cast<double>(time), 1e-9) << e;
        EXPECT_NEAR(r.value(0, Quantity::mode_time, 3), end - static_cast<double>(time), 1e-9) << e;
        // Rest is rest, and costs nothing.
        EXPECT_NEAR(in.crank_length * std::sin(r.states[0][0]) + in.rod_length * std::sin(r.states[0][1]), -in.clearance_y, 1e-16);
        EXPECT_LT(std::abs(r.states[0][4]), 1e-30);
        EXPECT_LT(std::abs(r.states[0][5]), 1e-30);
        EXPECT_LT(r.records[0].steps_accepted, 600u) << e;
    }
}

TEST(RigidImpacts, KeepEnergyWithoutLoss) {
    for (bool const free_crank : {false, true}) {
        auto in = oracle::planar_check_inputs();
        in.restitution = 1;
        in.wz = -3;
        auto const r = testing::run(best_isa(), rigid_options(rigid_planar_parts(false, free_crank), 1e-13, 0.1), {in});
        ASSERT_EQ(r.records[0].status, Status::finished);
        double const impacts = r.value(0, Quantity::contact_onsets);
        EXPECT_GT(impacts, 10) << free_crank;
        double const scale = 0.5 * 3e-3 * 150 * 150;
        EXPECT_LT(std::abs(r.value(0, Quantity::damping_loss)), 1e-12 * scale * impacts) << free_crank;
        EXPECT_LT(std::abs(r.value(0, Quantity::energy_residual)), 1e-12 * scale * impacts) << free_crank;
    }
}

TEST(RigidImpacts, BalanceTheirEnergy) {
    std::vector<Inputs> members;
    std::mt19937_64 draw(5);
    auto const uniform = [&draw](double low, double high) { return std::uniform_real_distribution(low, high)(draw); };
    for (int i = 0; i < 32; ++i) {
        auto in = oracle::planar_check_inputs();
        in.restitution = uniform(0.05, 1);
        in.friction_kinetic = uniform(0, 0.5);
        in.friction_static = in.friction_kinetic + uniform(0, 0.1);
        in.start_angle = uniform(0, 6);
        in.y = uniform(-0.9, 0.9) * in.clearance_y;
        in.wz = uniform(-2, 2);
        members.push_back(complete_inputs(in));
    }
    for (bool const free_crank : {false, true}) {
        auto const r = testing::run(best_isa(), rigid_options(rigid_planar_parts(true, free_crank), 1e-11, 0.1), members);
        for (std::size_t i = 0; i < members.size(); ++i) {
            ASSERT_EQ(r.records[i].status, Status::finished) << i;
            EXPECT_GT(r.value(i, Quantity::friction_loss), 0) << i;
            EXPECT_GE(r.value(i, Quantity::damping_loss), 0) << i;
            EXPECT_LT(std::abs(r.value(i, Quantity::energy_residual)), 1e-7) << i << " " << free_crank;
        }
        // Without friction Newton's restitution makes no energy, and without restitution friction makes none.
        for (auto const& [friction, e] : {std::pair{false, 0.9}, {true, 0.0}}) {
            auto others = members;
            for (auto& in : others) in.restitution = e;
            auto const without = testing::run(best_isa(), rigid_options(rigid_planar_parts(friction, free_crank), 1e-9, 0.1), others);
            for (std::size_t i = 0; i < others.size(); ++i) EXPECT_EQ(without.value(i, Quantity::capped_impacts), 0) << i << " " << e;
        }
    }
}

TEST(RigidImpacts, OfAnyBlockTakeEnergyAndEnd) {
    auto const members = testing::random_rigid_blocks(1500, 3, 0.3);
    for (bool const free_crank : {false, true}) {
        auto o = rigid_options(rigid_planar_parts(true, free_crank), 1e-7, 0.1);
        o.settings.max_step = 2e-3;
        o.settings.max_steps = 200'000;
        auto const r = testing::run(best_isa(), o, members);
        std::size_t jammed = 0;
        for (std::size_t i = 0; i < members.size(); ++i) {
            if (r.records[i].status == Status::contact_domain) {
                ++jammed;
                continue;
            }
            ASSERT_EQ(r.records[i].status, Status::finished) << i << " " << free_crank;
            double const lost = r.value(i, Quantity::friction_loss) + r.value(i, Quantity::damping_loss);
            double const residual = std::abs(r.value(i, Quantity::energy_residual));
            EXPECT_GT(lost, -1e-9) << i;
            double const& speed = members[i].crank_speed;
            double const scale = (members[i].slider_mass + 0.1) * (1 + speed * speed * members[i].crank_length * members[i].crank_length);
            EXPECT_LT(residual, 1e-5 * scale) << i << " " << free_crank;
        }
        EXPECT_LT(jammed, members.size() / 200);
        double capped = 0;
        for (std::size_t i = 0; i < members.size(); ++i) capped += r.value(i, Quantity::capped_impacts);
        EXPECT_GT(capped, 20) << "friction up to 3 is strong";
    }
}

/// A free crank at rest, its block lying on the lower wall of a slope: what friction must hold along the wall over what the wall bears.
double needed_friction(Inputs const& in) {
    double const y = -in.clearance_y, s1 = std::sin(in.start_angle), c1 = std::cos(in.start_angle);
    double const s2 = (y - in.crank_length * s1) / in.rod_length, c2 = std::sqrt(1 - s2 * s2);
    double const m1 = in.crank_mass, m2 = in.rod_mass, m3 = in.slider_mass;
    double const gx = -in.gravity * std::sin(in.inclination), gy = -in.gravity * std::cos(in.inclination);
    double const q1 = (0.5 * m1 + m2 + m3) * in.crank_length * (gy * c1 - gx * s1), q2 = (0.5 * m2 + m3) * in.rod_length * (gy * c2 - gx * s2);
    // q + lᵢ (c F_y − s F_x) = 0 for both links.
    double const a1 = -q1 / in.crank_length, a2 = -q2 / in.rod_length;
    double const determinant = c2 * s1 - c1 * s2;
    double const fy = (a2 * s1 - a1 * s2) / determinant, fx = (a2 * c1 - a1 * c2) / determinant;
    EXPECT_GT(fy, 0);
    return std::abs(fx) / fy;
}

TEST(RigidImpacts, SlopeHoldsBelowItsAngleOfFrictionAndNotAbove) {
    for (double const slope : {0.2, 0.7, -0.4}) {
        auto in = oracle::planar_check_inputs();
        in.crank_speed = 0;
        in.start_angle = 1.0;
        in.inclination = slope;
        in.y = -in.clearance_y;
        double const needed = needed_friction(in);
        for (bool const holds : {true, false}) {
            in.friction_static = in.friction_kinetic = needed * (holds ? 1 + 1e-9 : 1 - 1e-9);
            auto const r = testing::run(best_isa(), rigid_options(rigid_planar_parts(true, true), 1e-9, 1), {in});
            ASSERT_EQ(r.records[0].status, Status::finished);
            double const moved = std::abs(r.states[0][0] - in.start_angle);
            if (holds) EXPECT_LT(moved, 1e-15) << slope;
            else EXPECT_GT(moved, 1e-11) << slope;
        }
    }
}

TEST(RigidImpacts, EndWithAStatusWhateverTheGeometry) {
    std::mt19937_64 draw(11);
    auto const uniform = [&draw](double low, double high) { return std::uniform_real_distribution(low, high)(draw); };
    std::vector<Inputs> members;
    for (int i = 0; i < 400; ++i) {
        auto in = oracle::planar_check_inputs();
        in.clearance_y = std::pow(10, uniform(-5, -2.5));
        in.slider_height = uniform(0.01, 0.3);
        in.slider_length = uniform(0.02, 0.2);
        in.slider_inertia_z = std::pow(10, uniform(-6.5, -3));
        in.crank_speed = uniform(-200, 200);
        in.start_angle = uniform(0, 6.3);
        in.restitution = uniform(0.01, 1);
        in.friction_kinetic = uniform(0, 3);
        in.friction_static = in.friction_kinetic * uniform(1, 2);
        in.y = uniform(-0.9, 0.9) * in.clearance_y;
        in.wz = uniform(-20, 20);
        members.push_back(complete_inputs(in));
    }
    for (bool const free_crank : {false, true}) {
        auto o = rigid_options(rigid_planar_parts(true, free_crank), 1e-6, 0.2);
        o.settings.max_steps = 200'000;
        auto const r = testing::run(best_isa(), o, members);
        std::size_t jammed = 0, buzzing = 0;
        for (std::size_t i = 0; i < members.size(); ++i) {
            Status const status = r.records[i].status;
            jammed += status == Status::contact_domain;
            // Large friction under a drive can keep both corners hitting their walls every few microseconds.
            buzzing += status == Status::max_steps;
            EXPECT_TRUE(status == Status::finished || status == Status::contact_domain || status == Status::max_steps) << i << " " << static_cast<int>(status);
        }
        EXPECT_LT(jammed, members.size() / 3);
        EXPECT_LT(buzzing, members.size() / 10);
    }
}

TEST(RigidImpacts, RefuseAStartInsideAWall) {
    auto in = pendulum(0.5);
    in.y = -1.001 * in.clearance_y;
    auto const r = testing::run(best_isa(), rigid_options(rigid_planar_parts(false, false), 1e-9, 0.1), {in});
    EXPECT_EQ(r.records[0].status, Status::geometry);
    EXPECT_EQ(r.records[0].time, 0);
}

}  // namespace
}  // namespace slideway::rigid_impacts_test
