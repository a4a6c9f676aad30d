#pragma once

#include "kernels/mechanisms/slider_crank.hpp"
#include "kernels/mechanisms/slider_linearisation.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

namespace detail {

template <class Model> struct SliderCrankParts;
template <class Law, class Friction, class Way_, class Damping>
struct SliderCrankParts<SliderCrank<Law, Friction, Way_, Damping>> {
    using Way = Way_;
    using Joint = JointLinearisation<Law, Friction, Damping>;
};

}  // namespace detail

/// Linearises a `SliderCrank` about one state; the same arguments as its derivative.  NaN where that has a fault.
/// @param t time [s]; @param s the state; @param memory read by RestitutionDamping alone.
template <class Model, class Real>
SLIDEWAY_NOINLINE void linearise(Real t, Real const* s, SliderParameters<Real> const& p,
                                 typename Model::template Memory<Real> const& memory, SliderLinearisation<Real>& out) {
    using Parts = detail::SliderCrankParts<Model>;
    Real const y = s[0], z = s[1], vy = s[2], vz = s[3];
    Real const one(1.0);
    // Crank pin and rod: vx = vxA + κy (vy − vyA) + κz vz (model.md 6).
    auto const crank = sincos(fma(p.crank_speed, t, p.start_angle));
    Real const ax = p.crank_length * crank.cos, ay = p.crank_length * crank.sin;
    Real const vax = negated(p.crank_speed) * ay, vay = p.crank_speed * ax;
    Real const dy = y - ay;
    Real const d = sqrt(fnma(z, z, fnma(dy, dy, p.rod_length * p.rod_length)));
    Real const inverse_d = one / d;
    Real const ky = negated(dy) * inverse_d, kz = negated(z) * inverse_d;
    Real const vx = vax + fma(ky, vy - vay, kz * vz);

    out.mass_y = p.mass * fma(ky, ky, one);
    out.mass_z = p.mass * fma(kz, kz, one);
    out.mass_yz = p.mass * ky * kz;
    out.inertia = p.inertia;
    auto const angles = attitude(s[4], s[5], s[6]);
    out.roll = angles.roll;
    out.yaw = angles.yaw;

    auto const slider = axes(angles);
    Vec3<Real> const velocity{vx, vy, vz};
    Vec3<Real> const omega{s[7], s[8], s[9]};
    auto const spin = fma(omega.x, slider.x, fma(omega.y, slider.y, omega.z * slider.z));
    JointFrame<Real> frame;
    frame.motion = Parts::Way::motion(slider, Vec3<Real>{ax + d, y, z}, velocity, spin, p.joint.way);
    frame.velocity = {dot(slider.x, velocity), dot(slider.y, velocity), dot(slider.z, velocity)};
    frame.spin = omega;
    // A force (f_x, f_y, f_z) gives f_y + κy f_x and f_z + κz f_x.
    auto const translation = [&](Vec3<Real> const& force) {
        return Translation<Real>{fma(ky, force.x, force.y), fma(kz, force.x, force.z)};
    };
    auto const& way = p.joint.way;
    auto const& joint_axes = frame.motion.axes;
    Real const zero(0.0);
    frame.x = translation(slider.x);
    frame.y = translation(slider.y);
    frame.z = translation(slider.z);
    frame.y_normal = translation(Parts::Way::to_inertial(Vec3<Real>{zero, joint_axes.y.y, joint_axes.y.z}, way));
    frame.z_normal = translation(Parts::Way::to_inertial(Vec3<Real>{zero, joint_axes.z.y, joint_axes.z.z}, way));
    out.touching = Parts::Joint::stiffness(frame, memory, p.joint, out.joint);
}

}  // namespace slideway::inline SLIDEWAY_ISA
