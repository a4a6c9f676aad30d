// A slider thrown up so that its arc peaks a hair past the upper face: it enters and leaves the face inside one long step, at whose
// ends nothing touches.
#include <gtest/gtest.h>

#include <utility>

#include "kernels/members/complete_inputs.hpp"
#include "tests/support/ensemble.hpp"

namespace slideway::graze_test {
namespace {

/// Flat over a crank at rest.
testing::EnsembleResult thrown(double speed, Damping damping, bool located, double max_step, Isa isa = best_isa()) {
    Inputs in;
    in.crank_speed = 0;
    in.clearance_y = in.clearance_z = 1e-3;
    in.restitution = 0.5;
    in.vy = speed;
    testing::RunOptions o;
    o.parts.damping = damping;
    o.settings.method = Method::dopri5;
    o.settings.end_time = 0.02;
    o.settings.max_step = max_step;
    o.settings.locate_modes = located;
    return testing::run(isa, o, {complete_inputs(in)});
}

constexpr double fine = 1e-5;
double const coarse = IntegratorSettings{}.max_step;

double onsets(testing::EnsembleResult const& r) { return r.value(0, Quantity::contact_onsets); }

/// The greatest speed that does not reach the face.
double grazing_speed() {
    double below = 0.1, above = 0.2;
    while (above - below > 1e-9) {
        double const middle = 0.5 * (below + above);
        (onsets(thrown(middle, Damping::point, false, fine)) > 0 ? above : below) = middle;
    }
    return below;
}

constexpr double excesses[] = {5e-6, 1e-5, 2e-5, 4e-5, 7e-5};  // [m/s]

TEST(Graze, IsFoundByLocatedModes) {
    double const grazing = grazing_speed();
    for (double const excess : excesses) {
        auto const truth = thrown(grazing + excess, Damping::point, false, fine);
        ASSERT_EQ(onsets(truth), 1) << excess;
        auto const got = thrown(grazing + excess, Damping::point, true, coarse);
        EXPECT_EQ(onsets(got), 1) << excess;
        double const force = truth.value(0, Quantity::peak_normal_force);
        EXPECT_GT(force, 50) << excess;
        EXPECT_NEAR(got.value(0, Quantity::peak_normal_force), force, 0.1 * force) << excess;
        EXPECT_NEAR(got.states[0][2], truth.states[0][2], 1e-5) << excess;
    }
    EXPECT_EQ(onsets(thrown(grazing - 1e-6, Damping::point, true, coarse)), 0);
}

TEST(Graze, IsFoundByTheTouchesOfRestitution) {
    double const grazing = grazing_speed();
    for (double const excess : excesses) {
        auto const truth = thrown(grazing + excess, Damping::restitution, false, fine);
        ASSERT_EQ(onsets(truth), 1) << excess;
        auto const got = thrown(grazing + excess, Damping::restitution, false, coarse);
        EXPECT_EQ(onsets(got), 1) << excess;
        EXPECT_NEAR(got.states[0][2], truth.states[0][2], 1e-5) << excess;
    }
    EXPECT_EQ(onsets(thrown(grazing - 1e-6, Damping::restitution, false, coarse)), 0);
}

TEST(Graze, IsTheSameOnEveryInstructionSet) {
    double const speed = grazing_speed() + 2e-5;
    for (auto const& [damping, located] : {std::pair{Damping::point, true}, {Damping::restitution, false}}) {
        auto const scalar = thrown(speed, damping, located, coarse, testing::supported_isas().front());
        for (Isa const isa : testing::supported_isas())
            EXPECT_EQ(thrown(speed, damping, located, coarse, isa).states, scalar.states);
    }
}

}  // namespace
}  // namespace slideway::graze_test
