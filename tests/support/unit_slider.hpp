// A free slider of unit mass and inertia, at rest in the middle of its way, and how it answers to loads.
#pragma once

#include <array>

#include "kernels/members/complete_inputs.hpp"
#include "tests/support/rigid_free_slider.hpp"

namespace slideway::testing {

struct UnitSlider {
    RigidSliderParameters<double> p = RigidFreeSlider::parameters(inputs());
    std::array<double, 12> state{};
    Faults<double> faults = Faults<double>::none();
    NoDrive::At<double> guide{0.0, state.data(), p, DrivePlan{}, faults};
    JointPairs<double> at{guide.centre(p), guide.x, guide.vx, state.data(), p, false};

    static Inputs inputs() {
        Inputs in;
        in.slider_mass = in.slider_inertia_x = in.slider_inertia_y = in.slider_inertia_z = 1;
        return complete_inputs(in);
    }
};

}  // namespace slideway::testing
