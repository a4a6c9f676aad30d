#pragma once

#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// The cubic through the values and slopes (per step) at both ends of a step, at fraction θ of it.
template <class Real> SLIDEWAY_FN Real hermite(Real y0, Real slope0, Real y1, Real slope1, Real theta) {
    Real const rest = Real(1.0) - theta;
    Real const change = y1 - y0;
    Real const start = slope0 - change;
    Real const end = change - slope1 - start;
    return fma(theta, fma(rest, fma(theta, end, start), change), y0);
}

}  // namespace slideway::inline SLIDEWAY_ISA
