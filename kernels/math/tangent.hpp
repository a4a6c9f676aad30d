#pragma once

#include <type_traits>

#include "kernels/math/exponential.hpp"
#include "kernels/math/trigonometry.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// A number and how fast it changes along some direction, in every lane.  A function written for any `Real` gives, called with it, its value
/// and its derivative along the direction of its arguments.  Values have the bits that they have without slopes, and decisions are theirs: of a
/// function in pieces it is the derivative of the piece that is taken.
template <class Real> struct Tangent {
    Real value, slope;

    Tangent() = default;
    /// What does not change.
    SLIDEWAY_FN explicit Tangent(double constant) : value(constant), slope(0.0) {}
    SLIDEWAY_FN explicit Tangent(Real constant) requires(!std::is_same_v<Real, double>) : value(constant), slope(0.0) {}
    SLIDEWAY_FN Tangent(Real at, Real change) : value(at), slope(change) {}
};

template <class Real> inline constexpr bool is_tangent = false;
template <class Real> inline constexpr bool is_tangent<Tangent<Real>> = true;

namespace detail {

template <class Real> struct Traits<Tangent<Real>> {
    using Mask = typename Traits<Real>::Mask;
    static constexpr int lanes = Traits<Real>::lanes;
    SLIDEWAY_FN static Mask mask_of(bool value) { return Traits<Real>::mask_of(value); }
};

}  // namespace detail

template <class Real> SLIDEWAY_FN Tangent<Real> operator+(Tangent<Real> const& a, Tangent<Real> const& b) {
    return {a.value + b.value, a.slope + b.slope};
}
template <class Real> SLIDEWAY_FN Tangent<Real> operator-(Tangent<Real> const& a, Tangent<Real> const& b) {
    return {a.value - b.value, a.slope - b.slope};
}
template <class Real> SLIDEWAY_FN Tangent<Real> operator*(Tangent<Real> const& a, Tangent<Real> const& b) {
    return {a.value * b.value, fma(a.slope, b.value, a.value * b.slope)};
}
template <class Real> SLIDEWAY_FN Tangent<Real> operator/(Tangent<Real> const& a, Tangent<Real> const& b) {
    Real const quotient = a.value / b.value;
    return {quotient, fnma(quotient, b.slope, a.slope) / b.value};
}
template <class Real> SLIDEWAY_FN Tangent<Real> negated(Tangent<Real> const& a) {
    return {negated(a.value), negated(a.slope)};
}

/// a·b + c, c − a·b and a·b − c.
template <class Real>
SLIDEWAY_FN Tangent<Real> fma(Tangent<Real> const& a, Tangent<Real> const& b, Tangent<Real> const& c) {
    return {fma(a.value, b.value, c.value), fma(a.slope, b.value, fma(a.value, b.slope, c.slope))};
}
template <class Real>
SLIDEWAY_FN Tangent<Real> fnma(Tangent<Real> const& a, Tangent<Real> const& b, Tangent<Real> const& c) {
    return {fnma(a.value, b.value, c.value), fnma(a.slope, b.value, fnma(a.value, b.slope, c.slope))};
}
template <class Real>
SLIDEWAY_FN Tangent<Real> fms(Tangent<Real> const& a, Tangent<Real> const& b, Tangent<Real> const& c) {
    return {fms(a.value, b.value, c.value), fma(a.slope, b.value, fms(a.value, b.slope, c.slope))};
}

template <class Real>
SLIDEWAY_FN Tangent<Real> select(Mask<Real> m, Tangent<Real> const& yes, Tangent<Real> const& no) {
    return {select(m, yes.value, no.value), select(m, yes.slope, no.slope)};
}
// The pieces are chosen as min and max of numbers choose.
template <class Real> SLIDEWAY_FN Tangent<Real> min(Tangent<Real> const& a, Tangent<Real> const& b) {
    return {min(a.value, b.value), select(a.value < b.value, a.slope, b.slope)};
}
template <class Real> SLIDEWAY_FN Tangent<Real> max(Tangent<Real> const& a, Tangent<Real> const& b) {
    return {max(a.value, b.value), select(a.value > b.value, a.slope, b.slope)};
}
template <class Real> SLIDEWAY_FN Tangent<Real> abs(Tangent<Real> const& a) {
    return {abs(a.value), select(a.value < Real(0.0), negated(a.slope), a.slope)};
}

/// Not finite where a is 0 and changes.
template <class Real> SLIDEWAY_FN Tangent<Real> sqrt(Tangent<Real> const& a) {
    Real const root = sqrt(a.value);
    return {root, a.slope / (root + root)};
}

template <class Real> SLIDEWAY_FN Tangent<Real> exp(Tangent<Real> const& a) {
    Real const e = exp(a.value);
    return {e, e * a.slope};
}
/// A step that does not change but where it jumps.
template <class Real> SLIDEWAY_FN Tangent<Real> round_even(Tangent<Real> const& a) { return {round_even(a.value), Real(0.0)}; }

template <class Real> SLIDEWAY_FN SinCos<Tangent<Real>> sincos(Tangent<Real> const& angle) {
    auto const of = sincos(angle.value);
    Real const down = of.sin * angle.slope;
    return {{of.sin, of.cos * angle.slope}, {of.cos, negated(down)}, {of.versine, down}};
}

template <class Real> SLIDEWAY_FN Mask<Real> operator==(Tangent<Real> const& a, Tangent<Real> const& b) {
    return a.value == b.value;
}
template <class Real> SLIDEWAY_FN Mask<Real> operator!=(Tangent<Real> const& a, Tangent<Real> const& b) {
    return a.value != b.value;
}
template <class Real> SLIDEWAY_FN Mask<Real> operator<(Tangent<Real> const& a, Tangent<Real> const& b) {
    return a.value < b.value;
}
template <class Real> SLIDEWAY_FN Mask<Real> operator>(Tangent<Real> const& a, Tangent<Real> const& b) {
    return a.value > b.value;
}
template <class Real> SLIDEWAY_FN Mask<Real> operator<=(Tangent<Real> const& a, Tangent<Real> const& b) {
    return a.value <= b.value;
}
template <class Real> SLIDEWAY_FN Mask<Real> operator>=(Tangent<Real> const& a, Tangent<Real> const& b) {
    return a.value >= b.value;
}

}  // namespace slideway::inline SLIDEWAY_ISA
