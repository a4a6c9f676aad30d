// `auto` in lasting contact: when it turns to the stiff method and back, what that saves, and that the slider rests as statics says.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "kernels/laws/list.hpp"
#include "kernels/members/complete_inputs.hpp"
#include "tests/support/ensemble.hpp"

namespace slideway::stiff_test {
namespace {

using std::numbers::pi;

testing::RunOptions options_of(Method method, double tolerance, double end_time) {
    testing::RunOptions o;
    o.parts = {Law::conservative, Damping::rate, true, false};
    o.settings.method = method;
    o.settings.rtol = o.settings.atol = tolerance;
    o.settings.end_time = end_time;
    o.settings.max_steps = 20'000'000;
    return o;
}

/// The settling problem: 0.1 mm, χ = 10, half a turn a second; within 0.1 s the members lie down on the way.
std::vector<Inputs> settling_members(std::size_t count) {
    auto members = testing::scattered_starts(count, 1e-4, pi);
    for (auto& in : members) in.chi_line = in.chi_surface = 10;
    return members;
}

/// Lies flat on the lower face, pressed in by `depth`.
Inputs lying(double depth, double crank_speed) {
    Inputs in;
    in.crank_speed = crank_speed;
    in.chi_line = in.chi_surface = 10;
    in = complete_inputs(in);
    in.y = -in.clearance_y - depth;
    return in;
}

double residual_p95(testing::EnsembleResult const& r) {
    std::vector<double> sizes;
    for (std::size_t i = 0; i < r.records.size(); ++i) sizes.push_back(std::abs(r.value(i, Quantity::energy_residual)));
    std::sort(sizes.begin(), sizes.end());
    return sizes[sizes.size() * 95 / 100];
}

double evaluations_per_member(testing::EnsembleResult const& r) {
    double sum = 0;
    for (auto const& record : r.records) {
        EXPECT_EQ(record.status, Status::finished);
        sum += static_cast<double>(record.rhs_evaluations + record.jacobian_evaluations);
    }
    return sum / static_cast<double>(r.records.size());
}

TEST(AutoMethod, TurnsStiffWhereTheSliderLiesDown) {
    // The default tolerance among them: no member may stay with the explicit pair for good, nor be held by a corner that rattles on its
    // face at amplitudes that only the tolerance sees.
    auto const members = settling_members(64);
    struct {
        double tolerance, most;
    } const runs[] = {{1e-4, 2.5}, {1e-6, 3.5}, {1e-7, 3.5}};
    for (auto const& [tolerance, most] : runs) {
        auto const r = testing::run(best_isa(), options_of(Method::automatic, tolerance, 0.3), members);
        double const mean = evaluations_per_member(r);
        for (std::size_t i = 0; i < members.size(); ++i) {
            EXPECT_GT(r.records[i].stiff_steps, 20u) << "member " << i << " at " << tolerance;
            EXPECT_LT(static_cast<double>(r.records[i].rhs_evaluations), most * mean)
                << "member " << i << " at " << tolerance;
        }
    }
}

TEST(AutoMethod, TurnsStiffForStrongDampingAndSteepFrictionToo) {
    // Both limit an explicit step far below what the contacts' stiffness does.
    auto damped = settling_members(8);
    for (auto& in : damped) in.chi_line = in.chi_surface = 1e6;
    auto steep = settling_members(8);
    for (auto& in : steep) {
        in.crank_speed = 0;
        in.friction_stick_speed = 1e-7;
        in.friction_slip_speed = 1e-2;
    }
    for (auto const& members : {damped, steep}) {
        auto const alone = testing::run(best_isa(), options_of(Method::ros34pw2, 1e-6, 0.1), members);
        auto const r = testing::run(best_isa(), options_of(Method::automatic, 1e-6, 0.1), members);
        EXPECT_LT(evaluations_per_member(r), 4 * evaluations_per_member(alone));
    }
}

TEST(AutoMethod, SavesMostOfTheWorkAtTheSameEnergyResidual) {
    // A full turn saves 60 times and more (slow/stiff_turn_test.cpp); here four fifths of 0.4 s are settled.
    auto const members = settling_members(16);
    auto const pair = testing::run(best_isa(), options_of(Method::dopri5, 1e-3, 0.4), members);
    auto const best = testing::run(best_isa(), options_of(Method::automatic, 1e-3, 0.4), members);
    EXPECT_LE(residual_p95(best), 1.2 * residual_p95(pair));
    EXPECT_GE(evaluations_per_member(pair), 10 * evaluations_per_member(best));
}

TEST(AutoMethod, ResidualFallsWithTheToleranceWhereASliderGlides) {
    // At speed friction is what energy goes to, and the stiff method must follow the slow motion that it depends on.
    auto members = testing::scattered_starts(32, 1e-4, 47.0);
    for (auto& in : members) {
        in.chi_line = in.chi_surface = 10;
        in.y = -in.clearance_y - 2e-10;
        in.roll = in.yaw = in.pitch = 0;
    }
    double const turn = 2 * pi / 47;
    struct {
        double tolerance, most;  // of W = 0.08 J
    } const runs[] = {{1e-3, 3e-4}, {1e-5, 4e-5}, {1e-7, 4e-6}};
    for (auto const& [tolerance, most] : runs) {
        auto o = options_of(Method::automatic, tolerance, turn);
        o.settings.max_step = turn / 2000;
        o.settings.stiff_max_step = turn / 200;
        auto const r = testing::run(best_isa(), o, members);
        double stiff_steps = 0;
        for (auto const& record : r.records) stiff_steps += static_cast<double>(record.stiff_steps);
        EXPECT_GT(stiff_steps, 100 * 32) << tolerance;
        EXPECT_LT(residual_p95(r), most) << tolerance;
    }
}

TEST(AutoMethod, ResidualFallsWithTheToleranceOnAPitchedWay) {
    // The crank moves what the slider rests on, which the linearisation of its contacts does not know.  Without ∂f/∂t the second run, a turn of
    // the crank, is unstable at 1e-3 and takes twenty-five times the work and more; without the way's bend it takes twice.
    auto settling = settling_members(16);
    for (auto& in : settling) in.way_pitch = 6e-5;
    auto gliding = testing::scattered_starts(4, 1e-4, pi, Law::kelvin_voigt);
    for (auto& in : gliding) in.way_pitch = 6e-5, in.law_b = 2000;
    struct {
        double tolerance, settling, gliding, work;  // [J], [J], right-hand sides
    } const runs[] = {{1e-3, 2e-5, 1e-4, 1.5e4}, {1e-5, 1e-7, 1e-6, 4e4}, {1e-6, 1e-7, 4e-7, 6e4}};
    for (auto const& [tolerance, settled, glided, work] : runs) {
        auto o = options_of(Method::automatic, tolerance, 0.1);
        o.settings.atol = 0.1 * tolerance;
        o.parts.misaligned_way = true;
        auto const short_run = testing::run(best_isa(), o, settling);
        evaluations_per_member(short_run);
        EXPECT_LT(residual_p95(short_run), settled) << tolerance;
        o.parts.law = Law::kelvin_voigt;
        o.parts.damping = Damping::point;
        o.settings.end_time = 2;
        auto const turn = testing::run(best_isa(), o, gliding);
        EXPECT_LT(residual_p95(turn), glided) << tolerance;
        EXPECT_LT(evaluations_per_member(turn), work) << tolerance;
    }
}

TEST(AutoMethod, ImpactsOfAGlidingSliderKeepTheirEnergy) {
    // Lies on the lower face and runs to and fro between the side faces, at 64 times c ω.
    std::vector<Inputs> members(16, lying(2e-10, pi));
    for (std::size_t i = 0; i < members.size(); ++i) {
        members[i].vz = 0.02;
        members[i].z = 1e-5 * static_cast<double>(i) - 8e-5;
    }
    double const energy = members[0].slider_mass * 0.02 * 0.02 / 2;
    for (double const tolerance : {1e-3, 1e-6}) {
        auto const r = testing::run(best_isa(), options_of(Method::automatic, tolerance, 0.3), members);
        for (std::size_t i = 0; i < members.size(); ++i) {
            EXPECT_GT(r.records[i].stiff_steps, 0u) << i;
            EXPECT_LT(std::abs(r.value(i, Quantity::energy_residual)), 0.05 * energy) << i << " at " << tolerance;
        }
    }
}

TEST(AutoMethod, NeverTurnsStiffInFlight) {
    auto const r = testing::run(best_isa(), options_of(Method::automatic, 1e-5, 2e-3), testing::scattered_starts(16));
    for (auto const& record : r.records) {
        EXPECT_EQ(record.stiff_steps, 0u);
        EXPECT_EQ(record.jacobian_evaluations, 0u) << "nobody touches, nobody looks";
    }
}

TEST(AutoMethod, NeverTurnsStiffWhileTheSliderBounces) {
    auto o = options_of(Method::automatic, 1e-6, 0.02);
    o.parts.damping = Damping::point;
    auto members = testing::scattered_starts(64, 1e-4, 20.0);
    for (auto& in : members) in.vy = -0.06, in.vz = 0.03;
    for (double const young : {1e8, 2.07e11}) {
        for (auto& in : members) in.slider_young_modulus = in.way_young_modulus = young;
        auto const r = testing::run(best_isa(), o, members);
        double onsets = 0;
        for (std::size_t i = 0; i < members.size(); ++i) {
            EXPECT_EQ(r.records[i].stiff_steps, 0u) << "member " << i << ", E = " << young;
            onsets += r.value(i, Quantity::contact_onsets);
        }
        EXPECT_GT(onsets, 100) << "the members must meet the way";
    }
}

TEST(AutoMethod, ComesBackWhenContactIsLost) {
    // Lies on the way until the fast crank lifts it.
    auto const r = testing::run(best_isa(), options_of(Method::automatic, 1e-5, 0.06), {lying(2e-10, 47.0)});
    auto const& record = r.records[0];
    EXPECT_EQ(record.status, Status::finished);
    EXPECT_GT(record.stiff_steps, 0u);
    EXPECT_GT(record.steps_accepted, record.stiff_steps + 20) << "flies with the explicit pair";
}

constexpr Selection normal_force = Selection(1) << static_cast<int>(Series::normal_force);

TEST(AutoMethod, RestsAsStaticsSaysAndAsTheExplicitPairDoes) {
    // The crank stands still along X: the lower face bears the slider and the rod's share at its end.
    for (double const young : {1e9, 2.07e11}) {
        auto in = lying(2e-10, 0.0);
        in.slider_young_modulus = in.way_young_modulus = young;
        double const weight = (in.slider_mass + in.rod_mass * in.rod_mass_center) * in.gravity;
        auto o = options_of(Method::automatic, 1e-6, 0.5);
        o.series = normal_force;
        o.sample_times = {0.4, 0.5};
        auto const r = testing::run(best_isa(), o, {in});
        EXPECT_EQ(r.records[0].status, Status::finished);
        EXPECT_GT(r.records[0].stiff_steps, 0u);
        for (double const force : r.series) EXPECT_NEAR(force, weight, 1e-3 * weight) << young;
        if (young > 1e10) continue;  // the pair takes a second of computing and more on steel
        auto const pair = testing::run(best_isa(), options_of(Method::dopri5, 1e-9, 0.3), {in});
        double const depth = -r.states[0][0] - in.clearance_y, want = -pair.states[0][0] - in.clearance_y;
        EXPECT_NEAR(depth, want, 1e-3 * want);
        EXPECT_GT(pair.records[0].steps_accepted, 5 * r.records[0].steps_accepted);
    }
}

TEST(AutoMethod, SamplesOfTheStiffPhaseAreThoseOfTheExplicitPair) {
    // Slides along with the crank; depth and load follow the rod's slow pull.
    auto in = lying(2e-10, pi);
    in.slider_young_modulus = in.way_young_modulus = 1e9;
    auto o = options_of(Method::automatic, 1e-6, 0.3);
    o.series = testing::state_selection | normal_force;
    o.sample_times = {0.0, 0.13, 0.17, 0.1700001, 0.234567, 0.3};
    auto const stiff = testing::run(best_isa(), o, {in});
    o.settings.method = Method::dopri5;
    o.settings.rtol = o.settings.atol = 1e-9;
    auto const pair = testing::run(best_isa(), o, {in});
    EXPECT_GT(stiff.records[0].stiff_steps, 0u);
    EXPECT_EQ(pair.records[0].stiff_steps, 0u);
    std::size_t const n = o.sample_times.size();
    for (std::size_t i = 0; i < n; ++i) {
        double const depth = -stiff.series[i] - in.clearance_y, want = -pair.series[i] - in.clearance_y;
        EXPECT_NEAR(depth, want, 0.01 * want) << o.sample_times[i];
        double const force = stiff.series[state_size * n + i], load = pair.series[state_size * n + i];
        EXPECT_NEAR(force, load, 0.01 * load) << o.sample_times[i];
    }
}

TEST(StiffMethod, SaysWhyAMemberCannotGoOn) {
    // Falls on an edge so blunt that a line contact has next to no domain; or starts beyond the rod's reach.
    auto blunt = testing::golden_start(1e-4, pi);
    blunt.edge_radius = 1e5;
    blunt.roll = blunt.yaw = 0;
    blunt.y = -0.9e-4;
    blunt.vy = -0.1;
    auto far = testing::golden_start(1e-4, pi);
    far.y = 1;
    for (Method const method : {Method::automatic, Method::dopri5, Method::bs32, Method::ros34pw2}) {
        auto const r = testing::run(best_isa(), options_of(method, 1e-4, 0.01), {blunt, far});
        EXPECT_EQ(r.records[0].status, Status::contact_domain) << name_of(method);
        EXPECT_GT(r.records[0].time, 0) << name_of(method);
        EXPECT_EQ(r.records[1].status, Status::geometry) << name_of(method);
        EXPECT_EQ(r.records[1].time, 0) << name_of(method);
    }
}

}  // namespace
}  // namespace slideway::stiff_test
