#pragma once

#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// When `method = "auto"` changes a member between the explicit pair and the stiff method.  With Ω the rate of the stiffest motion
/// (Ω² the trace of M⁻¹K of the touching contacts), an explicit method is held up where hΩ stays near its limit of stability;
/// an impact is over before `stiff_looks` looks.  Factors of two either way change the work by less than 15 %.
struct Stiffness {
    static constexpr double stiff_above = 0.9;  // hΩ of the explicit pair
    static constexpr double lasting_above = 0.1;  // hΩ from which a look in contact counts a little
    static constexpr double lasting_share = 1.0 / 16;
    static constexpr double stiff_looks = 3.0;  // one look a stint
    // A corner that rattles on its face changes Ω tenfold from step to step: the largest of late counts.
    static constexpr double look_memory = 0.5, step_memory = 0.5;
    static constexpr double calm_below = 0.25;  // hΩ of the stiff method
    static constexpr double calm_steps = 6.0;
};

}  // namespace slideway::inline SLIDEWAY_ISA
