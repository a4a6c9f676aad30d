// Steps that end where the paper's law changes its mode: the stepper keeps its order through the jumps of the force.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "host/study/ensemble_plan.hpp"
#include "kernels/mechanisms/list.hpp"
#include "tests/support/ensemble.hpp"

namespace slideway::locate_modes_test {
namespace {

// Two to four impacts; later the orbits part too fast for states to be compared.
constexpr double horizon = 0.009;

testing::EnsembleResult run_switching(double tolerance, bool located, Isa isa = best_isa()) {
    testing::RunOptions o;
    o.parts.friction = true;
    o.settings.method = Method::dopri5;
    o.settings.rtol = o.settings.atol = tolerance;
    o.settings.end_time = horizon;
    o.settings.locate_modes = located;
    o.quantities = 0;
    return testing::run(isa, o, testing::scattered_starts(64));
}

/// Median over the members of the largest state error against the reference, in c, c·ω, 2c/L_k and 2c/L_k·ω.
double median_error(testing::EnsembleResult const& got, testing::EnsembleResult const& reference) {
    double const c = 1e-4, tilt = 5e-3, w = 3.14;
    std::array<double, state_size> const scale{c, c, c * w, c * w, tilt, tilt, tilt, tilt * w, tilt * w, tilt * w};
    std::vector<double> errors;
    for (std::size_t m = 0; m < got.states.size(); ++m) {
        double error = 0;
        for (std::size_t i = 0; i < state_size; ++i) {
            double const size = std::max(scale[i], std::abs(reference.states[m][i]));
            error = std::max(error, std::abs(got.states[m][i] - reference.states[m][i]) / size);
        }
        errors.push_back(error);
    }
    std::nth_element(errors.begin(), errors.begin() + 32, errors.end());
    return errors[32];
}

double evaluations(testing::EnsembleResult const& r) {
    double sum = 0;
    for (auto const& record : r.records) sum += static_cast<double>(record.rhs_evaluations);
    return sum;
}

TEST(LocatedModes, ComeToTheSameOrbitsAsStepsThatLeapOverTheJumps) {
    auto const located = run_switching(1e-12, true), leapt = run_switching(1e-12, false);
    EXPECT_LT(median_error(located, leapt), 1e-7);
}

TEST(LocatedModes, AreWorthATenthOfTheErrorAndSaveRightHandSides) {
    auto const reference = run_switching(1e-13, true);
    for (double const tolerance : {1e-5, 1e-6, 1e-7}) {
        auto const located = run_switching(tolerance, true), leapt = run_switching(tolerance, false);
        EXPECT_LT(median_error(located, reference), 0.25 * median_error(leapt, reference)) << tolerance;
        EXPECT_LT(evaluations(located), 0.9 * evaluations(leapt)) << tolerance;
    }
}

/// What an ensemble under the paper's law ends with, of which its scene says no more of the integration than this.
testing::EnsembleResult run_scene(std::string_view integrator) {
    Scene const scene = parse_scene(fmt::format(R"(schema = 1
[contact]
law = "paper"
[friction]
[integrator]
{}
[study]
members = 64
duration = "9 ms"
[study.vary]
"initial.y" = {{ dist = "unif", low = "-0.03 mm", high = "0.03 mm" }}
"initial.z" = {{ dist = "unif", low = "-0.03 mm", high = "0.03 mm" }}
"initial.vy" = {{ dist = "unif", low = -0.05, high = 0.05 }}
"initial.roll" = {{ dist = "unif", low = -1e-3, high = 1e-3 }}
"initial.yaw" = {{ dist = "unif", low = -1e-3, high = 1e-3 }}
"initial.pitch" = {{ dist = "unif", low = -1e-3, high = 1e-3 }}
)", integrator), "test.toml");
    EnsemblePlan const plan = ensemble_plan(scene, MemberSet(MemberRange{0, 64}), *cpu_backend(best_isa()), 1);
    testing::EnsembleResult result;
    result.states.resize(64);
    result.records.resize(64);
    auto const keep = [&](BlockResult const& block) {
        for (std::size_t i = 0; i < block.members.size(); ++i) {
            result.records[block.members[i]] = block.records[i];
            std::copy_n(block.final_states.data() + i * state_size, state_size, result.states[block.members[i]].data());
        }
    };
    EXPECT_EQ(run_ensemble(plan, cpu_backend(best_isa())->kernel(scene.parts, false), keep, StopRequest{}).failed(), 0u);
    return result;
}

TEST(LocatedModes, AreWhatEnsemblesHaveUnlessTheirScenesSayOtherwise) {
    auto const reference = run_scene("rtol = 1e-12"), usual = run_scene("rtol = 1e-6"), leapt = run_scene("rtol = 1e-6\nlocate_modes = false");
    EXPECT_LT(median_error(usual, reference), 0.5 * median_error(leapt, reference));
    EXPECT_LT(evaluations(usual), evaluations(leapt));
    EXPECT_EQ(usual.states, run_scene("rtol = 1e-6\nlocate_modes = true").states);
}

/// A slider that is pressed on its way and slides there does not ring for long: `auto` goes on with the stiff method, as it does where steps leap.
TEST(LocatedModes, LeaveLastingContactToTheStiffMethod) {
    auto const pressed = [](bool located) {
        testing::RunOptions o;
        o.parts = {Law::paper, Damping::rate, true, false};
        o.parts.mechanism = Mechanism::carriage;
        o.settings.method = Method::automatic;
        o.settings.locate_modes = located;
        o.settings.end_time = 0.1;
        o.settings.max_steps = 1'000'000;
        Inputs in;
        in.gravity = 9800, in.carriage_speed = 0.06;
        in.chi_surface = in.chi_line = 100;
        in.y = -in.clearance_y;
        return testing::run(best_isa(), o, {complete_inputs(in, info(Mechanism::carriage))}).records[0];
    };
    auto const located = pressed(true), leapt = pressed(false);
    EXPECT_EQ(located.status, Status::finished);
    EXPECT_GT(located.stiff_steps, located.steps_accepted / 2);
    EXPECT_LT(located.rhs_evaluations, 2 * leapt.rhs_evaluations);
}

TEST(LocatedModes, LetTheErrorFallAsTheOrderOfTheMethodSays) {
    // With step control error ~ tolerance^(1) and work ~ tolerance^(-1/5): the error falls with the fifth power of the work
    // beyond what the events cost, which does not grow.
    auto const reference = run_switching(1e-13, true);
    auto const coarse = run_switching(1e-7, true), fine = run_switching(1e-11, true);
    double const order = std::log(median_error(coarse, reference) / median_error(fine, reference)) /
                         std::log(evaluations(fine) / evaluations(coarse));
    EXPECT_GT(order, 4.5);
}

TEST(LocatedModes, MakeWhatThePotentialJumpsBy) {
    // The residual ε of the audit is Σ jumps of U at the switches (model.md 8), and nothing else: no friction, no way's pose can add to it.
    testing::RunOptions o;
    o.parts.friction = true;
    o.settings.rtol = o.settings.atol = 1e-9;
    o.settings.end_time = 0.05;
    o.settings.locate_modes = true;
    o.quantities = selection_of(Quantity::energy_residual) | selection_of(Quantity::switching_energy);
    auto const result = testing::run(best_isa(), o, testing::scattered_starts(128));
    double made = 0, apart = 0;
    for (std::size_t m = 0; m < result.records.size(); ++m) {
        double const residual = result.value(m, Quantity::energy_residual), jumps = result.value(m, Quantity::switching_energy);
        made += std::abs(residual);
        apart += std::abs(residual - jumps);
    }
    EXPECT_GT(made, 128 * 1e-4);
    EXPECT_LT(apart, 0.01 * made);
}

TEST(LocatedModes, AreTheSameOnEveryInstructionSet) {
    auto const scalar = run_switching(1e-8, true, testing::supported_isas().front());
    for (Isa const isa : testing::supported_isas()) EXPECT_EQ(run_switching(1e-8, true, isa).states, scalar.states);
}

}  // namespace
}  // namespace slideway::locate_modes_test
