#pragma once

#include "kernels/math/polynomial.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// A quotient that its user may put into a division of his own.
template <class Real> struct Ratio {
    Real numerator, denominator;
    SLIDEWAY_FN Real value() const { return numerator / denominator; }
};

/// w = −W₋₁(−exp(−1 − t)) to 3 units in the last place for 0 ≤ t ≤ 74 (the caller holds t there); w ≥ 1 is the root of
/// w − ln w = 1 + t.  NaN gives NaN.
/// Evaluated as w = t + M/D, where M/D = 1 + ln w is the small part and so are its rounding errors.  W₋₁ has a square
/// root at its branch point t = 0, of which s = √t is the natural variable.  Away from it w is smooth in t itself and
/// the square root is spared: it runs only where a lane has t < 7.  Coefficients: scripts/fit_math.py lambert_w.
template <class Real> SLIDEWAY_FN Ratio<Real> minus_lambert_wm1_exp(Real t) {
    Real m = polynomial(t, 1.30858417866407, 5.647338937973248, 5.03046030978929, 1.4873459884311757,
                        0.17530651778667877, 0.008851477533086701, 0.00019204375355673763, 1.6763830626315708e-06,
                        4.925659553149021e-09, 2.990110818727009e-12);
    Real d = polynomial(t, 1.0, 2.912419973634897, 1.946192956404746, 0.4580451421692446, 0.04455439097940806,
                        0.0018972731428879928, 3.508781309294057e-05, 2.6085943991154975e-07, 6.402486279007788e-10,
                        3.007254010957873e-13);
    auto const near_branch = t < Real(7.0);
    if (any(near_branch)) {
        Real const s = sqrt(t);
        Real const near_m =
            polynomial(s, 1.0, 2.8021140903450505, 2.5022665098516743, 1.1547314243352906, 0.2945044389326992,
                       0.039914174867445, 0.0022399404875432, 2.9691756114078366e-05);
        Real const near_d =
            polynomial(s, 1.0, 1.3879005279719565, 0.8728120933022446, 0.3044548137768289, 0.060648727520966186,
                       0.006306297685873502, 0.0002603438399835066, 2.29323351480562e-06);
        m = select(near_branch, near_m, m);
        d = select(near_branch, near_d, d);
    }
    return {fma(t, d, m), d};
}

}  // namespace slideway::inline SLIDEWAY_ISA
