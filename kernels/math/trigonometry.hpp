#pragma once

#include "kernels/math/polynomial.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

// Coefficients: scripts/fit_math.py trigonometry.

template <class Real> struct SinCos {
    Real sin, cos;
    Real versine;  // 1 − cos, without cancellation where the angle is small
};

namespace detail {

/// S of sin x = x + x³ S(x²), |x| ≤ π/4.
template <class Real> SLIDEWAY_FN Real sine_series(Real square) {
    return polynomial(square, -0.16666666666666638, 0.008333333333323784, -0.0001984126983071329,
                      2.7557313962441226e-06, -2.5050795613641417e-08, 1.5898757496845755e-10);
}

/// 1 − cos x = x²/2 + x⁴ C(x²), |x| ≤ π/4.
template <class Real> SLIDEWAY_FN Real versine_near(Real square) {
    Real const c = polynomial(square, -0.04166666666666665, 0.0013888888888882497, -2.4801587294706175e-05,
                              2.755731584974753e-07, -2.0875924385734314e-09, 1.1369909629338396e-11);
    return fma(square * square, c, Real(0.5) * square);
}

template <class Real> SLIDEWAY_FN Mask<Real> is_wide(Real x) { return abs(x) > Real(0.7853981633974483); }

/// |x| ≤ π/4.
template <class Real> SLIDEWAY_FN SinCos<Real> sine_and_cosine_near(Real x) {
    Real const square = x * x;
    Real const versine = versine_near(square);
    return {fma(square * x, sine_series(square), x), Real(1.0) - versine, versine};
}

/// Any x; within π/4 the bits of the function above.
template <class Real> SLIDEWAY_FN SinCos<Real> sine_and_cosine_reduced(Real x) {
    auto const wide = is_wide(x);
    // π/2 = 33 bits + 53 bits + 53 bits.  k times the first part is exact, and so is the difference from x; the tail
    // takes the rounding errors of the second product and difference.  A lane within π/4 has k = 0, r = x, no tail and
    // the bits of the short way.
    Real const nearest = round_even(x * Real(0.6366197723675814));
    Real const k = select(abs(x) < Real(1073741824.0), nearest, Real(not_a_number));
    Real const first = fma(k, Real(-1.5707963267341256), x);
    Real const second = k * Real(6.077100506506192e-11);
    Real const second_error = fms(k, Real(6.077100506506192e-11), second);
    Real const r = first - second;
    Real const tail = fma(k, Real(-3.5215598651832e-27), ((first - r) - second) - second_error);

    // sin(r + t) = sin r + t cos r and 1 − cos(r + t) = 1 − cos r + t sin r
    Real const square = r * r;
    Real const near_versine = versine_near(square);
    Real const cube = square * r;
    Real const series = sine_series(square);
    Real const near_sine = fma(cube, series, r);
    Real const sine = select(wide, r + fma(cube, series, fnma(tail, near_versine, tail)), near_sine);
    Real const versine = fma(tail, near_sine, near_versine);
    Real const cosine = Real(1.0) - versine;

    // k modulo 4 in {−2, …, 2}: odd quadrants swap sine and cosine; the sine is negative in −2, −1 and 2, the cosine in
    // −2, 1 and 2.
    Real const quadrant = fma(Real(-4.0), round_even(k * Real(0.25)), k);
    auto const swap = abs(quadrant) == Real(1.0);
    Real const sin_sign = select(abs(quadrant - Real(0.5)) > Real(1.0), Real(-1.0), Real(1.0));
    Real const cos_sign = select(abs(quadrant + Real(0.5)) > Real(1.0), Real(-1.0), Real(1.0));
    SinCos<Real> result;
    result.sin = sin_sign * select(swap, cosine, sine);
    result.cos = cos_sign * select(swap, sine, cosine);
    result.versine = select(quadrant == Real(0.0), versine, Real(1.0) - result.cos);
    return result;
}

template <class Real> SLIDEWAY_FN SinCos<Real> sine_and_cosine(Real x) {
    return none(is_wide(x)) ? sine_and_cosine_near(x) : sine_and_cosine_reduced(x);
}

}  // namespace detail

/// Sine and cosine of an angle [rad] to 1.3 units in the last place, 1 − cosine to 2, for |x| < 2^30; NaN beyond, for
/// infinity and for NaN.
/// A pack within π/4 takes polynomials alone; others are first reduced by multiples of π/2 after Cody and Waite (1980).
SLIDEWAY_FN SinCos<double> sincos(double x) { return detail::sine_and_cosine(x); }
#if defined(SLIDEWAY_SIMD)
// An overload for packs: xsimd's own sincos would be found, and preferred to a template on Real.
template <class Arch> SLIDEWAY_FN SinCos<Batch<Arch>> sincos(Batch<Arch> x) { return detail::sine_and_cosine(x); }
#endif

/// sin x for |x| ≤ π/2 [rad] to 2 units in the last place, a polynomial without cases; 1 at the double nearest to π/2.
/// Beyond, the polynomial goes on and leaves the sine.
template <class Real> SLIDEWAY_FN Real sin_quarter(Real x) {
    Real const square = x * x;
    // The series' first term by itself: it is large, and Estrin's powers would carry their errors into it.
    Real const s =
        fma(square,
            polynomial(square, 0.008333333333333219, -0.00019841269841217545, 2.75573192124693e-06,
                       -2.5052106987820503e-08, 1.6058945196506933e-10, -7.643127882360041e-13, 2.7225512927491773e-15),
            Real(-0.16666666666666666));
    return fma(square * x, s, x);
}

}  // namespace slideway::inline SLIDEWAY_ISA
