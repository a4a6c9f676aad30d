#pragma once

#include "kernels/block.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

using Direction = CrossingPlan::Direction;  // of zeros that count: rising from below zero, falling from above

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

/// Lanes in which the cubic through the values and slopes at both ends of [0, 1] may have a zero there.  None is missed: the cubic
/// lies within the span of its Bézier ordinates v0, v0 + s0/3, v1 − s1/3 and v1 (G. Farin, Curves and Surfaces for CAGD, 5th ed.,
/// 4.3), and without a change of sign among them it has none.
/// What starts at rest on zero and ends on the positive side has not crossed: the motion began inside the step, and the cubic, which
/// cannot know when, swings.
template <class Real> SLIDEWAY_FN Mask<Real> may_cross(Real v0, Real s0, Real v1, Real s1) {
    Real const third(1.0 / 3), zero(0.0);
    Real const c1 = fma(third, s0, v0), c2 = fnma(third, s1, v1);
    auto const below = min(min(v0, v1), min(c1, c2)) < zero, above = max(max(v0, v1), max(c1, c2)) >= zero;
    return (below & above) & !((max(abs(v0), abs(c1)) == zero) & (v1 >= zero));
}

namespace detail {

/// v0 + s0 θ + a θ² + b θ³ through the values and slopes at both ends of [0, 1].
template <class Real> struct EventCubic {
    Real v0, s0, a, b;

    SLIDEWAY_FN static EventCubic through(Real v0, Real s0, Real v1, Real s1) {
        Real const change = v1 - v0;
        return {v0, s0, fms(Real(3.0), change, s0 + (s0 + s1)), fnma(Real(2.0), change, s0 + s1)};
    }
    SLIDEWAY_FN Real value(Real theta) const { return fma(theta, fma(theta, fma(theta, b, a), s0), v0); }
    SLIDEWAY_FN Real slope(Real theta) const { return fma(theta, fma(theta, Real(3.0) * b, a + a), s0); }

    /// Its zero in a stretch where it is monotone and changes its sign, by Newton's method: from the inflection if that lies inside, else
    /// from the steeper end.  After at most one step too far it bends away from its tangents, and no step goes beyond the zero.
    /// A lane stops when its own steps are small beside θ, for after a reset bounces may be far shorter than a step: what is left is of
    /// the order of their square, at a double zero of their own.
    SLIDEWAY_FN Real zero_within(Real low, Real high, Mask<Real> wanted) const {
        Real const inflection = negated(a) / (Real(3.0) * b);
        auto const inside = (inflection > low) & (inflection < high);
        Real const steeper = select(abs(slope(low)) > abs(slope(high)), low, high);
        Real theta = select(inside, inflection, steeper);
        auto const held = [&](Real x) { return min(max(x, low), high); };  // a NaN becomes low
        for (int steps = 0; steps < 40 && any(wanted); ++steps) {
            Real const next = held(theta - value(theta) / slope(theta));
            Real const move = abs(next - theta);
            theta = select(wanted, next, theta);
            wanted = wanted & (move > Real(1e-7) * theta);
        }
        return theta;
    }
};

}  // namespace detail

/// Zeros on [0, 1] of the cubic through the values and slopes at both ends, those that it crosses in the direction asked for.
/// Between its extrema the cubic is monotone, so that no pair of zeros inside one step is missed.  A value of 0 counts as positive:
/// a zero at the end of one step is found in that step or in the next, and once.
/// @param candidate lanes that `may_cross`.
template <class Real>
SLIDEWAY_HD CubicZeros<Real> cubic_zeros(Mask<Real> candidate, Real v0, Real s0, Real v1, Real s1,
                                         Direction direction) {
    Real const zero(0.0), one(1.0), absent(2.0);
    CubicZeros<Real> found;
    for (auto& z : found.at) z = {absent, zero, one, one};
    found.any = mask_of<Real>(false);
    auto const starts_positive = v0 >= zero, ends_positive = v1 >= zero;
    auto const cubic = detail::EventCubic<Real>::through(v0, s0, v1, s1);
    // Extrema at s0 + 2aθ + 3bθ² = 0.
    Real const a = cubic.a, triple = Real(3.0) * cubic.b;
    Real const root = sqrt(max(fnma(triple, s0, a * a), zero));
    Real const q = negated(a + select(a < zero, negated(root), root));
    auto const within = [&](Real theta) { return select((theta > zero) & (theta < one), theta, zero); };  // NaN too
    Real const e1 = within(q / triple), e2 = within(s0 / q);
    Real const ends[4] = {zero, min(e1, e2), max(e1, e2), one};
    Mask<Real> positive[4] = {starts_positive, cubic.value(ends[1]) >= zero, cubic.value(ends[2]) >= zero,
                              ends_positive};
    positive[1] = (positive[1] & (ends[1] > zero)) | (starts_positive & !(ends[1] > zero));
    positive[2] = (positive[2] & (ends[2] > zero)) | (starts_positive & !(ends[2] > zero));
    for (int i = 0; i < 3; ++i) {
        auto const falls = positive[i] & (!positive[i + 1]), rises = (!positive[i]) & positive[i + 1];
        auto const crosses = candidate & (direction == Direction::falling  ? falls
                                          : direction == Direction::rising ? rises
                                                                           : falls | rises);
        if (none(crosses)) continue;
        Real const theta = cubic.zero_within(ends[i], ends[i + 1], crosses);
        found.at[i] = {select(crosses, theta, absent), ends[i], ends[i + 1], cubic.slope(theta)};
        found.any = found.any | crosses;
    }
    return found;
}

}  // namespace slideway::inline SLIDEWAY_ISA
