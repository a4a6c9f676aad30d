#pragma once

#include "kernels/math/trigonometry.hpp"
#include "kernels/math/vec3.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// The slider's axes in some frame, and how far the Y and Z axes fall short of that frame's, without cancellation: a resting
/// penetration of 1e-10 m keeps ten digits only so (model.md 3).
template <class Real> struct Axes {
    Vec3<Real> x, y, z;
    Real y_shortfall;  // y.y − 1
    Real z_shortfall;  // z.z − 1
};

/// A vector along the slider's axes in the frame that these are given in, and the other way round.
template <class Real> SLIDEWAY_FN Vec3<Real> from_slider(Axes<Real> const& axes, Vec3<Real> const& v) {
    return fma(v.x, axes.x, fma(v.y, axes.y, v.z * axes.z));
}
template <class Real> SLIDEWAY_FN Vec3<Real> to_slider(Axes<Real> const& axes, Vec3<Real> const& v) {
    return {dot(axes.x, v), dot(axes.y, v), dot(axes.z, v)};
}

/// Sines and cosines of roll φ, yaw ϑ and pitch ψ.
template <class Real> struct Attitude { SinCos<Real> roll, yaw, pitch; };

/// Bits as of three calls of sincos; one branch lets the compiler interleave the three.
template <class Real> SLIDEWAY_FN Attitude<Real> attitude(Real roll, Real yaw, Real pitch) {
    using namespace detail;
    Mask<Real> const wide_roll = is_wide(roll), wide_yaw = is_wide(yaw), wide_pitch = is_wide(pitch);
    if (none((wide_roll | wide_yaw) | wide_pitch)) {
        return {sine_and_cosine_near(roll), sine_and_cosine_near(yaw), sine_and_cosine_near(pitch)};
    }
    return {sine_and_cosine_reduced(roll), sine_and_cosine_reduced(yaw), sine_and_cosine_reduced(pitch)};
}

/// Columns of A_k = Rz(ψ) Ry(ϑ) Rx(φ) in the inertial frame.  Source: Qian et al. 2020 (3)–(4), angles as in model.md 1.
template <class Real> SLIDEWAY_FN Axes<Real> axes(Attitude<Real> const& a) {
    Real const& sr = a.roll.sin;
    Real const& cr = a.roll.cos;
    Real const& sy = a.yaw.sin;
    Real const& cy = a.yaw.cos;
    Real const& sp = a.pitch.sin;
    Real const& cp = a.pitch.cos;
    Axes<Real> e;
    e.x = {cp * cy, sp * cy, negated(sy)};
    Real const sy_sr = sy * sr, sy_cr = sy * cr;
    e.y = {fms(cp, sy_sr, sp * cr), fma(sp, sy_sr, cp * cr), cy * sr};
    e.z = {fma(cp, sy_cr, sp * sr), fms(sp, sy_cr, cp * sr), cy * cr};
    // cos a cos b − 1 = −(va + vb − va vb) with v = 1 − cos.
    e.y_shortfall = fms(sp, sy_sr, fnma(a.pitch.versine, a.roll.versine, a.pitch.versine + a.roll.versine));
    e.z_shortfall = fms(a.yaw.versine, a.roll.versine, a.yaw.versine + a.roll.versine);
    return e;
}

}  // namespace slideway::inline SLIDEWAY_ISA
