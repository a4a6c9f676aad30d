#pragma once

#include "kernels/math/polynomial.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

namespace detail {

/// x = 2^exponent (1 + fraction), fraction in [√½ − 1, √2 − 1] and exact.
template <class Real> struct LogarithmSplit { Real exponent, fraction; };

template <class Real> SLIDEWAY_FN LogarithmSplit<Real> split_for_logarithm(Real x) {
    Real mantissa, exponent;
    split_exponent(x, mantissa, exponent);
    auto const large = mantissa > Real(1.4142135623730951);
    return {select(large, exponent + Real(1.0), exponent),
            fma(mantissa, select(large, Real(0.5), Real(1.0)), Real(-1.0))};
}

/// L of log(1 + f) = f − f²/2 + f³ L(f), 1 + f within a factor √2 of 1.  A dozen terms longer than the usual series in
/// f/(2 + f), which would need the divider, the scarcest unit of the kernels.  Coefficients: scripts/fit_math.py
/// logarithm.
template <class Real> SLIDEWAY_FN Real logarithm_series(Real f) {
    return polynomial(f, 0.33333333333333387, -0.24999999999999564, 0.19999999999963955, -0.16666666666777288,
                      0.1428571429199041, -0.124999999929636, 0.11111110616474035, -0.09999999941098221,
                      0.09090930237454697, -0.08333355774337604, 0.07691782122017342, -0.07141871926759552,
                      0.06674247447237991, -0.06270618243066715, 0.058252617061701116, -0.053260124280193576,
                      0.053807134936114796, -0.06256124404177246, 0.0576879963956183, -0.025021485586180465);
}

// ln 2 in two parts; the first has 42 bits, so that an exponent times it is exact.
inline constexpr double ln2_head = 0.6931471805598903;
inline constexpr double ln2_tail = 5.497923018708371e-14;

}  // namespace detail

/// Natural logarithm of a positive, normal, finite number, to 1 unit in the last place.  Anything else, NaN included,
/// gives some finite number.
template <class Real> SLIDEWAY_FN Real log_positive(Real x) {
    auto [k, f] = detail::split_for_logarithm(x);
    Real const correction = f * f * fma(f, detail::logarithm_series(f), Real(-0.5));
    return fma(k, Real(detail::ln2_head), f + fma(k, Real(detail::ln2_tail), correction));
}

}  // namespace slideway::inline SLIDEWAY_ISA
