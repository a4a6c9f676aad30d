// The mechanisms whose slider and way may be rigid (contact.law = "rigid"), a row each.  `name` is a row of kernels/mechanisms/list.hpp and names the header
// kernels/rigid/<name>.hpp; `Type` is the struct in it.  CMake reads the rows too: each is a unit of kernels per instruction set, and one more where members may have shadows.
#pragma once

#define SLIDEWAY_RIGID(row)                        \
    row(slider_crank, RigidSliderCrank, Shadowed)  \
    row(carriage, RigidCarriage, Shadowed)         \
    row(scotch_yoke, RigidScotchYoke, Shadowed)    \
    row(free_slider, RigidFreeSlider)              \
    row(planar_slider_crank, RigidPlanarSliderCrank, Shadowed)
