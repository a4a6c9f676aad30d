// Binary logarithm and exponential to four digits in a third of the time of the exact ones: for the length of a step, which is an
// estimate anyway.  One sequence of operations, the same bits, for every `Real`.
#pragma once

#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// log₂ x of a positive, normal, finite number within 1.1e-4, continuous in x.  Anything else, NaN included, gives some finite number.
/// With x = 2^k (1 + f): k + f + f (1 − f) L(f).  Coefficients: scripts/fit_math.py rough_powers.
template <class Real> SLIDEWAY_FN Real rough_log2(Real x) {
    Real mantissa, exponent;
    split_exponent(x, mantissa, exponent);
    Real const f = mantissa - Real(1.0);
    Real const series = fma(f, fma(f, Real(0.08213063822012423), Real(-0.2390582154710477)), Real(0.43872575022831617));
    return fma(fnma(f, f, f), series, exponent + f);
}

/// 2^x within a part of 7.5e-5, for |x| ≤ 1000.  Coefficients: scripts/fit_math.py rough_powers.
template <class Real> SLIDEWAY_FN Real rough_exp2(Real x) {
    Real const k = round_even(x);
    Real const r = x - k;
    Real const high = fma(r, Real(0.055171658704734027), Real(0.24261112828826603));
    Real const low = fma(r, Real(0.6932609902013253), Real(0.9999280752441967));
    return fma(r * r, high, low) * power_of_two(k);
}

}  // namespace slideway::inline SLIDEWAY_ISA
