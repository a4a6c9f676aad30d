// Growth of offsets of spatial mechanisms with rigid contacts (model.md 13): against neighbouring orbits of a reference in 80-bit numbers, closed forms, and
// what impacts do to volumes.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "kernels/mechanisms/list.hpp"
#include "tests/oracle/rigid_slider.hpp"
#include "tests/support/rigid_growth.hpp"
#include "tests/support/rigid_joint.hpp"
#include "tests/support/table_bounce.hpp"

namespace slideway::rigid_joint_growth_test {
namespace {

using testing::drifting_sliders;
using testing::rigid_joint_parts;
using testing::ShadowOptions;
using testing::with_friction;

constexpr std::size_t size = 10;  // y z vy vz roll yaw pitch wx wy wz
using Offset = std::array<double, size>;

/// What to follow.
struct Orbit {
    char const* what;
    Parts parts;
    Inputs in;
    Offset start;  // of the neighbours, in the scales of the state
    std::size_t stops;
    double every;           // [s] from stop to stop
    double by;              // distance of the neighbours
    double loosest = 1e-9;  // tolerance with which it is the same
};

Offset scales(Inputs const& in, Mechanism mechanism = Mechanism::slider_crank) {
    bool const turns = mechanism != Mechanism::carriage;
    double const own = turns ? std::abs(in.crank_speed) : std::numbers::pi / (in.stroke / in.carriage_speed + in.reversal_time);
    double const rate = std::max(own, 1.0), y = in.clearance_y, z = in.clearance_z;
    double const tilt = 2 * std::min(y, z) / in.slider_length, turn = tilt * rate;
    return {y, z, y * rate, z * rate, tilt, tilt, tilt, turn, turn, turn};
}

Inputs beside(Orbit const& orbit, double by) {
    auto in = orbit.in;
    auto const scale = scales(in, orbit.parts.mechanism);
    double* const of[size] = {&in.y, &in.z, &in.vy, &in.vz, &in.roll, &in.yaw, &in.pitch, &in.wx, &in.wy, &in.wz};
    for (std::size_t i = 0; i < size; ++i) *of[i] += by * orbit.start[i] * scale[i];
    return in;
}

/// Of two orbits of the reference.
testing::OffsetLengths neighbours(Orbit const& orbit) {
    std::vector<long double> times;
    for (std::size_t k = 0; k <= orbit.stops; ++k)
        times.push_back(static_cast<long double>(orbit.every) * static_cast<long double>(k));
    std::vector<oracle::RigidSliderState> states[2];
    for (int side : {0, 1}) {
        auto const run = oracle::rigid_slider_run(beside(orbit, side == 0 ? -orbit.by : orbit.by), orbit.parts, times);
        EXPECT_TRUE(run.solved);
        states[side] = run.samples;
    }
    return testing::offset_lengths(states[1], states[0], orbit.by, scales(orbit.in, orbit.parts.mechanism));
}

/// In all directions, and in those of a plane alone.
constexpr Offset aside{0.2, 0.5, 1, -0.3, 0.1, -0.2, 0.3, -0.7, 0.4, 1}, in_plane{0, 0, 1, 0, 0, 0, 0, 0, 0, 1};

Inputs slider(unsigned seed, double e, double kinetic = 0, double holding = 0) {
    return with_friction(drifting_sliders(1, seed, e, 0)[0], kinetic, holding);
}
/// Falls on an edge, which slides while the drive turns round.
Inputs on_an_edge(double kinetic, double holding) {
    Inputs in;
    in.restitution = 1e-300;
    in.crank_speed = 10, in.start_angle = 3.08;
    in.pitch = 1.2e-3, in.y = -2e-5;
    return complete_inputs(with_friction(in, kinetic, holding));
}
/// On a way that is turned and shifted.
Inputs misaligned(Inputs in) {
    in.way_roll = 3e-4, in.way_yaw = -2e-4, in.way_pitch = 4e-4, in.way_offset_y = 1e-5, in.way_offset_z = -1e-5;
    in.roll += in.way_roll, in.yaw += in.way_yaw, in.pitch += in.way_pitch;
    return in;
}

std::vector<Orbit> orbits() {
    auto const parts = [](Mechanism mechanism, bool friction, bool turned = false) {
        return rigid_joint_parts(friction, turned, mechanism);
    };
    using enum Mechanism;
    return {
        {"single impacts", parts(slider_crank, false), slider(7, 0.9), aside, 40, 5e-4, 1e-8},
        {"impacts with friction", parts(slider_crank, true), slider(9, 0.8, 0.1, 0.1), aside, 30, 5e-4, 1e-8},
        {"impacts that stop slips", parts(scotch_yoke, true), slider(11, 0.9, 0.6, 0.7), aside, 30, 5e-4, 1e-8},
        {"friction that turns slips", parts(slider_crank, true), slider(23, 0.8, 1.5, 2), aside, 20, 5e-4, 1e-8},
        {"impacts on a carriage", parts(carriage, false, true), misaligned(slider(13, 0.9)), aside, 20, 5e-4, 1e-8},
        {"impacts on a turned way", parts(scotch_yoke, false, true), misaligned(slider(12, 0.9)), aside, 20, 5e-4,
         1e-8},
        {"bounces that end", parts(slider_crank, false), slider(7, 0.5), aside, 40, 5e-4, 1e-7},
        {"faces that come to rest at once", parts(slider_crank, false), slider(7, 0), aside, 30, 5e-4, 1e-7},
        {"pairs that slide and leave", parts(slider_crank, true), slider(7, 0, 0.5, 0.6), aside, 12, 5e-4, 1e-6},
        {"a slip that turns round", parts(scotch_yoke, true), on_an_edge(0.3, 0.3), in_plane, 16, 2.5e-4, 1e-5, 1e-6},
        {"and has to be set going", parts(scotch_yoke, true), on_an_edge(0.2, 0.4), in_plane, 16, 2.5e-4, 1e-6, 1e-6},
    };
}

TEST(RigidJointGrowth, IsThatOfNeighbouringOrbitsOfTheReference) {
    for (Orbit const& orbit : orbits()) {
        SCOPED_TRACE(orbit.what);
        auto const want = neighbours(orbit);
        for (double const tolerance : {1e-12, orbit.loosest}) {
            ShadowOptions options{orbit.parts, tolerance, orbit.stops, orbit.every, 1, 1e-6, want.first};
            testing::expect_growth(run_shadowed(best_isa(), options, {orbit.in}), want, 1e-5);
        }
    }
}

/// Of all directions.
ShadowOptions all_of(Parts const& parts, std::size_t stops, double every, double tolerance) {
    constexpr std::size_t axes[size] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9};
    return {parts, tolerance, stops, every, size, 1e-6, testing::directions_along(axes, size)};
}

TEST(RigidJointGrowth, ContractsVolumesByTheSquareOfRestitutionAtEachImpact) {
    // Flights keep the volume, as those of a Hamiltonian system of constant masses do.  An impact of one apex without friction has rank-one changes of
    // positions and of velocities along its normal, each of determinant −e.
    constexpr std::size_t stops = 40;
    constexpr double every = 5e-4;
    auto const parts = rigid_joint_parts(false, false, Mechanism::scotch_yoke);
    auto const in = slider(15, 0.9);
    auto const found = run_shadowed(best_isa(), all_of(parts, stops, every, 1e-12), {in});
    ASSERT_EQ(found.records[0].status, Status::finished);
    std::vector<long double> times;
    for (std::size_t k = 1; k <= stops; ++k)
        times.push_back(static_cast<long double>(every) * static_cast<long double>(k));
    auto const reference = oracle::rigid_slider_run(in, parts, times);
    for (std::size_t k = 1; k < stops; ++k) {
        double sum = 0;
        for (std::size_t j = 0; j < size; ++j) sum += found.growth[size * (k - 1) + j];
        EXPECT_NEAR(sum / (2 * std::log(in.restitution)), reference.impacts[k] - reference.impacts[k - 1], 1e-5) << k;
    }
    EXPECT_GT(reference.impacts.back() - reference.impacts[0], 12);
}

TEST(RigidJointGrowth, OfAnElasticSliderComesInPairs) {
    // Impacts with e = 1 and no friction are symplectic, as flights are: exponents ±λ.
    constexpr std::size_t stops = 8000;
    constexpr double every = 5e-4;
    auto const parts = rigid_joint_parts(false, false, Mechanism::scotch_yoke);
    auto const found = run_shadowed(best_isa(), all_of(parts, stops, every, 1e-10), {slider(16, 1)});
    ASSERT_EQ(found.records[0].status, Status::finished);
    std::array<double, size> sums{};
    for (std::size_t k = 0; k < found.growth.size(); ++k) sums[k % size] += found.growth[k];
    std::ranges::sort(sums, std::greater<>());
    double const seconds = every * (stops - 1);
    EXPECT_GT(sums[0] / seconds, 50);
    double all = 0;
    for (std::size_t i = 0; i < size; ++i) {
        EXPECT_NEAR(sums[i] + sums[size - 1 - i], 0, 0.03 * sums[0]) << i;
        all += sums[i];
    }
    EXPECT_NEAR(all / seconds, 0, 1e-3);
}

TEST(RigidJointGrowth, OfABounceOnAnInclinedWayIsThatOfTheBallOnItsTable) {
    // Driven along X under a way that is inclined, a flat slider sees a vibrating table.
    constexpr double slope = 0.3, rate = 300, period = 2 * std::numbers::pi / rate;
    for (double const e : {0.5, 0.8}) {
        auto const bounce =
            testing::Bounce::with(e, testing::Bounce::acceleration_of(0.4 * (1 + e * e) + 0.6 * 2 * e, e));
        Inputs in;
        double const fall = in.gravity * std::cos(slope), length = fall * period * period, sine = std::sin(slope),
                     cosine = std::cos(slope);
        in.restitution = e;
        in.crank_speed = rate, in.start_angle = bounce.inputs.phase;
        in.crank_length = bounce.inputs.amplitude * fall / (sine * rate * rate);
        in.clearance_y = in.clearance_z = 2e-3;
        in.way_pitch = in.pitch = slope;
        double const x = in.crank_length * std::cos(in.start_angle),
                     vx = -rate * in.crank_length * std::sin(in.start_angle);
        in.y = (bounce.inputs.height * length - in.clearance_y + sine * x) / cosine;
        in.vy = (bounce.inputs.speed * length / period + sine * vx) / cosine;
        constexpr std::size_t stops = 9;
        double const angle = 0.7, c = in.clearance_y;
        ShadowOptions options{
            rigid_joint_parts(false, true, Mechanism::scotch_yoke), 1e-12, stops, period, 1, 1e-6, {}};
        options.directions = {std::cos(angle), 0, std::sin(angle), 0, 0, 0, 0, 0, 0, 0};
        auto const found = run_shadowed(best_isa(), options, {complete_inputs(in)});
        ASSERT_EQ(found.records[0].status, Status::finished);
        EXPECT_EQ(found.records[0].grown_offsets, 0u);
        // Half a flight, the impact, half a flight.
        double const half = period / 2, kick = -(1 + e) * bounce.f / bounce.speed / period;
        double height = c * std::cos(angle), speed = c * rate * std::sin(angle);
        auto const norm = [&] { return std::hypot(height / c, speed / (c * rate)); };
        for (std::size_t k = 0; k < stops; ++k) {
            double const before = norm();
            height += half * speed;
            speed = kick * height - e * speed;
            height *= -e;
            height += half * speed;
            if (k == 0) continue;
            EXPECT_NEAR(found.growth[k - 1], std::log(norm() / before), 1e-8) << k;
        }
    }
}

/// Flat on the lower Y face of its way.
Inputs lying() {
    Inputs in;
    in.restitution = 0.5;
    in.crank_speed = 0;
    in.y = -in.clearance_y;
    return in;
}

TEST(RigidJointGrowth, OfASlipThatStopsIsTheChangeOfItsWay) {
    // z = v²/(2 μ g) from speed v, where the slider then sticks: an offset δv becomes v δv/(μ g).
    auto in = with_friction(lying(), 0.2, 0.3);
    in.vz = 0.01;
    ShadowOptions options{rigid_joint_parts(true, false, Mechanism::scotch_yoke),
                          1e-10,
                          5,
                          2e-3,
                          1,
                          1e-6,
                          {0, 0, 0, 1, 0, 0, 0, 0, 0, 0}};
    auto const found = run_shadowed(best_isa(), options, {complete_inputs(in)});
    ASSERT_EQ(found.records[0].status, Status::finished);
    double const end = in.vz / (in.friction_kinetic * in.gravity);
    EXPECT_NEAR(found.states[1], in.vz * end / 2, 1e-9 * in.clearance_z);
    // Speeds are measured by c in a second.
    EXPECT_NEAR(found.growth[0], std::log(std::hypot(4e-3, 1) / std::hypot(2e-3, 1)), 1e-6);
    EXPECT_NEAR(found.growth[1], std::log(end / std::hypot(4e-3, 1)), 1e-6);
    EXPECT_NEAR(found.growth[2], 0, 1e-6);
    EXPECT_NEAR(found.growth[3], 0, 1e-6);
}

TEST(RigidJointGrowth, OfWhatContactsHoldIsLost) {
    // A slider that lies flat may be shifted and turned on its face, and nothing else.
    auto in = lying();
    in.vz = 1e-4;
    constexpr double every = 1e-2;
    for (std::size_t i = 0; i < size; ++i) {
        ShadowOptions options{rigid_joint_parts(false, false, Mechanism::scotch_yoke),
                              1e-10,
                              5,
                              every,
                              1,
                              1e-6,
                              std::vector<double>(size)};
        options.directions[i] = 1;
        auto const found = run_shadowed(best_isa(), options, {complete_inputs(in)});
        ASSERT_EQ(found.records[0].status, Status::finished);
        bool const free = i == 1 || i == 3 || i == 5 || i == 8;  // z, vz, yaw, wy
        if (free) {
            EXPECT_EQ(found.records[0].lost_offsets, 0u) << i;
        }
        // What is lost is started anew, from rounding, and finds into the directions that are free.
        for (std::size_t k = 0; k < (free ? 4u : 1u); ++k) {
            double const from = every * static_cast<double>(k + 1), to = from + every;
            bool const moves = i == 3 || i == 8;
            double const want = moves ? std::log(std::hypot(to, 1) / std::hypot(from, 1)) : 0;
            if (free) {
                EXPECT_NEAR(found.growth[k], want, 1e-7) << i;
            } else {
                EXPECT_LT(found.growth[k], std::log(1e-6))
                    << i;  // rounding, in forces of 1e5 times what speeds of c in a second are
            }
        }
    }
}

TEST(RigidJointGrowth, LeavesTheMemberItsOrbit) {
    // Steps are shared, events are the member's: with equal ones nothing of it changes.
    auto const in = slider(17, 0.7, 0.2, 0.3);
    auto options = all_of(rigid_joint_parts(true, false, Mechanism::slider_crank), 30, 5e-4, 1e-12);
    auto const with = run_shadowed(best_isa(), options, {in});
    options.shadows = 0;
    auto const without = run_shadowed(best_isa(), options, {in});
    auto const scale = scales(in);
    for (std::size_t i = 0; i < size; ++i) EXPECT_NEAR(with.states[i], without.states[i], 1e-7 * scale[i]) << i;
}

TEST(RigidJointGrowth, IsCountedWhereApicesMeetAtOnceAndNeighboursDoNot) {
    // A flat slider comes down with four apices; what a tilted neighbour does depends on which of them is first.
    auto in = lying();
    in.y = 0;
    auto options = ShadowOptions{rigid_joint_parts(false, false, Mechanism::scotch_yoke),
                                 1e-10,
                                 10,
                                 2e-3,
                                 1,
                                 1e-6,
                                 {0, 0, 0, 0, 0, 0, 0.6, 0, 0, 0.8}};
    auto const tilted = run_shadowed(best_isa(), options, {complete_inputs(in)});
    EXPECT_GT(tilted.records[0].grown_offsets, 3u);
    options.directions = {0, 0, 1, 0, 0, 0, 0, 0, 0, 0};
    auto const flat = run_shadowed(best_isa(), options, {complete_inputs(in)});
    EXPECT_EQ(flat.records[0].grown_offsets, 0u);
    EXPECT_EQ(flat.records[0].status, Status::finished);
}

}  // namespace
}  // namespace slideway::rigid_joint_growth_test
