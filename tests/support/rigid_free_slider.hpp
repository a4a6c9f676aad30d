// A free slider with rigid contacts, of plain numbers.
#pragma once

#include "kernels/mechanisms/free_slider.hpp"
#include "kernels/rigid/rigid_slider.hpp"

// As of kernels: units of other instruction sets have another.
namespace slideway::inline SLIDEWAY_ISA {

struct RigidFreeSlider : RigidSlider<double, SliderBase> {
    explicit RigidFreeSlider(Parts const& parts) : RigidSlider(parts, &RigidGuide<NoDrive>::functions<double>) {}
    static void initial_state(Inputs const& in, double* state) { FreeSliderBase::initial_state(in, state); }
    static RigidSliderParameters<double> parameters(Inputs const& in) { return RigidGuide<NoDrive>::parameters(in); }
};

}  // namespace slideway::inline SLIDEWAY_ISA
