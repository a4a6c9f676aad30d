// Offsets of a slider with eight apices that moves in a plane beside those of the planar slider-crank: other equations, another state, other solvers of impacts.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "kernels/mechanisms/list.hpp"
#include "tests/support/ensemble.hpp"
#include "tests/support/rigid_growth.hpp"
#include "tests/support/rigid_joint.hpp"

namespace slideway::rigid_plane_test {
namespace {

using testing::run_shadowed;
using testing::ShadowResult;

/// A thin block on a rod so long that its angle is the slider's height: both mechanisms then have the same state, in the same scales.  The rod has next to no
/// mass.  A spatial slider slides on its way's faces, the planar one with its own corners: their friction has the same lever only if that is none.
Inputs mechanism(double restitution, double friction) {
    Inputs in;
    in.crank_length = 0.02, in.rod_length = 5, in.crank_speed = 60, in.start_angle = 0.4;
    in.rod_mass = 1e-9, in.slider_mass = 0.2;
    in.slider_length = 0.04, in.slider_height = 1e-6, in.way_width = 1e-6, in.way_depth = 0.02;
    in.slider_inertia_x = in.slider_inertia_y = in.slider_inertia_z = 4e-5;
    in.clearance_y = in.clearance_z = 1e-5;
    in.restitution = restitution;
    in.y = 2e-6, in.pitch = 1e-4, in.vy = 3e-3, in.wz = 0.2;
    return complete_inputs(testing::with_friction(in, friction, friction));
}

constexpr std::size_t stops = 20;
constexpr double every = 5e-4;

/// Along a height, a tilt and their rates, in this order.
ShadowResult grown(Parts const& parts, std::array<std::size_t, 4> const& axes, std::size_t size, Inputs const& in) {
    return run_shadowed(best_isa(), {parts, 1e-12, stops, every, 4, 1e-6, testing::directions_along(axes, size)}, {in});
}

TEST(RigidPlane, OffsetsOfASpatialSliderGrowAsThoseOfThePlanarOne) {
    // What is left of levers, a clearance of 40 mm, grows with the offsets; after 20 ms the spatial slider leaves the plane.
    for (auto const& [friction, near] : {std::pair{0.0, 1e-4}, std::pair{0.1, 3e-3}}) {
        auto const in = mechanism(0.9, friction);
        auto const plane = grown(testing::rigid_planar_parts(friction > 0, false), {1, 2, 4, 5}, 6, in);
        auto const space = grown(testing::rigid_joint_parts(friction > 0, false, Mechanism::slider_crank), {0, 6, 2, 9}, 10, in);
        ASSERT_EQ(plane.records[0].status, Status::finished);
        ASSERT_EQ(space.records[0].status, Status::finished);
        double largest = 0, volume = 0;
        for (std::size_t k = 0; k < plane.growth.size(); ++k) {
            EXPECT_NEAR(space.growth[k], plane.growth[k], near) << "stop " << k / 4 + 1 << ", offset " << k % 4;
            largest += k % 4 == 0 ? plane.growth[k] : 0;
            volume += plane.growth[k];
        }
        EXPECT_GT(largest, 1);
        // Ten impacts and more, each of which shrinks volumes by e².
        EXPECT_LT(volume, 20 * std::log(in.restitution));
    }
}

/// What a motor's crank and its slider do in the plane, by either mechanism: angle, its rate, height, tilt and their rates.
std::array<double, 6> moved(Parts const& parts, Inputs const& in, double seconds) {
    testing::RunOptions o;
    o.parts = parts;
    o.parts.drive = {.by = DriveBy::torque};
    o.settings.rtol = o.settings.atol = 1e-11;
    o.settings.end_time = seconds;
    auto const r = testing::run(best_isa(), o, {in});
    EXPECT_EQ(r.records[0].status, Status::finished);
    EXPECT_GT(r.value(0, Quantity::contact_onsets), 3);
    auto const& s = r.states[0];
    if (parts.mechanism != Mechanism::planar_slider_crank) return {s[10], s[11], s[0], s[6], s[2], s[9]};
    double const y = in.crank_length * std::sin(s[0]) + in.rod_length * std::sin(s[1]);
    double const vy = in.crank_length * std::cos(s[0]) * s[3] + in.rod_length * std::cos(s[1]) * s[4];
    return {s[0], s[3], y, s[2], vy, s[5]};
}

TEST(RigidPlane, ACrankOnAMotorMovesAsThePlanarOne) {
    for (double const friction : {0.0, 0.2}) {
        auto in = mechanism(0.7, friction);
        in.crank_length = 0.05, in.rod_length = 0.14, in.drive_torque = 0.8, in.drive_inertia = 2e-4;
        in.crank_inertia = 1e-5, in.crank_mass = 0.05;
        for (double const angle : {0.0, 2.0}) {
            in.start_angle = angle;
            auto const plane = moved(testing::rigid_planar_parts(friction > 0, false), in, 0.012);
            auto const space = moved(testing::rigid_joint_parts(friction > 0, false, Mechanism::slider_crank_motor), in, 0.012);
            // Friction has another lever, by the clearance.
            for (std::size_t i = 0; i < plane.size(); ++i) EXPECT_NEAR(space[i], plane[i], friction > 0 ? 1e-5 : 1e-9) << "of " << i << " from " << angle << " with " << friction;
            EXPECT_GT(std::abs(plane[1] - in.crank_speed), 1);
        }
    }
}

}  // namespace
}  // namespace slideway::rigid_plane_test
