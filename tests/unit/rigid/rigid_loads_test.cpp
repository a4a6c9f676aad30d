// Loads of the apices of a rigid slider that lies on its way (model.md 13, M13.10, M13.13): statics.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "kernels/mechanisms/list.hpp"
#include "kernels/members/complete_inputs.hpp"
#include "tests/support/rigid_free_slider.hpp"

namespace slideway::rigid_loads_test {
namespace {

using Loads = std::array<double, 4>;  // front +, front −, rear −, rear + across the face

/// A slider with all four apices of its upper face on the way, without inclination.
struct LyingSlider {
    Inputs in;
    RigidFreeSlider model;
    std::array<double, 12> state{};
    RigidJointMemory<double> memory;

    explicit LyingSlider(double friction) : in(inputs(friction)), model(parts(friction)) {
        state[0] = -in.clearance_y;
        start_memory(memory);
        memory.held[0] = {1, 1, 1, 1};
        memory.begun = 1;
    }
    static Inputs inputs(double friction) {
        Inputs in;
        in.friction_static = in.friction_kinetic = friction;
        return complete_inputs(in);
    }
    static Parts parts(double friction) {
        Parts p;
        p.mechanism = Mechanism::free_slider;
        p.friction = friction > 0;
        p.rigid = true;
        return p;
    }
    [[nodiscard]] double weight() const { return in.slider_mass * in.gravity; }

    [[nodiscard]] Loads loads() const {
        std::array<double, 12> rates{};
        RigidSliderReport<double> report;
        auto const p = RigidFreeSlider::parameters(in);
        auto const faults = model.derivative<true>(0.0, state.data(), p, memory, rates.data(), &report);
        EXPECT_FALSE(faults.contact_domain);
        auto const& n = report.contact.normal_force[0];
        return {n.a, n.b, n.c, n.d};
    }
};

TEST(RigidLoads, OfASliderAtRestAreAQuarterOfItsWeight) {
    LyingSlider const slider(0);
    for (double const load : slider.loads()) EXPECT_NEAR(load, slider.weight() / 4, 1e-12 * slider.weight());
}

TEST(RigidLoads, OfOneThatSlidesBalanceTheMomentOfItsFriction) {
    LyingSlider slider(0.1);
    slider.state[11] = 0.3;  // along the way
    // Friction −μ m g acts on the face, h from the centre: (L/2) (front − rear) = −h μ m g.
    double const h = slider.in.way_width / 2 + slider.in.clearance_y;
    double const tips = h * 0.1 * slider.weight() / (2 * slider.in.slider_length);
    auto const loads = slider.loads();
    for (std::size_t i : {0u, 1u}) EXPECT_NEAR(loads[i], slider.weight() / 4 - tips, 1e-12 * slider.weight()) << i;
    for (std::size_t i : {2u, 3u}) EXPECT_NEAR(loads[i], slider.weight() / 4 + tips, 1e-12 * slider.weight()) << i;
}

TEST(RigidLoads, VaryLinearlyOverAFaceWhicheverWayItsApicesSlip) {
    LyingSlider slider(0.2);
    slider.state[11] = 0.05, slider.state[3] = -0.03, slider.state[8] = 2;  // along, across, turning on the face
    auto const loads = slider.loads();
    EXPECT_NEAR(loads[0] - loads[1] + loads[2] - loads[3], 0, 1e-12 * slider.weight());
    EXPECT_GT(*std::ranges::min_element(loads), 0);
    EXPECT_GT(*std::ranges::max_element(loads) - *std::ranges::min_element(loads), 0.05 * slider.weight());
}

TEST(RigidLoads, DoNotDependOnThoseBefore) {
    LyingSlider slider(0.2);
    slider.state[11] = 0.05, slider.state[8] = 2;
    auto const expected = slider.loads();
    double const weight = slider.weight();
    for (auto const& before : {Loads{weight, 0, 0, 0}, Loads{0, weight, 3 * weight, 0}, Loads{1e-3, 1e3, 1e-3, 1e3}}) {
        slider.memory.loads.normal[0] = {before[0], before[1], before[2], before[3]};
        auto const loads = slider.loads();
        for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(loads[i], expected[i], 1e-9 * weight) << i;
    }
}

TEST(RigidLoads, OfAWeightlessSliderAreNone) {
    LyingSlider slider(0);
    slider.in.gravity = 0;
    for (double const load : slider.loads()) EXPECT_EQ(load, 0);
}

}  // namespace
}  // namespace slideway::rigid_loads_test
