#pragma once

#include "kernels/mechanisms/scotch_yoke.hpp"
#include "kernels/rigid/rigid_slider.hpp"

namespace slideway::inline SLIDEWAY_ISA {

using RigidScotchYoke = RigidSlider<ScotchYokeDrive>;

}  // namespace slideway::inline SLIDEWAY_ISA
