#pragma once

#include "kernels/math/trigonometry.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// A place or a vector in the plane.
template <class Real> struct Vec2 { Real x, y; };

template <class Real> SLIDEWAY_FN Real cross(Vec2<Real> const& a, Vec2<Real> const& b) { return fms(a.x, b.y, a.y * b.x); }
template <class Real> SLIDEWAY_FN Real dot(Vec2<Real> const& a, Vec2<Real> const& b) { return fma(a.x, b.x, a.y * b.y); }
template <class Real> SLIDEWAY_FN Vec2<Real> operator+(Vec2<Real> const& a, Vec2<Real> const& b) { return {a.x + b.x, a.y + b.y}; }
template <class Real> SLIDEWAY_FN Vec2<Real> operator-(Vec2<Real> const& a, Vec2<Real> const& b) { return {a.x - b.x, a.y - b.y}; }
template <class Real> SLIDEWAY_FN Vec2<Real> operator*(Real factor, Vec2<Real> const& a) { return {factor * a.x, factor * a.y}; }
/// a + factor·b.
template <class Real> SLIDEWAY_FN Vec2<Real> add(Vec2<Real> const& a, Real factor, Vec2<Real> const& b) { return {fma(factor, b.x, a.x), fma(factor, b.y, a.y)}; }
/// Turned by a right angle: ⊥(x, y) = (−y, x).
template <class Real> SLIDEWAY_FN Vec2<Real> across(Vec2<Real> const& a) { return {negated(a.y), a.x}; }
template <class Real> SLIDEWAY_FN Vec2<Real> turned(SinCos<Real> const& by, Vec2<Real> const& a) {
    return {fms(by.cos, a.x, by.sin * a.y), fma(by.sin, a.x, by.cos * a.y)};
}

}  // namespace slideway::inline SLIDEWAY_ISA
