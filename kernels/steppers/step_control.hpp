#pragma once

#include "kernels/math/rough_powers.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// The controller's memory at the start: log₂(1e-4²).
inline constexpr double step_control_start = -26.575424759098897;

/// Proportional–integral step control for a method whose local error falls with h^order.  Source: Hairer & Wanner, Solving Ordinary
/// Differential Equations II (1996), IV.2 (Gustafsson).  Works on the logarithm of the squared norm, so that one exponential and
/// one logarithm serve each attempt; four digits of them do, for the error is an estimate.
struct StepControl {
    static constexpr double safety = 0.9, shrink = 0.2, grow = 10.0;
    double integral, proportional;

    /// @param percent of the exponent 1/order that the former error has
    explicit constexpr SLIDEWAY_HD StepControl(int order, int percent = 20)
        : integral(percent / 100.0 / order), proportional(1.0 / order - 0.75 * integral) {}

    /// Factor for the next step, and the controller's memory: log₂ of the squared norm of the last accepted error.
    /// @param squared_norm mean square of error/tolerance; NaN or infinity shrinks the step most.
    /// @param after_rejection lanes whose last attempt failed: they do not grow at once.
    template <class Real>
    SLIDEWAY_FN Real factor(Real squared_norm, Mask<Real> accepted, Mask<Real> after_rejection, Real& memory) const {
        auto const finite = squared_norm < Real(1e300);
        Real const level = rough_log2(max(squared_norm, Real(1e-20)));
        Real const reaction = Real(-0.5 * proportional) * level;
        Real const exponent = select(accepted, fma(Real(0.5 * integral), memory, reaction), reaction);
        Real const wish = Real(safety) * rough_exp2(exponent);
        Real const ceiling = select(accepted & !after_rejection, Real(grow), Real(1.0));
        Real const factor = min(max(wish, Real(shrink)), ceiling);
        memory = select(accepted, max(level, Real(step_control_start)), memory);
        return select(finite, factor, Real(0.1));
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
