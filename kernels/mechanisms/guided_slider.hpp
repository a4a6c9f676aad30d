#pragma once

#include "kernels/mechanisms/drives.hpp"
#include "kernels/mechanisms/faults.hpp"
#include "kernels/mechanisms/slider_contact.hpp"
#include "kernels/mechanisms/slider_linearisation.hpp"
#include "kernels/mechanisms/slider_turning.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// The joint as functions of their own, which mechanisms of one law share: inlined into each of them it is a tenth faster and takes
/// twice as long to compile (docs/performance.md).
template <class Law, class Friction, class Damping> struct SharedJoint {
    template <bool Full, class Real, class Memory>
    SLIDEWAY_NOINLINE static Wrench<Real> wrench(JointMotion<Real> const& motion, Memory const& memory,
                                                 JointParameters<Real> const& p, ContactReport<Real>* report,
                                                 Mask<Real>& outside) {
        return Joint<Law, Friction, Damping>::template wrench<Full>(motion, memory, p, report, outside);
    }
    template <class Real, class Memory>
    SLIDEWAY_NOINLINE static Real stiffness(JointFrame<Real> const& frame, Memory const& memory,
                                            JointParameters<Real> const& p, JointStiffness<Real>& out) {
        return JointLinearisation<Law, Friction, Damping>::stiffness(frame, memory, p, out);
    }
};

/// A slider in its clearance joint without crank and rod: M u'' = F_c + M g⃗, of which x'' is given where a drive moves it, and
/// I ω' = A_kᵀ τ − ω × I ω (model.md 7: carriage, free_slider).  State: y z vy vz φ ϑ ψ ωx ωy ωz, and x vx where it is free.
/// @tparam Drive CarriageDrive or NoDrive
template <class Drive, class Law, class Friction, class Way, class Damping>
struct GuidedSlider : Drive,
                      SliderContact<GuidedSlider<Drive, Law, Friction, Way, Damping>, Law, Friction, Way, Damping> {
    using Shared = SharedJoint<Law, Friction, Damping>;
    template <class Real>
    using Memory = typename SliderContact<GuidedSlider, Law, Friction, Way, Damping>::template Memory<Real>;

    /// Time derivative of the state; arguments as of SliderCrank::derivative.
    template <bool Full, class Real>
    SLIDEWAY_NOINLINE static Faults<Real> derivative(Real t, Real const* s, SliderParameters<Real> const& p,
                                                     Memory<Real> const& memory, Real* rates,
                                                     SliderReport<Real>* report) {
        Real const y = s[0], z = s[1], vy = s[2], vz = s[3];
        auto faults = Faults<Real>::none();
        auto along = Drive::along(t, s, p);
        auto turning = SliderTurning<Real>::of(s);
        auto const& way = p.joint.way;
        auto motion =
            Way::motion(turning.axes, Vec3<Real>{along.x, y, z}, Vec3<Real>{along.vx, vy, vz}, turning.spin, way);
        auto wrench = Shared::template wrench<Full>(motion, memory, p.joint, Full ? &report->contact : nullptr,
                                                    faults.contact_domain);
        auto force = Way::to_inertial(wrench.force, way);

        Real const lightness = Real(1.0) / p.slider_mass;
        Real const ax = Drive::is_free ? fma(force.x, lightness, p.gravity_x) : along.ax;
        Real const ay = fma(force.y, lightness, p.gravity_y), az = force.z * lightness;
        rates[0] = vy;
        rates[1] = vz;
        rates[2] = ay;
        rates[3] = az;
        turning.put_rates(wrench.torque, motion.axes, p.inertia, p.inverse_inertia, rates);
        if constexpr (Drive::is_free) {
            rates[10] = along.vx;
            rates[11] = ax;
        }
        if constexpr (Full) {
            PointMotion<Real> centre{{along.x, y, z}, {along.vx, vy, vz}, {ax, ay, az}};
            Real const drive =
                Drive::is_free ? Real(0.0) : fms(p.slider_mass, ax - p.gravity_x, force.x);  // M x'' − F_cx − M g_x
            report->fill_guided(centre, turning, drive, p);
        }
        return faults;
    }

    /// Of the slider's centre [m].
    template <class Real>
    SLIDEWAY_FN static Vec3<Real> position(Real t, Real const* s, SliderParameters<Real> const& p) {
        return {Drive::along(t, s, p).x, s[0], s[1]};
    }

    /// Linearises it about one state; NaN where that has a fault.
    template <class Real>
    SLIDEWAY_NOINLINE static void linearise(Real t, Real const* s, SliderParameters<Real> const& p,
                                            Memory<Real> const& memory, SliderLinearisation<Real>& out) {
        Real const zero(0.0);
        out.mass_y = out.mass_z = p.slider_mass;
        out.mass_yz = zero;
        out.inertia = p.inertia;
        auto along = Drive::along(t, s, p);
        auto turning = SliderTurning<Real>::of(s);
        out.roll = turning.angles.roll;
        out.yaw = turning.angles.yaw;
        auto const& slider = turning.axes;
        auto const& way = p.joint.way;
        Vec3<Real> const velocity{along.vx, s[2], s[3]};
        JointFrame<Real> frame;
        frame.motion = Way::motion(slider, Vec3<Real>{along.x, s[0], s[1]}, velocity, turning.spin, way);
        frame.velocity = {dot(slider.x, velocity), dot(slider.y, velocity), dot(slider.z, velocity)};
        frame.spin = turning.omega;
        // What a force does to vy and vz; along X the slider is driven, or no contact is stiff.
        auto const translation = [](Vec3<Real> const& force) { return Translation<Real>{force.y, force.z}; };
        auto const& joint_axes = frame.motion.axes;
        frame.x = translation(slider.x);
        frame.y = translation(slider.y);
        frame.z = translation(slider.z);
        frame.y_normal = translation(Way::to_inertial(Vec3<Real>{zero, joint_axes.y.y, joint_axes.y.z}, way));
        frame.z_normal = translation(Way::to_inertial(Vec3<Real>{zero, joint_axes.z.y, joint_axes.z.z}, way));
        out.touching = Shared::stiffness(frame, memory, p.joint, out.joint);
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
