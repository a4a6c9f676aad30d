// The kernels' planar slider-crank against the rigid one, and its energy (model.md 7).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "kernels/laws/list.hpp"
#include "kernels/mechanisms/list.hpp"
#include "tests/oracle/planar_runs.hpp"
#include "tests/support/ensemble.hpp"

namespace slideway::planar_test {
namespace {

constexpr std::size_t milliseconds = 200;

testing::RunOptions options(bool friction, bool free_crank, double seconds) {
    testing::RunOptions o;
    o.parts = {Law::conservative, Damping::restitution, friction, false, Mechanism::planar_slider_crank, {.by = free_crank ? slideway::DriveBy::nothing : slideway::DriveBy::speed}};
    o.settings.rtol = o.settings.atol = 1e-9;
    o.settings.max_step = 1e-4;
    o.settings.end_time = seconds;
    return o;
}

struct Distance {
    double turns = 0, rod_angle = 0, offset = 0;
};

/// Largest differences from the rigid mechanism, looked at each millisecond.
std::vector<Distance> from_rigid(std::vector<double> const& stiffnesses) {
    auto const rigid = oracle::rigid_run(oracle::planar_check_inputs(), 1e-3L, milliseconds);
    auto o = options(false, true, 0.2);
    o.series = selection_of(Series::y) | selection_of(Series::crank_angle) | selection_of(Series::rod_angle);
    for (std::size_t i = 0; i <= milliseconds; ++i)
        o.sample_times.push_back(std::min(1e-3 * static_cast<double>(i), 0.2));
    std::vector<Inputs> members;
    for (double const stiffness : stiffnesses) {
        members.push_back(oracle::planar_check_inputs());
        members.back().point_stiffness = stiffness;
    }
    auto const r = testing::run(best_isa(), o, members);
    std::vector<Distance> all;
    for (std::size_t m = 0; m < members.size(); ++m) {
        EXPECT_EQ(r.records[m].status, Status::finished);
        Distance d;
        auto const at = [&](std::size_t row, std::size_t i) {
            return r.series[(row * members.size() + m) * (milliseconds + 1) + i];
        };
        for (std::size_t i = 0; i <= milliseconds; ++i) {
            auto const& expected = rigid.samples[i];
            auto const off = [](double value, long double from) { return std::abs(value - static_cast<double>(from)); };
            d.offset = std::max(d.offset, off(at(0, i) / members[m].clearance_y, expected.offset));
            d.turns = std::max(d.turns, off(at(1, i) / (2 * std::numbers::pi), expected.turns));
            d.rod_angle = std::max(d.rod_angle, off(at(2, i), expected.rod_angle));
        }
        all.push_back(d);
    }
    return all;
}

TEST(PlanarSliderCrank, StaysNearTheRigidOneAndComesToItAsContactStiffens) {
    auto const by_stiffness = from_rigid({1e11, 1e9, 1e10, 1e12, 1e13});
    EXPECT_LT(by_stiffness[0].turns, 1e-4);
    EXPECT_LT(by_stiffness[0].rod_angle, 5e-4);
    EXPECT_LT(by_stiffness[0].offset, 0.08);
    // From decade to decade by 10^0.4: an impact's depth goes with K^-2/5.
    std::vector<Distance> const decades{by_stiffness[1], by_stiffness[2], by_stiffness[0], by_stiffness[3],
                                        by_stiffness[4]};
    for (std::size_t i = 1; i < decades.size(); ++i) {
        EXPECT_LT(decades[i].turns, 0.7 * decades[i - 1].turns) << i;
        EXPECT_LT(decades[i].rod_angle, 0.7 * decades[i - 1].rod_angle) << i;
        EXPECT_LT(decades[i].offset, 0.7 * decades[i - 1].offset) << i;
    }
    double const rate = std::log10(decades.front().turns / decades.back().turns) / 4;
    EXPECT_NEAR(rate, 0.4, 0.1);
}

TEST(PlanarSliderCrank, KeepsItsBooksOfEnergyWithFrictionAndDrive) {
    auto in = oracle::planar_check_inputs();
    in.crank_speed = 40;
    in.wz = 5;  // the block tilts too
    double worst[2];
    int i = 0;
    for (double const tolerance : {1e-7, 1e-10}) {
        auto o = options(true, false, 0.4);
        o.settings.rtol = o.settings.atol = tolerance;
        auto const r = testing::run(best_isa(), o, {in});
        ASSERT_EQ(r.records[0].status, Status::finished);
        EXPECT_GT(r.value(0, Quantity::friction_loss), 1e-3);
        EXPECT_GT(r.value(0, Quantity::damping_loss), 1e-3);
        EXPECT_GT(r.value(0, Quantity::contact_onsets), 20);
        worst[i++] = std::abs(r.value(0, Quantity::energy_residual)) / r.value(0, Quantity::damping_loss);
    }
    EXPECT_LT(worst[0], 1e-3);
    EXPECT_LT(worst[1], 1e-6);
}

TEST(PlanarSliderCrank, IsDrivenByTheTorqueThatItTells) {
    // Driven without clearance effects (no contact for a while), the work of the torque is the change of energy.
    auto in = oracle::planar_check_inputs();
    in.crank_speed = 20;
    in.clearance_y = 0.2;  // it never touches
    auto const r = testing::run(best_isa(), options(false, false, 0.1), {in});
    ASSERT_EQ(r.records[0].status, Status::finished);
    EXPECT_EQ(r.value(0, Quantity::contact_onsets), 0);
    double const change = r.value(0, Quantity::energy_change);
    EXPECT_GT(std::abs(change), 1e-3);
    EXPECT_NEAR(r.value(0, Quantity::drive_work), change, 1e-7);
    // The drive holds its angle to the last bits.
    EXPECT_NEAR(r.states[0][0], 2.0, 1e-12);
    EXPECT_EQ(r.states[0][3], 20);
}

}  // namespace
}  // namespace slideway::planar_test
