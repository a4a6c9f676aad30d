// A slider that is pressed into its way: clearances below 0 (model.md 16).
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/support/loaded_member.hpp"

namespace slideway::preload_test {
namespace {

using testing::Loaded;
using testing::options;
using testing::run;
using testing::RunOptions;

constexpr double press = 4e-6, stiffness = 1e6, damping = 300;  // [m], of an apex [N/m] and [N s/m]

/// At rest in the middle, both faces pressed, all apices springs.
Loaded pressed() {
    Loaded l{{}, {}};
    l.in.clearance_y = -press, l.in.clearance_z = 1e-4;
    l.in.gravity = 0;
    l.in.law_a = stiffness, l.in.law_b = damping;
    return l;
}
RunOptions spring_options(Loaded const& l, Mechanism mechanism, double seconds, double tolerance = 1e-11) {
    auto o = options(l, mechanism, seconds, tolerance);
    o.parts.law = Law::kelvin_voigt;
    return o;
}

TEST(Preload, HoldsASliderFromBothSidesUntilItLiftsOff) {
    // 8 k in contact above and below; 4 k where it has left the upper face, 4 k (y + p) = F.
    for (double const force : {16.0, 31.0, 48.0}) {
        Loaded l = pressed();
        l.loads.emplace_back();
        l.put(l.loads[0].force, {0, -force, 0});
        auto const r = run(l, spring_options(l, Mechanism::free_slider, 0.2));
        double const held = force / (8 * stiffness), lifted = force / (4 * stiffness) - press, depth = held < press ? held : lifted;
        EXPECT_NEAR(r.states[0][0], -depth, 1e-10 * press) << force;
    }
}

TEST(Preload, RubsOnBothSides) {
    // A free slider is braked by μ N of both faces, N = 4 k p each, though nothing weighs on it.
    Loaded l = pressed();
    l.in.vx = 1, l.in.friction_static = l.in.friction_kinetic = 0.1;
    auto o = spring_options(l, Mechanism::free_slider, 0.02, 1e-10);
    o.parts.friction = true;
    auto const r = run(l, o);
    double const brake = 0.1 * 2 * 4 * stiffness * press / complete_inputs(l.in).slider_mass;
    EXPECT_NEAR(r.states[0][11], 1 - brake * 0.02, 1e-7);
    EXPECT_NEAR(r.value(0, Quantity::energy_residual), 0, 1e-10);
}

TEST(Preload, SwingsOnBothFaces) {
    Loaded l = pressed();
    l.in.law_b = 0, l.in.y = 0.5 * press;
    double const omega = std::sqrt(8 * stiffness / complete_inputs(l.in).slider_mass), t = 7.3 / omega;
    auto const r = run(l, spring_options(l, Mechanism::free_slider, t, 1e-13));
    EXPECT_NEAR(r.states[0][0], 0.5 * press * std::cos(7.3), 1e-10 * press);
}

/// What scatters about a fit passes from clearance to preload, and each member has its audit.
TEST(Preload, DrivesTheAuditOfEveryMechanismToRounding) {
    for (Mechanism const mechanism : {Mechanism::slider_crank, Mechanism::scotch_yoke, Mechanism::carriage, Mechanism::free_slider}) {
        for (Law const law : {Law::conservative, Law::kelvin_voigt, Law::foundation}) {
            SCOPED_TRACE(std::string(info(mechanism).name) + " " + std::to_string(static_cast<int>(law)));
            Loaded l{{}, {}};
            l.in.crank_speed = 40, l.in.law_a = 1e8, l.in.law_b = 300, l.in.vy = 1e-3;
            if (mechanism == Mechanism::free_slider) l.in.vx = 0.2;
            auto o = options(l, mechanism, 0.01, 1e-6);
            o.parts.law = law, o.parts.friction = true;
            std::vector<Inputs> members;
            for (double const clearance : {-1e-6, -2e-7, 0.0, 2e-7}) {
                Inputs in = l.in;
                in.clearance_y = in.clearance_z = clearance;
                members.push_back(complete_inputs(in, info(mechanism)));
            }
            auto const r = testing::run(best_isa(), o, members);
            for (std::size_t i = 0; i < members.size(); ++i) {
                EXPECT_EQ(r.records[i].status, Status::finished) << i;
                double const work = std::abs(r.value(i, Quantity::drive_work)) + r.value(i, Quantity::friction_loss) + std::abs(r.value(i, Quantity::energy_change));
                EXPECT_LT(std::abs(r.value(i, Quantity::energy_residual)), 200 * 1e-6 * work + 1e-12) << i << ' ' << work;
            }
            EXPECT_GT(r.value(0, Quantity::friction_loss), r.value(3, Quantity::friction_loss)) << "what is pressed rubs more";
        }
    }
}

}  // namespace
}  // namespace slideway::preload_test
