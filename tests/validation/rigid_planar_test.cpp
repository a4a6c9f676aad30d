// The planar slider-crank with rigid contacts (model.md 13) against two references that go from event to event in 80-bit numbers.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "tests/oracle/moreau_jean.hpp"
#include "tests/oracle/planar_runs.hpp"
#include "tests/oracle/rigid_block.hpp"
#include "tests/support/rigid.hpp"

namespace slideway::rigid_planar_test {
namespace {

using testing::rigid_options;
using testing::rigid_planar_parts;

constexpr std::size_t milliseconds = 200;

struct Distance {
    double turns = 0, rod_angle = 0, offset = 0, pitch = 0;
};

Inputs with_friction_and_spin() {
    auto in = oracle::planar_check_inputs();
    in.friction_static = in.friction_kinetic = 0.01;
    in.wz = -0.01;
    return in;
}

/// Largest differences from states at each millisecond.
Distance distance(Inputs const& in, bool friction, double tolerance, std::vector<oracle::PlanarState> const& expected, Method method = Method::automatic) {
    auto o = rigid_options(rigid_planar_parts(friction, true), tolerance, 0.2);
    o.settings.method = method;
    o.series = selections::of({Series::y, Series::pitch, Series::crank_angle, Series::rod_angle});
    for (std::size_t i = 0; i <= milliseconds; ++i) o.sample_times.push_back(std::min(1e-3 * static_cast<double>(i), 0.2));
    auto const r = testing::run(best_isa(), o, {in});
    EXPECT_EQ(r.records[0].status, Status::finished);
    Distance d;
    for (std::size_t i = 0; i <= milliseconds; ++i) {
        auto const& s = expected[i];
        auto const at = [&](std::size_t row) { return static_cast<long double>(r.series[row * (milliseconds + 1) + i]); };
        long double const y = in.crank_length * std::sin(s[0]) + in.rod_length * std::sin(s[1]);
        auto const raise = [](double& most, long double value) { most = std::max(most, static_cast<double>(std::abs(value))); };
        raise(d.offset, (at(0) - y) / in.clearance_y);
        raise(d.pitch, at(1) - s[2]);
        raise(d.turns, (at(2) - s[0]) / (2 * std::numbers::pi_v<long double>));
        raise(d.rod_angle, at(3) - s[1]);
    }
    return d;
}

std::vector<oracle::PlanarState> reference(Inputs const& in, bool friction, long double step = 5e-6L) {
    auto const run = oracle::rigid_block_run(in, rigid_planar_parts(friction, true), 1e-3L, milliseconds, step);
    EXPECT_TRUE(run.solved);
    return run.samples;
}

TEST(RigidPlanar, ParallelBlockIsThatOfTheReference) {
    auto const in = oracle::planar_check_inputs();
    auto const own = reference(in, false);
    // Both references, of different equations, and what is published: tests/validation/planar_rigid_test.cpp.
    auto const other = oracle::rigid_run(in, 1e-3L, milliseconds);
    for (std::size_t i = 0; i <= milliseconds; ++i) {
        EXPECT_NEAR(static_cast<double>(own[i][1] - other.samples[i].rod_angle), 0, 1e-11) << i;  // the other ends bounces sooner
    }
    auto const d = distance(in, false, 1e-12, own);
    EXPECT_LT(d.turns, 2e-12);
    EXPECT_LT(d.rod_angle, 3e-11);
    EXPECT_LT(d.offset, 2e-9);
    EXPECT_LT(d.pitch, 1e-13);
}

TEST(RigidPlanar, TiltedBlockWithFrictionIsThatOfTheReference) {
    auto const in = with_friction_and_spin();
    auto const d = distance(in, true, 1e-12, reference(in, true));
    EXPECT_LT(d.turns, 5e-12);
    EXPECT_LT(d.rod_angle, 1e-10);
    EXPECT_LT(d.offset, 1e-8);
}

/// Coefficients of 0 are as no friction: a contact that lasts slips either way, and none of that ends it.
TEST(RigidPlanar, CoefficientsOfZeroAreAsNoFriction) {
    auto in = with_friction_and_spin();
    in.friction_static = in.friction_kinetic = 0;
    auto const without = testing::run(best_isa(), rigid_options(rigid_planar_parts(false, true), 1e-9, 0.1), {in});
    auto const with = testing::run(best_isa(), rigid_options(rigid_planar_parts(true, true), 1e-9, 0.1), {in});
    ASSERT_EQ(with.records[0].status, Status::finished);
    for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(with.states[0][i], without.states[0][i], 1e-9 * std::max(1.0, std::abs(without.states[0][i]))) << i;
    in.friction_static = 0.1;
    EXPECT_EQ(testing::run(best_isa(), rigid_options(rigid_planar_parts(true, true), 1e-9, 0.1), {in}).records[0].status, Status::finished);
}

TEST(RigidPlanar, ConvergesWithTheOrderOfItsMethod) {
    auto const in = with_friction_and_spin();
    auto const expected = reference(in, true);
    // A tolerance bounds the error of a step: that of the run follows it with some power near 1.
    double const coarse = distance(in, true, 1e-6, expected, Method::dopri5).turns;
    double const fine = distance(in, true, 1e-10, expected, Method::dopri5).turns;
    EXPECT_LT(coarse, 1e-5);
    EXPECT_GT(std::log10(coarse / fine), 0.75 * 4) << coarse << " " << fine;
    EXPECT_LT(distance(in, true, 1e-11, expected, Method::verner65).turns, 1e-10);
}

/// Mean distance of the slider's height [clearances] between time stepping and the reference that goes from event to event, over 50 ms.
double distance_of_time_stepping(Inputs const& in, bool friction, std::vector<oracle::PlanarState> const& expected, long double step) {
    constexpr int count = 50;
    auto const stepped = oracle::moreau_jean_run(in, rigid_planar_parts(friction, true), 1e-3L, count, step);
    long double sum = 0;
    for (std::size_t i = 1; i <= count; ++i) {
        auto const height = [&](oracle::PlanarState const& s) { return in.crank_length * std::sin(s[0]) + in.rod_length * std::sin(s[1]); };
        sum += std::abs(height(stepped[i]) - height(expected[i])) / in.clearance_y;
    }
    return static_cast<double>(sum / count);
}

TEST(RigidPlanar, IsWhatTimeSteppingConvergesTo) {
    auto const flat = oracle::planar_check_inputs();
    auto const of_flat = reference(flat, false);
    double const coarse = distance_of_time_stepping(flat, false, of_flat, 1.6e-5L), fine = distance_of_time_stepping(flat, false, of_flat, 1e-6L);
    // Of first order: a sixteenth of the step.
    EXPECT_GT(std::log2(coarse / fine), 0.9 * 4) << coarse << " " << fine;
    EXPECT_LT(fine, 1e-3);

    // Where impacts at two corners follow one another faster than the steps, which take them one by one, it comes slower: docs/how_to/rigid.md.
    auto const tilted = with_friction_and_spin();
    auto const of_tilted = reference(tilted, true);
    EXPECT_LT(distance_of_time_stepping(tilted, true, of_tilted, 1e-6L), 0.25 * distance_of_time_stepping(tilted, true, of_tilted, 1.6e-5L));
}

/// What Siconos' repository of examples keeps of this mechanism, for its own tests (examples/mechanics/SliderCrank of siconos-tutorials, the run with
/// direct projection): flat at the start, friction 0.01, Moreau and Jean's time stepping with steps of 0.1 ms.
struct StoredState {
    std::size_t millisecond;
    double turns, height;  // of the crank; of the slider [clearances]
};
constexpr StoredState stored_by_siconos[]{{2, 0.0439361465, 0.4870712196},
                                          {5, 0.0919559941, 0.8398104170},
                                          {6, 0.1051814756, 0.9877432286},
                                          {7, 0.1175517649, 0.9558875475}};

TEST(RigidPlanar, StoredRunOfSiconosIsAsNearAsItsStep) {
    auto in = oracle::planar_check_inputs();
    in.friction_static = in.friction_kinetic = 0.01;
    auto const exact = reference(in, true);
    EXPECT_LT(distance(in, true, 1e-12, exact).offset, 1e-8);
    auto const stepped = oracle::moreau_jean_run(in, rigid_planar_parts(true, true), 1e-3L, 8, 1e-4L);
    auto const turns = [](oracle::PlanarState const& s) {
        return static_cast<double>(s[0] / (2 * std::numbers::pi_v<long double>));
    };
    auto const height = [&in](oracle::PlanarState const& s) {
        return static_cast<double>((in.crank_length * std::sin(s[0]) + in.rod_length * std::sin(s[1])) /
                                   in.clearance_y);
    };
    // Two programs with the same method and step and other ways to take forces and gaps: one is about as far as the other.
    for (auto const& [ms, of_turns, of_height] : stored_by_siconos) {
        EXPECT_LT(std::abs(of_turns - turns(exact[ms])), 2 * std::abs(turns(stepped[ms]) - turns(exact[ms]))) << ms;
        EXPECT_LT(std::abs(of_height - height(exact[ms])), 2 * std::abs(height(stepped[ms]) - height(exact[ms]))) << ms;
        EXPECT_NEAR(of_turns, turns(exact[ms]), 6e-3 * of_turns) << ms;
        EXPECT_NEAR(of_height, height(exact[ms]), 0.035) << ms;
    }
}

/// Largest distance of the slider's height [clearances] between compliant corners and rigid ones.
double distance_of_compliant(Inputs in, double stiffness) {
    auto o = rigid_options(rigid_planar_parts(false, true), 1e-10, 0.05);
    o.series = selections::of({Series::y});
    for (std::size_t i = 0; i <= 50; ++i) o.sample_times.push_back(std::min(1e-3 * static_cast<double>(i), 0.05));
    auto const rigid = testing::run(best_isa(), o, {in});
    o.parts.rigid = false;
    in.point_stiffness = stiffness;
    auto const compliant = testing::run(best_isa(), o, {in});
    double most = 0;
    for (std::size_t i = 0; i <= 50; ++i) most = std::max(most, std::abs(compliant.series[i] - rigid.series[i]) / in.clearance_y);
    return most;
}

TEST(RigidPlanar, IsWhatStiffCornersComeToWhereImpactsStayApart) {
    auto const in = oracle::planar_check_inputs();
    double const soft = distance_of_compliant(in, 1e9), stiff = distance_of_compliant(in, 1e12);
    // A Hertz impact lasts as stiffness^(-2/5).
    EXPECT_NEAR(std::log10(soft / stiff), 0.4 * 3, 0.05) << soft << " " << stiff;
    EXPECT_LT(stiff, 0.01);
}

}  // namespace
}  // namespace slideway::rigid_planar_test
