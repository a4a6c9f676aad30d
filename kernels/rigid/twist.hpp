#pragma once

#include "kernels/math/vec3.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// A velocity or acceleration of the slider, or an impulse or force on it: of its centre along the inertial axes, and about it along
/// the slider's own axes.
template <class Real> struct Twist {
    Vec3<Real> linear, angular;

    SLIDEWAY_FN static Twist zero() {
        Real const none(0.0);
        return {{none, none, none}, {none, none, none}};
    }
};

template <class Real> SLIDEWAY_FN Real dot(Twist<Real> const& a, Twist<Real> const& b) {
    return dot(a.linear, b.linear) + dot(a.angular, b.angular);
}
/// factor·a + b.
template <class Real> SLIDEWAY_FN Twist<Real> fma(Real factor, Twist<Real> const& a, Twist<Real> const& b) {
    return {fma(factor, a.linear, b.linear), fma(factor, a.angular, b.angular)};
}
template <class Real> SLIDEWAY_FN Twist<Real> operator+(Twist<Real> const& a, Twist<Real> const& b) {
    return {a.linear + b.linear, a.angular + b.angular};
}
template <class Real> SLIDEWAY_FN Twist<Real> operator-(Twist<Real> const& a, Twist<Real> const& b) {
    return {a.linear - b.linear, a.angular - b.angular};
}
template <class Real> SLIDEWAY_FN Twist<Real> operator*(Real factor, Twist<Real> const& a) {
    return {factor * a.linear, factor * a.angular};
}
template <class Real> SLIDEWAY_FN Twist<Real> select(Mask<Real> m, Twist<Real> const& yes, Twist<Real> const& no) {
    auto const of = [&](Vec3<Real> const& a, Vec3<Real> const& b) {
        return Vec3<Real>{select(m, a.x, b.x), select(m, a.y, b.y), select(m, a.z, b.z)};
    };
    return {of(yes.linear, no.linear), of(yes.angular, no.angular)};
}

}  // namespace slideway::inline SLIDEWAY_ISA
