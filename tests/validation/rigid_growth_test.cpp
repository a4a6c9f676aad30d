// Growth of offsets of the planar slider-crank with rigid contacts (model.md 13): against neighbouring orbits of a reference in 80-bit numbers, and what
// impacts do to volumes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/oracle/planar_runs.hpp"
#include "tests/oracle/rigid_block.hpp"
#include "tests/support/rigid_growth.hpp"

namespace slideway::rigid_growth_test {
namespace {

using testing::rigid_planar_parts;
using testing::ShadowOptions;
using testing::with_friction;

constexpr std::size_t size = 6;  // θ1 θ2 ψ and their rates

/// What to follow.
struct Orbit {
    char const* what;
    Inputs in;
    bool friction = false, free_crank = true;
    std::size_t stops = 0;
    double every = 1e-3;  // [s] from stop to stop

    Parts parts() const { return rigid_planar_parts(friction, free_crank); }
};

/// Of the mechanism of scenes/planar_rigid.toml.  @param inertia of the block, times its own
Inputs mechanism(double restitution, double inertia, double speed, double spin) {
    auto in = oracle::planar_check_inputs();
    in.restitution = restitution, in.slider_inertia_z *= inertia, in.crank_speed = speed, in.wz = spin;
    in.friction_static = in.friction_kinetic = 0;
    return in;
}
/// Sizes of the state's numbers, in which offsets are measured.
std::vector<double> scales(Inputs const& in) {
    double const rate = std::max(std::abs(in.crank_speed), 1.0), c = in.clearance_y;
    std::vector<double> all{c / in.crank_length, c / in.rod_length, 2 * c / in.slider_length};
    for (std::size_t i = 0; i < 3; ++i) all.push_back(all[i] * rate);
    return all;
}

/// A start beside the orbit's.
Inputs beside(Orbit const& orbit, double by) {
    auto in = orbit.in;
    double const rate = std::abs(in.crank_speed), c = in.clearance_y;
    in.vy += by * c * rate, in.wz += by * 2 * c / in.slider_length * rate;
    return in;
}

/// Of two orbits of the reference.  @param impacts of both
testing::OffsetLengths neighbours(Orbit const& orbit, std::size_t& impacts) {
    constexpr double by = 1e-9;
    std::vector<oracle::PlanarState> states[2];
    impacts = 0;
    for (int side : {0, 1}) {
        auto const run = oracle::rigid_block_run(beside(orbit, side == 0 ? -by : by), orbit.parts(), static_cast<long double>(orbit.every),
                                                 static_cast<int>(orbit.stops), 2e-5L);
        EXPECT_TRUE(run.solved);
        states[side] = run.samples;
        impacts += static_cast<std::size_t>(std::ranges::count(run.events, oracle::RigidBlockEvent::Kind::impact, &oracle::RigidBlockEvent::kind));
    }
    return testing::offset_lengths(states[1], states[0], by, scales(orbit.in));
}

TEST(RigidGrowth, IsThatOfNeighbouringOrbitsOfTheReference) {
    auto const swinging = [](double inertia, double angle, double spin) {
        auto in = mechanism(0.3, inertia, angle == 0 ? 10 : 3, spin);
        in.start_angle = angle;
        return in;
    };
    auto bouncing = swinging(100, 0, 1);
    bouncing.restitution = 0.5;
    for (Orbit const& orbit : {
             Orbit{"single impacts", mechanism(0.9, 40, 40, -0.01), false, false, 60, 1e-3},
             Orbit{"impacts with friction", with_friction(mechanism(0.6, 40, 40, -0.3), 0.2, 0.2), true, false, 20, 1e-3},
             Orbit{"impacts in turn, and a face that slides and leaves", with_friction(mechanism(0.4, 1, 150, -0.01), 0.1, 0.1), true, true, 60, 1e-3},
             Orbit{"bounces that end in a corner that slides", with_friction(bouncing, 0.3, 0.4), true, true, 30, 5e-3},
             Orbit{"slips that turn round", with_friction(swinging(100, -1.2, 0.5), 0.05, 0.05), true, true, 30, 1e-2},
         }) {
        SCOPED_TRACE(orbit.what);
        std::size_t impacts = 0;
        auto const want = neighbours(orbit, impacts);
        EXPECT_GT(impacts, 4u);
        ShadowOptions options{orbit.parts(), 1e-12, orbit.stops, orbit.every, 1, 1e-6, want.first};
        testing::expect_growth(run_shadowed(best_isa(), options, {orbit.in}), want, 2e-5);
    }
}

/// All offsets of a driven mechanism.
ShadowOptions all_of_driven(bool friction, std::size_t stops, double tolerance) {
    constexpr std::size_t axes[] = {1, 2, 4, 5};
    return {rigid_planar_parts(friction, false), tolerance, stops, 1e-3, 4, 1e-6, testing::directions_along(axes, size)};
}

TEST(RigidGrowth, ContractsVolumesByTheSquareOfRestitutionAtEachImpact) {
    // Flights keep the volume: a Hamiltonian system, whose inertia is that of the rod alone as long as the crank is driven.  An impact of one corner has
    // rank-one changes of positions and of velocities along its normal, each of determinant −e, slipping or without friction.
    constexpr std::size_t stops = 60;
    for (bool const friction : {false, true}) {
        auto const in = friction ? with_friction(mechanism(0.9, 30, 40, -0.5), 0.02, 0.02) : mechanism(0.9, 30, 40, -0.5);
        auto const found = run_shadowed(best_isa(), all_of_driven(friction, stops, 1e-12), {in});
        ASSERT_EQ(found.records[0].status, Status::finished);
        auto const reference = oracle::rigid_block_run(in, rigid_planar_parts(friction, false), 1e-3L, stops, 2e-5L);
        std::size_t impacts = 0;
        for (std::size_t k = 1; k < stops; ++k) {
            double sum = 0;
            for (std::size_t j = 0; j < 4; ++j) sum += found.growth[4 * (k - 1) + j];
            auto const own = std::ranges::count_if(reference.events, [&](auto const& event) {
                return event.time > 1e-3L * static_cast<long double>(k) && event.time <= 1e-3L * static_cast<long double>(k + 1);
            });
            EXPECT_NEAR(sum / (2 * std::log(in.restitution)), static_cast<double>(own), 1e-5) << k;
            impacts += static_cast<std::size_t>(own);
        }
        EXPECT_GT(impacts, 12u) << friction;
    }
}

TEST(RigidGrowth, OfAnElasticMechanismComesInPairs) {
    // Impacts with e = 1 and no friction are symplectic, as flights are: exponents ±λ.
    constexpr std::size_t stops = 2000;
    auto const found = run_shadowed(best_isa(), all_of_driven(false, stops, 1e-10), {mechanism(1, 30, 40, 0.7)});
    ASSERT_EQ(found.records[0].status, Status::finished);
    double sums[4] = {};
    for (std::size_t k = 0; k < found.growth.size(); ++k) sums[k % 4] += found.growth[k];
    double const seconds = 1e-3 * (stops - 1);
    std::ranges::sort(sums, std::greater<>());
    EXPECT_GT(sums[0] / seconds, 20);
    EXPECT_NEAR(sums[0] + sums[3], 0, 0.01 * sums[0]);
    EXPECT_NEAR(sums[1] + sums[2], 0, 0.01 * sums[0]);
    EXPECT_NEAR((sums[0] + sums[1] + sums[2] + sums[3]) / seconds, 0, 1e-4);
}

TEST(RigidGrowth, LeavesTheMemberItsOrbit) {
    // Steps are shared, events are the member's: with equal ones nothing of it changes.
    auto const in = with_friction(mechanism(0.5, 30, 40, -0.5), 0.1, 0.1);
    auto options = all_of_driven(true, 30, 1e-12);
    auto const with = run_shadowed(best_isa(), options, {in});
    options.shadows = 0;
    auto const without = run_shadowed(best_isa(), options, {in});
    for (std::size_t i = 0; i < size; ++i) EXPECT_NEAR(with.states[i], without.states[i], 1e-9 * (1 + std::abs(without.states[i]))) << i;
}

TEST(RigidGrowth, IsCountedWhereCornersMeetAtOnceAndNeighboursDoNot) {
    // A block that does not tilt comes down with both corners; what a tilted neighbour does depends on which of them is first.
    auto const in = mechanism(0.4, 1, 150, 0);
    auto options = ShadowOptions{rigid_planar_parts(false, true), 1e-10, 60, 1e-3, 1, 1e-6, {0, 0, 0.6, 0, 0, 0.8}};
    auto const tilted = run_shadowed(best_isa(), options, {in});
    EXPECT_GT(tilted.records[0].grown_offsets, 3u);
    options.directions = {0, 1, 0, 0, 0, 0};
    auto const flat = run_shadowed(best_isa(), options, {in});
    EXPECT_EQ(flat.records[0].grown_offsets, 0u);
    EXPECT_EQ(flat.records[0].status, Status::finished);
}

TEST(RigidGrowth, OfWhatHasNoFreedomLeftIsLost) {
    // A driven crank and a block that lies flat: nothing can be off, and no offset is put along the crank's angle either.
    auto const in = with_friction(mechanism(0.3, 1, 20, 0.1), 0.2, 0.3);
    for (int const shadows : {1, 4}) {
        auto options = all_of_driven(true, 55, 1e-10);
        options.every = 2e-3;
        options.shadows = shadows;
        auto const found = run_shadowed(best_isa(), options, {in});
        ASSERT_EQ(found.records[0].status, Status::finished);
        EXPECT_GE(found.records[0].lost_offsets, 12u * static_cast<unsigned>(shadows));
        // At rest from interval 41 on.
        std::size_t const width = static_cast<std::size_t>(shadows);
        for (std::size_t k = 42 * width; k < 54 * width; ++k) EXPECT_LT(found.growth[k], std::log(1e-11 / options.d0)) << k / width;
    }
}

}  // namespace
}  // namespace slideway::rigid_growth_test
