#pragma once

#include "kernels/mechanisms/carriage.hpp"
#include "kernels/rigid/rigid_slider.hpp"

namespace slideway::inline SLIDEWAY_ISA {

using RigidCarriage = RigidSlider<CarriageDrive>;

}  // namespace slideway::inline SLIDEWAY_ISA
