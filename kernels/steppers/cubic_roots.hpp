#pragma once

#include "kernels/mechanisms/event_info.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// A zero of a cubic on [0, 1]; θ = 2 where there is none.
template <class Real> struct CubicZero {
    Real theta;
    Real low, high;  // the monotone stretch that it lies in
    Real slope;      // of the cubic there
};

template <class Real> struct CubicZeros {
    CubicZero<Real> at[3];  // one for each monotone stretch, ascending
    Mask<Real> any;         // lanes with at least one
};

/// Lanes in which the cubic through the values and slopes at both ends may have a zero on [0, 1].  Without a change of sign only one
/// that first comes nearer and then leaves can.
template <class Real> SLIDEWAY_FN Mask<Real> may_cross(Real v0, Real s0, Real v1, Real s1) {
    Real const zero(0.0);
    auto const changes = ((v0 >= zero) & (v1 < zero)) | ((v0 < zero) & (v1 >= zero));
    return changes | ((v0 * s0 < zero) & (v1 * s1 > zero));
}

/// Zeros on [0, 1] of the cubic through the values and slopes at both ends, those that it crosses in the direction asked for.
/// Between its extrema the cubic is monotone, so that no pair of zeros inside one step is missed.  A value of 0 counts as positive:
/// a zero at the end of one step is found in that step or in the next, and once.
/// @param candidate lanes that `may_cross`.
template <class Real>
SLIDEWAY_NOINLINE CubicZeros<Real> cubic_zeros(Mask<Real> candidate, Real v0, Real s0, Real v1, Real s1,
                                               Direction direction) {
    Real const zero(0.0), one(1.0), absent(2.0);
    CubicZeros<Real> found;
    for (auto& z : found.at) z = {absent, zero, one, one};
    found.any = mask_of<Real>(false);
    auto const starts_positive = v0 >= zero, ends_positive = v1 >= zero;
    // v0 + s0 θ + a θ² + b θ³, extrema at s0 + 2aθ + 3bθ² = 0.
    Real const change = v1 - v0;
    Real const a = fms(Real(3.0), change, s0 + (s0 + s1)), b = fnma(Real(2.0), change, s0 + s1);
    auto const value = [&](Real theta) { return fma(theta, fma(theta, fma(theta, b, a), s0), v0); };
    auto const slope = [&](Real theta) { return fma(theta, fma(theta, Real(3.0) * b, a + a), s0); };
    Real const root = sqrt(max(fnma(Real(3.0) * b, s0, a * a), zero));
    Real const q = negated(a + select(a < zero, negated(root), root));
    auto const within = [&](Real theta) { return select((theta > zero) & (theta < one), theta, zero); };  // NaN too
    Real const e1 = within(q / (Real(3.0) * b)), e2 = within(s0 / q);
    Real const ends[4] = {zero, min(e1, e2), max(e1, e2), one};
    Mask<Real> positive[4] = {starts_positive, value(ends[1]) >= zero, value(ends[2]) >= zero, ends_positive};
    positive[1] = (positive[1] & (ends[1] > zero)) | (starts_positive & !(ends[1] > zero));
    positive[2] = (positive[2] & (ends[2] > zero)) | (starts_positive & !(ends[2] > zero));
    for (int i = 0; i < 3; ++i) {
        auto const falls = positive[i] & (!positive[i + 1]), rises = (!positive[i]) & positive[i + 1];
        auto const crosses = candidate & (direction == Direction::falling  ? falls
                                          : direction == Direction::rising ? rises
                                                                           : falls | rises);
        if (none(crosses)) continue;
        Real low = ends[i], high = ends[i + 1];
        for (int halvings = 0; halvings < 24; ++halvings) {  // the dense output does the rest
            Real const middle = Real(0.5) * (low + high);
            auto const same = (value(middle) >= zero) & positive[i];
            auto const also = (!(value(middle) >= zero)) & (!positive[i]);
            low = select(same | also, middle, low);
            high = select(same | also, high, middle);
        }
        found.at[i] = {select(crosses, high, absent), ends[i], ends[i + 1], slope(high)};
        found.any = found.any | crosses;
    }
    return found;
}

}  // namespace slideway::inline SLIDEWAY_ISA
