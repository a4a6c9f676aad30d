// Isolated impacts with the restitution damping (model.md 4): the speed comes back times e, whatever the law and speed.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "kernels/laws/list.hpp"
#include "kernels/mechanisms/list.hpp"
#include "kernels/members/complete_inputs.hpp"
#include "tests/support/ensemble.hpp"

namespace slideway::restitution_test {
namespace {

/// A slider without weight flies flat at the lower wall of a resting mechanism.  @return speed after over before.
double returned(Law law, double e, double speed, double exponent, Mechanism mechanism = Mechanism::slider_crank) {
    Inputs in;
    in.crank_speed = 0;
    in.gravity = 0;
    in.restitution = e;
    in.hertz_exponent = exponent;
    in.clearance_y = in.clearance_z = 1e-3;
    in.y = -0.9e-3;
    in.vy = -speed;
    testing::RunOptions options;
    options.parts = {law, Damping::restitution, false, false, mechanism};
    options.settings.rtol = options.settings.atol = 1e-8;
    options.settings.end_time = 6e-4 / speed;
    options.settings.max_step = options.settings.end_time / 100;
    auto const r = testing::run(best_isa(), options, {complete_inputs(in)});
    EXPECT_EQ(r.records[0].status, Status::finished);
    EXPECT_EQ(r.value(0, Quantity::contact_onsets), 1);
    // The planar one's crank is held level, so that its block moves with its rod.
    bool const planar = mechanism == Mechanism::planar_slider_crank;
    double const rebound = planar ? in.rod_length * std::cos(r.states[0][1]) * r.states[0][4] : r.states[0][2];
    return rebound / speed;
}

TEST(Restitution, IsolatedImpactsReturnTheCoefficient) {
    for (double const e : {0.2, 0.4, 0.6, 0.8, 0.95, 1.0}) {
        for (double const speed : {1e-3, 0.03, 1.0}) {
            for (double const exponent : {1.0, 1.3, 1.5}) {
                EXPECT_NEAR(returned(Law::conservative, e, speed, exponent), e, 1e-4 * e)
                    << "e " << e << " speed " << speed << " exponent " << exponent;
            }
            // A flat impact keeps the paper's law in one mode.
            EXPECT_NEAR(returned(Law::paper, e, speed, 1.5), e, 1e-4 * e) << "paper, e " << e << " speed " << speed;
        }
    }
}

TEST(Restitution, DoesSoInEveryMechanism) {
    for (MechanismInfo const& one : mechanisms()) {
        if (one.driven_form != nullptr) continue;  // the same contacts
        auto const mechanism = static_cast<Mechanism>(&one - mechanisms().data());
        for (double const e : {0.2, 0.4, 0.6, 0.8, 0.95}) {
            for (double const speed : {1e-3, 0.03, 1.0}) {
                for (double const exponent : {1.0, 1.3, 1.5}) {
                    EXPECT_NEAR(returned(Law::conservative, e, speed, exponent, mechanism), e, 1e-3 * e)
                        << info(mechanism).name << " e " << e << " speed " << speed << " exponent " << exponent;
                }
            }
        }
    }
}

TEST(Restitution, LosesTheEnergyOfTheImpact) {
    Inputs in;
    in.crank_speed = 0;
    in.gravity = 0;
    in.restitution = 0.5;
    in.clearance_y = in.clearance_z = 1e-3;
    in.y = -0.9e-3;
    in.vy = -0.1;
    testing::RunOptions options;
    options.parts = {Law::conservative, Damping::restitution, false, false};
    options.settings.rtol = options.settings.atol = 1e-9;
    options.settings.end_time = 3e-3;
    in = complete_inputs(in);
    auto const r = testing::run(best_isa(), options, {in});
    // The rod turns about its crank end with y: half its mass matrix at B moves along.
    double const rod =
        in.rod_mass * in.rod_mass_center * in.rod_mass_center + in.rod_inertia / (in.rod_length * in.rod_length);
    double const kinetic = 0.5 * (in.slider_mass + rod) * in.vy * in.vy;
    EXPECT_NEAR(r.value(0, Quantity::damping_loss), 0.75 * kinetic, 1e-3 * kinetic);
    EXPECT_NEAR(r.value(0, Quantity::energy_residual), 0, 1e-6 * kinetic);
}

}  // namespace
}  // namespace slideway::restitution_test
