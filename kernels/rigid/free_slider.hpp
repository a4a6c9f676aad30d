#pragma once

#include "kernels/mechanisms/free_slider.hpp"
#include "kernels/rigid/rigid_slider.hpp"

namespace slideway::inline SLIDEWAY_ISA {

using RigidFreeSlider = RigidSlider<NoDrive>;

}  // namespace slideway::inline SLIDEWAY_ISA
