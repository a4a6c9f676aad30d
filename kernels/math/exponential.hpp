#pragma once

#include "kernels/math/logarithm.hpp"
#include "kernels/math/polynomial.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

namespace detail {

/// exp(head + tail), |tail| small against 1; head is held within ±708 (NaN stays NaN).
/// With k the nearest integer to head/ln 2 and r the rest, exp = 2^k (1 + r + r² E(r)).  Coefficients:
/// scripts/fit_math.py exponential.
template <class Real> SLIDEWAY_FN Real exp_of_sum(Real head, Real tail) {
    head = min(Real(708.0), max(Real(-708.0), head));  // in this order the minimum hands a NaN on
    Real const k = round_even(head * Real(1.4426950408889634));
    Real const rest = fma(k, Real(-ln2_head), head);
    Real const rest_tail = fma(k, Real(-ln2_tail), tail);
    Real const r = rest + rest_tail;
    Real const r_tail = (rest - r) + rest_tail;
    Real const e = polynomial(r, 0.500000000000001, 0.16666666666666696, 0.04166666666653432, 0.008333333333309108,
                              0.0013888888942741146, 0.00019841269913897544, 2.4801493873863672e-05,
                              2.7557219007466193e-06, 2.7630009840944264e-07, 2.5117101344033938e-08);
    return (Real(1.0) + (r + fma(r * r, e, r_tail))) * power_of_two(k);
}

}  // namespace detail

/// e^x to 1 unit in the last place for |x| ≤ 708; beyond, the value at the nearer end.  NaN gives NaN.
SLIDEWAY_FN double exp(double x) { return detail::exp_of_sum(x, 0.0); }
#if defined(SLIDEWAY_SIMD)
// An overload for packs: xsimd's own exp would be found, and preferred to a template on Real.
template <class Arch> SLIDEWAY_FN Batch<Arch> exp(Batch<Arch> x) { return detail::exp_of_sum(x, Batch<Arch>(0.0)); }
#endif

/// x^y for a positive, normal, finite x and a finite y; |y ln x| is held within 708.  To 1 unit in the last place for
/// |y| ≤ 4, to 0.1 |y| units for larger |y|; without fused multiply-add to 0.8 |y ln x| units.  NaN gives NaN.
/// The logarithm is carried as head + tail, or its rounding would be multiplied by y ln x.
template <class Real> SLIDEWAY_FN Real power(Real x, Real y) {
    auto [k, f] = detail::split_for_logarithm(x);
    // k ln 2 + f and − f²/2 with their rounding errors; |k ln 2| > |f| > f²/2, or k = 0.
    Real const whole = k * Real(detail::ln2_head);
    Real const sum = whole + f;
    Real const sum_error = (whole - sum) + f;
    Real const half = Real(-0.5) * f;
    Real const square = half * f;
    Real const square_error = fms(half, f, square);
    Real const head = sum + square;
    Real const head_error = (sum - head) + square;
    Real const series = fma(f * f * f, detail::logarithm_series(f), fma(k, Real(detail::ln2_tail), square_error));
    Real const tail = (series + sum_error) + head_error;

    Real const log = head + tail;
    Real const log_tail = (head - log) + tail;
    Real const product = y * log + (x - x);  // the split loses a NaN
    return detail::exp_of_sum(product, fma(y, log_tail, fms(y, log, product)));
}

}  // namespace slideway::inline SLIDEWAY_ISA
