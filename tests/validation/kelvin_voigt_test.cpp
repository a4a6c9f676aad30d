// Impacts of the linear law against their closed form: a free slider that meets its way flat is one mass on four springs and dampers.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "kernels/laws/list.hpp"
#include "kernels/mechanisms/list.hpp"
#include "kernels/members/complete_inputs.hpp"
#include "tests/support/ensemble.hpp"

namespace slideway::kelvin_voigt_test {
namespace {

constexpr double speed = 0.05, clearance = 1e-4;  // [m/s], [m]

/// It touches its lower face at t = 0, without weight.
Inputs touching(double stiffness, double damping) {
    Inputs in = with_presets({}, Law::kelvin_voigt);
    in.law_a = stiffness, in.law_b = damping;
    in.gravity = 0;
    in.clearance_y = in.clearance_z = clearance;
    in.y = -clearance, in.vy = -speed;
    return complete_inputs(in);
}

testing::EnsembleResult run(Inputs const& in, std::vector<double> const& times) {
    testing::RunOptions o;
    o.parts = {Law::kelvin_voigt, Damping::point, false, false, Mechanism::free_slider};
    o.settings.method = Method::dopri5;
    o.settings.rtol = o.settings.atol = 1e-11;
    o.settings.end_time = times.back();
    o.series = info(Mechanism::free_slider).always;
    o.sample_times = times;
    auto r = testing::run(best_isa(), o, {in});
    EXPECT_EQ(r.records[0].status, Status::finished);
    return r;
}

TEST(KelvinVoigtImpact, IsHalfAPeriodOfALinearOscillator) {
    // M y'' = −4 k y: in contact for π √(M/4k), and back at the speed of the impact.
    for (double const stiffness : {1e5, 1e6, 1e8}) {
        Inputs const in = touching(stiffness, 0);
        double const rate = std::sqrt(4 * stiffness / in.slider_mass), contact = std::numbers::pi / rate;
        std::vector<double> times;
        for (int i = 0; i <= 20; ++i) times.push_back(contact * i / 16);  // four of them after it
        auto const r = run(in, times);
        std::size_t const count = times.size(), y = count * static_cast<std::size_t>(Series::y),
                          vy = count * static_cast<std::size_t>(Series::vy);
        double const amplitude = speed / rate;
        for (std::size_t i = 0; i < 16; ++i) {
            EXPECT_NEAR(r.series[y + i] + clearance, -amplitude * std::sin(rate * times[i]), 1e-6 * amplitude) << stiffness << ' ' << i;
            EXPECT_NEAR(r.series[vy + i], -speed * std::cos(rate * times[i]), 1e-6 * speed) << stiffness << ' ' << i;
        }
        double const returned = r.series[vy + count - 1];
        EXPECT_NEAR(returned, speed, 1e-6 * speed) << stiffness;
        // Since it left its way it flies at that speed.
        double const left = times.back() - (r.series[y + count - 1] + clearance) / returned;
        EXPECT_NEAR(left, contact, 1e-6 * contact) << stiffness;
        EXPECT_NEAR(r.value(0, Quantity::peak_normal_force), 4 * stiffness * amplitude, 1e-3 * 4 * stiffness * amplitude);
        EXPECT_NEAR(r.value(0, Quantity::energy_change), 0, 1e-8 * in.slider_mass * speed * speed);
    }
}

TEST(KelvinVoigtImpact, OfAFaceIsAsStiffAsItsSurfaceWhereNothingIsGiven) {
    Inputs const in = touching(follows, 0);
    double const surface = in.slider_young_modulus * in.slider_length * in.way_depth / in.thickness_y;
    double const contact = std::numbers::pi * std::sqrt(in.slider_mass / surface);
    auto const r = run(in, {0, 1.25 * contact});
    double const y = r.states[0][0], vy = r.states[0][2];
    EXPECT_NEAR(vy, speed, 1e-6 * speed);
    EXPECT_NEAR(1.25 * contact - (y + clearance) / vy, contact, 1e-6 * contact);
}

TEST(KelvinVoigtImpact, ThatIsDampedNeverPulls) {
    // It ends where the force does, before the depth: with β = 4c/2M, Ω² = ω² − β² its speed returns times
    // exp(−β/Ω (π − atan2(2βΩ, Ω² − β²))), the angle in [0, π].  Source: Schwager & Pöschel, Granular Matter 9 (2007) 465.
    for (double const ratio : {0.02, 0.1, 0.3, 0.6, 0.8}) {  // β/ω
        double const stiffness = 1e6;
        Inputs in = touching(stiffness, 0);
        double const rate = std::sqrt(4 * stiffness / in.slider_mass), decay = ratio * rate;
        in.law_b = decay * in.slider_mass / 2;
        double const damped = std::sqrt(rate * rate - decay * decay);
        double const angle = std::numbers::pi - std::atan2(2 * decay * damped, damped * damped - decay * decay);
        double const returned = std::exp(-decay / damped * angle);
        auto const r = run(in, {0, 3 * std::numbers::pi / rate});
        EXPECT_NEAR(r.states[0][2], returned * speed, 1e-6 * speed) << ratio;
        double const kinetic = in.slider_mass * speed * speed / 2;
        EXPECT_NEAR(r.value(0, Quantity::damping_loss), kinetic * (1 - returned * returned), 1e-6 * kinetic) << ratio;
        EXPECT_NEAR(r.value(0, Quantity::energy_residual), 0, 1e-6 * kinetic) << ratio;
    }
}

/// Steps of a fixed length end at no touch: contacts are seen as they are.
TEST(KelvinVoigtImpact, IsThatOfFixedStepsToo) {
    Inputs const in = touching(1e6, 0);
    testing::RunOptions o;
    o.parts = {Law::kelvin_voigt, Damping::point, false, false, Mechanism::free_slider};
    o.settings.method = Method::rk4;
    o.settings.fixed_step = 1e-6;
    o.settings.end_time = 3e-3;
    auto const r = testing::run(best_isa(), o, {in});
    EXPECT_EQ(r.records[0].status, Status::finished);
    EXPECT_NEAR(r.states[0][static_cast<std::size_t>(Series::vy)], speed, 1e-3 * speed);
    EXPECT_LT(std::abs(r.value(0, Quantity::energy_residual)), 1e-3 * in.slider_mass * speed * speed);
}

/// The force of the damper jumps at each touch: steps end there, or would become shorter without end the tighter their tolerance.
TEST(KelvinVoigtImpact, WithADamperIsFinishedAtEveryTolerance) {
    for (double const damping : {0.0, 1e4, 1e5, 1e6}) {
        Inputs in = with_presets({}, Law::kelvin_voigt);
        in.law_b = damping;
        in.crank_speed = 10;
        in.clearance_y = in.clearance_z = clearance;
        in.y = 3e-5, in.pitch = 5e-4, in.yaw = -3e-4, in.roll = 4e-4;
        testing::RunOptions o;
        o.parts = {Law::kelvin_voigt, Damping::point, true, false, Mechanism::slider_crank};
        o.settings.end_time = 0.03;
        for (double const tolerance : {1e-6, 1e-8, 1e-10}) {
            o.settings.rtol = o.settings.atol = tolerance;
            auto const r = testing::run(best_isa(), o, {complete_inputs(in)});
            ASSERT_EQ(r.records[0].status, Status::finished) << damping << ' ' << tolerance;
            EXPECT_LT(std::abs(r.value(0, Quantity::energy_residual)), 1e-2 * tolerance) << damping;
            EXPECT_GE(r.value(0, Quantity::contact_onsets), 1) << damping;
        }
    }
}

}  // namespace
}  // namespace slideway::kelvin_voigt_test
