// Where the slide way lies.  Contact is evaluated in the way's coordinates.
#pragma once

#include "kernels/joint/attitude.hpp"
#include "kernels/math/vec3.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

template <class Real> struct WayParameters {
    Vec3<Real> offset;   // u_l: the way's axis passes through it [m]
    Vec3<Real> x, y, z;  // columns of A_l
    Real station;        // where it has its offset, along the mechanism's X [m]
};

/// Pose and motion of the slider as the joint sees it.
template <class Real> struct JointMotion {
    Axes<Real> axes;      // A_lᵀ A_k
    Real y, z;            // slider's centre from the way's axis [m]
    Vec3<Real> velocity;  // A_lᵀ u' [m/s]
    Vec3<Real> spin;      // A_lᵀ ω_I [rad/s]
};

/// Tolerance of the way: an offset and an attitude A_l.  p = A_lᵀ (u − u_l), p' = A_lᵀ u' (model.md 1).
struct MisalignedWay {
    template <class Real> SLIDEWAY_FN static Vec3<Real> to_way(Vec3<Real> const& v, WayParameters<Real> const& way) {
        return {dot(way.x, v), dot(way.y, v), dot(way.z, v)};
    }
    template <class Real>
    SLIDEWAY_FN static JointMotion<Real> motion(Axes<Real> const& slider, Vec3<Real> const& position,
                                                Vec3<Real> const& velocity, Vec3<Real> const& spin,
                                                WayParameters<Real> const& way) {
        JointMotion<Real> m;
        m.axes.x = to_way(slider.x, way);
        m.axes.y = to_way(slider.y, way);
        m.axes.z = to_way(slider.z, way);
        m.axes.y_shortfall = shortfall(m.axes.y.y, m.axes.y.x, m.axes.y.z);
        m.axes.z_shortfall = shortfall(m.axes.z.z, m.axes.z.x, m.axes.z.y);
        auto p = to_way(position - way.offset, way);
        m.y = p.y;
        m.z = p.z;
        m.velocity = to_way(velocity, way);
        m.spin = to_way(spin, way);
        return m;
    }
    template <class Real>
    SLIDEWAY_FN static Vec3<Real> to_inertial(Vec3<Real> const& v, WayParameters<Real> const& way) {
        return fma(v.x, way.x, fma(v.y, way.y, v.z * way.z));
    }

private:
    /// n − 1 of a unit vector's main component n, from the other two: −q/(1 + √(1 − q)), q the sum of their squares.
    template <class Real> SLIDEWAY_FN static Real shortfall(Real main, Real p, Real r) {
        Real const q = fma(p, p, r * r);
        Real const upright = negated(q) / (Real(1.0) + sqrt(max(Real(1.0) - q, Real(0.0))));
        return select(main > Real(0.0), upright, main - Real(1.0));
    }
};

/// What the joint sees of a slider.  A way that lies on the X axis of the inertial frame leaves nothing to turn.
/// @param misaligned of the whole block
template <class Real>
SLIDEWAY_FN JointMotion<Real> joint_motion(bool misaligned, Axes<Real> const& slider, Vec3<Real> const& position,
                                           Vec3<Real> const& velocity, Vec3<Real> const& spin,
                                           WayParameters<Real> const& way) {
    if (misaligned) return MisalignedWay::motion(slider, position, velocity, spin, way);
    return {slider, position.y, position.z, velocity, spin};
}

/// A vector of the way's frame in the inertial one.
template <class Real>
SLIDEWAY_FN Vec3<Real> to_inertial(bool misaligned, Vec3<Real> const& v, WayParameters<Real> const& way) {
    return misaligned ? MisalignedWay::to_inertial(v, way) : v;
}

}  // namespace slideway::inline SLIDEWAY_ISA
