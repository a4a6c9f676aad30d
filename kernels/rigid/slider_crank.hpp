#pragma once

#include "kernels/mechanisms/slider_crank.hpp"
#include "kernels/rigid/rigid_slider.hpp"

namespace slideway::inline SLIDEWAY_ISA {

using RigidSliderCrank = RigidSlider<CrankAndRod>;

}  // namespace slideway::inline SLIDEWAY_ISA
