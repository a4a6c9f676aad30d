// What follows an event of a rigid slider (model.md 13): impacts, ends of bounces and rests take energy.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/support/rigid_free_slider.hpp"
#include "tests/support/rigid_joint.hpp"

namespace slideway::rigid_settlement_test {
namespace {

using State = std::array<double, 12>;

/// A slider whose apices touch at random pairs, some of which last.
struct Event {
    Inputs in;
    State state{};
    RigidJointMemory<double> memory;
    std::array<bool, pair_count> touch{};

    Event(Inputs const& inputs, testing::UniformDraws& draw) : in(inputs) {
        RigidFreeSlider::initial_state(in, state.data());
        // So slow that bounces are about to end, while the slider moves along the way.
        double const slow = std::pow(10, draw(-8, -4));
        for (std::size_t i : {2u, 3u, 7u, 8u, 9u}) state[i] *= slow;
        state[11] = std::pow(10, draw(-8, 0));
        start_memory(memory);
        memory.begun = 1;
        double const likely = draw(0.05, 0.25);
        for (int i = 0; i < pair_count; ++i) {
            bool const touches = draw(0, 1) < likely;
            touch[static_cast<std::size_t>(i)] = touches;
            number_of(memory.held, i) = touches && draw(0, 1) < 0.5 ? 1 : 0;
        }
    }
    [[nodiscard]] long double kinetic_energy() const {
        Inputs weightless = in;
        weightless.gravity = 0;
        return testing::energy_of(weightless, testing::joint_state(state));
    }
    /// @return whether it was one
    bool happens() {
        RigidFreeSlider const model(testing::rigid_joint_parts(true));
        auto const p = RigidFreeSlider::parameters(in);
        RigidJointContact<double> contact;
        contact.clear(false);
        contact.loads.clear();
        model.see(0.0, state.data(), p, memory, contact);
        for (int i = 0; i < pair_count; ++i) {
            if (touch[static_cast<std::size_t>(i)]) number_of(contact.penetration, i) = number_of(contact.watched, i) = 0;
            number_of(contact.normal_force, i) = 1;
        }
        return model.settle(true, 0.0, 1.0, state.data(), p, memory, contact);
    }
};

TEST(RigidSettlement, MakesNoEnergyWhateverComesToRest) {
    testing::UniformDraws draw(7);
    int events = 0, rests = 0;
    for (Inputs const& in : testing::random_rigid_sliders(3000, 42, 0.3)) {
        Event event(in, draw);
        auto const before = event.kinetic_energy();
        if (!event.happens() || event.memory.jammed > 0) continue;
        auto const after = event.kinetic_energy();
        EXPECT_LE(after, before * (1 + 1e-12L)) << events;
        ++events;
        for (int i = 0; i < pair_count; ++i) rests += number_of(event.memory.held, i) > 0.5 ? 1 : 0;
    }
    EXPECT_GT(events, 2000);
    EXPECT_GT(rests, 4000);
}

}  // namespace
}  // namespace slideway::rigid_settlement_test
