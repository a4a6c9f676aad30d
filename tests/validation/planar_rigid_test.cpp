// The rigid limit of the planar check (model.md 7), solved by events: what compliant laws are held against.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "kernels/mechanisms/list.hpp"
#include "tests/oracle/planar_runs.hpp"

namespace planar_rigid_test {
namespace {

using oracle::PlanarSample;

double number(long double x) { return static_cast<double>(x); }

/// Largest differences of turns, θ2 and y/c.
PlanarSample farthest(std::vector<PlanarSample> const& a, std::vector<PlanarSample> const& b) {
    PlanarSample worst;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
        worst.turns = std::max(worst.turns, std::abs(a[i].turns - b[i].turns));
        worst.rod_angle = std::max(worst.rod_angle, std::abs(a[i].rod_angle - b[i].rod_angle));
        worst.offset = std::max(worst.offset, std::abs(a[i].offset - b[i].offset));
    }
    return worst;
}

TEST(RigidPlanarCrank, ReproducesThePublishedTable) {
    auto const run = oracle::rigid_run(oracle::planar_check_inputs(), 1e-3L, 10);
    EXPECT_NEAR(number(run.impacts[0].time), 2.69250e-3, 0.5e-8);
    EXPECT_NEAR(number(run.impacts[0].speed), 0.841612, 0.5e-6);
    auto const expect = [&run](std::size_t ms, double turns, double rod_angle, double offset) {
        EXPECT_NEAR(number(run.samples[ms].turns), turns, 0.5e-9) << ms << " ms";
        EXPECT_NEAR(number(run.samples[ms].rod_angle), rod_angle, 0.5e-9) << ms << " ms";
        EXPECT_NEAR(number(run.samples[ms].offset), offset, 0.5e-6) << ms << " ms";
    };
    expect(2, 0.043894044, -0.134949264, 0.494396);
    expect(5, 0.091701364, -0.272931761, 0.873660);
    expect(10, 0.150936703, -0.414752258, 1);
    EXPECT_EQ(number(run.samples[10].offset), 1);
    EXPECT_EQ(run.rests.size(), 1u);
}

TEST(RigidPlanarCrank, HasItsDigitsWhateverTheStep) {
    auto const in = oracle::planar_check_inputs();
    auto const coarse = oracle::rigid_run(in, 1e-3L, 200), fine = oracle::rigid_run(in, 1e-3L, 200, 1e-6L);
    auto const worst = farthest(coarse.samples, fine.samples);
    EXPECT_LT(worst.turns, 1e-12L);
    EXPECT_LT(worst.rod_angle, 1e-12L);
    EXPECT_LT(worst.offset, 1e-11L);
    EXPECT_EQ(coarse.rests.size(), 6u);
    EXPECT_EQ(coarse.leaves.size(), 6u);
}

TEST(RigidPlanarCrank, LosesEnergyByImpactsAlone) {
    auto const run = oracle::rigid_run(oracle::planar_check_inputs(), 1e-3L, 200);
    EXPECT_GT(run.energy_lost, 0.3L);
    EXPECT_NEAR(number(run.energy_change), -number(run.energy_lost), 1e-12);
    auto elastic = oracle::planar_check_inputs();
    elastic.restitution = 1;
    auto const kept = oracle::rigid_run(elastic, 1e-3L, 100);
    EXPECT_GT(kept.impacts.size(), 5u);
    EXPECT_NEAR(number(kept.energy_change), 0, 1e-12);
}

TEST(RigidPlanarCrank, IsTheLimitOfAStiffCompliantBlock) {
    auto const in = oracle::planar_check_inputs();
    slideway::Parts parts;
    parts.mechanism = slideway::Mechanism::planar_slider_crank;
    parts.damping = slideway::Damping::restitution;
    parts.drive.by = slideway::DriveBy::nothing;
    auto const worst = farthest(oracle::rigid_run(in, 1e-3L, 200).samples,
                                oracle::compliant_run(in, parts, 1e-3L, 200, {.near_wall = 8e-7L, .in_flight = 4e-6L}));
    // model.md 7
    EXPECT_LT(worst.turns, 3e-5L);
    EXPECT_LT(worst.rod_angle, 1.6e-4L);
    EXPECT_LT(worst.offset, 0.033L);
}

}  // namespace
}  // namespace planar_rigid_test
