#pragma once

#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// When `method = "auto"` changes a member between the explicit pair and the stiff method.  With Ω the rate of the stiffest motion
/// (Ω² the trace of M⁻¹K of the touching contacts), an explicit method is held up where hΩ stays near its limit of stability;
/// an impact is over before `stiff_looks` looks.  Factors of two either way change the work by less than 15 %.
struct Stiffness {
    static constexpr double stiff_above = 0.9;  // hΩ of the explicit pair
    static constexpr double stiff_looks = 3.0;  // one look a stint
    static constexpr double calm_below = 0.25;  // hΩ of the stiff method
    static constexpr double calm_steps = 6.0;
};

}  // namespace slideway::inline SLIDEWAY_ISA
