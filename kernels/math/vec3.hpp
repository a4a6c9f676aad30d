#pragma once

#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Locals of this and other structures are not const in the kernels: g++ 12 takes a structure apart into registers only if it
/// is not, and keeps it in memory otherwise.
template <class Real> struct Vec3 { Real x, y, z; };

template <class Real> SLIDEWAY_FN Vec3<Real> operator+(Vec3<Real> const& a, Vec3<Real> const& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}

template <class Real> SLIDEWAY_FN Vec3<Real> operator-(Vec3<Real> const& a, Vec3<Real> const& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}

template <class Real> SLIDEWAY_FN Vec3<Real> operator*(Real factor, Vec3<Real> const& a) {
    return {factor * a.x, factor * a.y, factor * a.z};
}

template <class Real> SLIDEWAY_FN Vec3<Real> select(Mask<Real> m, Vec3<Real> const& yes, Vec3<Real> const& no) {
    return {select(m, yes.x, no.x), select(m, yes.y, no.y), select(m, yes.z, no.z)};
}

/// factor·a + b.
template <class Real> SLIDEWAY_FN Vec3<Real> fma(Real factor, Vec3<Real> const& a, Vec3<Real> const& b) {
    return {fma(factor, a.x, b.x), fma(factor, a.y, b.y), fma(factor, a.z, b.z)};
}

template <class Real> SLIDEWAY_FN Real dot(Vec3<Real> const& a, Vec3<Real> const& b) {
    return fma(a.z, b.z, fma(a.y, b.y, a.x * b.x));
}

template <class Real> SLIDEWAY_FN Vec3<Real> cross(Vec3<Real> const& a, Vec3<Real> const& b) {
    return {fms(a.y, b.z, a.z * b.y), fms(a.z, b.x, a.x * b.z), fms(a.x, b.y, a.y * b.x)};
}

}  // namespace slideway::inline SLIDEWAY_ISA
