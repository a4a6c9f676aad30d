// The mechanisms of this tree, a row each, in the order of `Mechanism`.  `name` is what mechanism.kind says and names the header
// kernels/mechanisms/<name>.hpp; `Type` is the struct in it, and `Base` what the lanes that integrate it know: mechanisms of one base
// share their lanes.  CMake reads the rows too: a mechanism, and a base, is a unit of kernels per instruction set.
#pragma once

#include "kernels/inputs.hpp"

#define SLIDEWAY_MECHANISMS(row)                 \
    row(slider_crank, SliderCrank, SliderBase)   \
    row(carriage, Carriage, SliderBase)          \
    row(scotch_yoke, ScotchYoke, SliderBase)     \
    row(free_slider, FreeSlider, SliderBase) \
    row(planar_slider_crank, PlanarSliderCrank, PlanarBase) \
    row(slider_crank_motor, SliderCrankMotor, SliderBase) \
    row(scotch_yoke_motor, ScotchYokeMotor, SliderBase)

namespace slideway {

enum class Mechanism : int {
#define SLIDEWAY_NAME(name, Type, Base) name,
    SLIDEWAY_MECHANISMS(SLIDEWAY_NAME)
#undef SLIDEWAY_NAME
};

}  // namespace slideway
