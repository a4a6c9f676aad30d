#pragma once

#include <type_traits>

#include "kernels/joint/attitude.hpp"
#include "kernels/joint/joint.hpp"
#include "kernels/mechanisms/faults.hpp"
#include "kernels/mechanisms/no_memory.hpp"
#include "kernels/mechanisms/slider_crank_base.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// The spatial slider-crank with clearance in its translational joint.  State: y z vy vz φ ϑ ψ ωx ωy ωz (SI, model.md 1); the
/// crank turns at constant speed, x follows from the rod.  Source: Qian et al. 2020, section 4; equations as in model.md 6.
/// What a scene does not need is not in its instance: law, friction, pose of the way and damping are template arguments.
template <class Law, class Friction, class Way, class Damping> struct SliderCrank : SliderCrankBase {
    using Contact = Joint<Law, Friction, Damping>;
    static constexpr bool has_memory = Contact::has_memory;
    static constexpr bool can_hold = Contact::can_hold;
    static constexpr bool conserving = !Law::switches;
    template <class Real>
    using Memory = std::conditional_t<has_memory, ImpactMemory<Real>,
                                      std::conditional_t<can_hold, HeldContacts<Real>, NoMemory<Real>>>;

    /// Time derivative of the state.
    /// @param t time [s]; @param s the state, `size` values; @param rates their derivatives, NaN where a fault is set.
    /// @param report filled if Full; the derivative has the same bits without.
    template <bool Full, class Real>
    SLIDEWAY_NOINLINE static Faults<Real> derivative(Real t, Real const* s, SliderParameters<Real> const& p,
                                                     Memory<Real> const& memory, Real* rates,
                                                     SliderReport<Real>* report) {
        Real const y = s[0], z = s[1], vy = s[2], vz = s[3];
        Vec3<Real> omega{s[7], s[8], s[9]};
        Real const zero(0.0), one(1.0);
        Faults<Real> faults;

        // Crank pin A and its motion.
        auto crank = sincos(fma(p.crank_speed, t, p.start_angle));
        Real const ax = p.crank_length * crank.cos, ay = p.crank_length * crank.sin;
        Real const vax = negated(p.crank_speed) * ay, vay = p.crank_speed * ax;
        Real const minus_speed_squared = negated(p.crank_speed * p.crank_speed);
        Real const aax = minus_speed_squared * ax, aay = minus_speed_squared * ay;

        // Rod: D² + (y − y_A)² + z² = L² gives x and its rates.
        Real const dy = y - ay;
        Real const reach = fnma(z, z, fnma(dy, dy, p.rod_length * p.rod_length));
        faults.geometry = reach <= zero;  // NaN has another cause
        Real const d = sqrt(reach);
        Real const inverse_d = d * (one / reach);  // root and division side by side
        Real const ky = negated(dy) * inverse_d, kz = negated(z) * inverse_d;
        Real const dvy = vy - vay;
        Real const dd = fma(ky, dvy, kz * vz);
        Real const gamma = negated(fma(dvy, dvy, fma(vz, vz, dd * dd))) * inverse_d;
        Real const x = ax + d, vx = vax + dd;

        // Slider's attitude and its kinematic equations.
        auto angles = attitude(s[4], s[5], s[6]);
        auto slider = axes(angles);
        Real const turn = fma(omega.y, angles.roll.sin, omega.z * angles.roll.cos);
        Real const pitch_rate = turn / angles.yaw.cos;
        auto spin = fma(omega.x, slider.x, fma(omega.y, slider.y, omega.z * slider.z));

        // The joint, in way coordinates.
        auto const& way = p.joint.way;
        auto motion = Way::motion(slider, Vec3<Real>{x, y, z}, Vec3<Real>{vx, vy, vz}, spin, way);
        auto wrench = Contact::template wrench<Full>(motion, memory, p.joint, Full ? &report->contact : nullptr,
                                                     faults.contact_domain);
        auto contact_force = Way::to_inertial(wrench.force, way);

        // m a_B + m_AB a_A − F = λ(B − A), the X row eliminated: a symmetric 2×2 system with determinant m²(1 + κy² + κz²).
        Vec3<Real> force{fma(p.weighing_mass, p.gravity_x, contact_force.x),
                         fma(p.weighing_mass, p.gravity_y, contact_force.y), contact_force.z};
        // a_Bx = aAx − κy aAy + γ + κy y'' + κz z''
        Real const bias = fnma(ky, aay, aax) + gamma;
        Real const pull = fnma(p.m_ab, aax, fnma(p.mass, bias, force.x));
        Real const fy = fma(ky, pull, fnma(p.m_ab, aay, force.y));
        Real const fz = fma(kz, pull, force.z);
        Real const ky2 = fma(ky, ky, one), kz2 = fma(kz, kz, one), kyz = ky * kz;
        Real const scale = one / (p.mass * fma(kz, kz, ky2));
        Real const ay_b = fms(kz2, fy, kyz * fz) * scale;
        Real const az_b = fms(ky2, fz, kyz * fy) * scale;

        // I ω' = A_kᵀ τ − ω × I ω
        Vec3<Real> torque{dot(motion.axes.x, wrench.torque), dot(motion.axes.y, wrench.torque),
                          dot(motion.axes.z, wrench.torque)};
        Vec3<Real> momentum{p.inertia.x * omega.x, p.inertia.y * omega.y, p.inertia.z * omega.z};
        auto moment = torque - cross(omega, momentum);

        rates[0] = vy;
        rates[1] = vz;
        rates[2] = ay_b;
        rates[3] = az_b;
        rates[4] = fma(pitch_rate, angles.yaw.sin, omega.x);
        rates[5] = fms(omega.y, angles.roll.cos, omega.z * angles.roll.sin);
        rates[6] = pitch_rate;
        rates[7] = moment.x * p.inverse_inertia.x;
        rates[8] = moment.y * p.inverse_inertia.y;
        rates[9] = moment.z * p.inverse_inertia.z;

        if constexpr (Full) {
            CrankState<Real> pin{{ax, ay, zero}, {vax, vay, zero}, {aax, aay, zero}};
            CrankState<Real> end{{x, y, z}, {vx, vy, vz}, {fma(ky, ay_b, fma(kz, az_b, bias)), ay_b, az_b}};
            report->fill(pin, end, d, omega, contact_force, p);
        }
        return faults;
    }

    /// Which apices touch, as a number (Joint::pattern): members of one pattern have the same work to do.
    template <class Real>
    SLIDEWAY_NOINLINE static Real contact_pattern(Real t, Real const* s, SliderParameters<Real> const& p) {
        return Contact::pattern(pose(t, s, p), p.joint.geometry);
    }

    /// Mean speed, in units of c ω, at which the fastest of the apices that come into contact in a step has approached its face; 0 where
    /// none does.
    template <class Real>
    SLIDEWAY_NOINLINE static Real approach_speed(Real t, Real const* s, Real step, Real const* end,
                                                 SliderParameters<Real> const& p) {
        Real const way = Contact::approach(pose(t, s, p), pose(t + step, end, p), p.joint.geometry);
        return way / (step * max(p.length_scale_y, p.length_scale_z) * p.rate_scale);
    }

    /// Gap of an apex to the face on its side along Y, or along Z: its penetration negated [m].  @param apex P1…P8 from 0
    template <class Real>
    SLIDEWAY_NOINLINE static Real gap(Real t, Real const* s, SliderParameters<Real> const& p, bool z_faces, int apex) {
        return negated(Contact::penetration(pose(t, s, p), p.joint.geometry, z_faces, apex));
    }

private:
    /// Where the slider is in its joint; without its motion.
    template <class Real>
    SLIDEWAY_FN static JointMotion<Real> pose(Real t, Real const* s, SliderParameters<Real> const& p) {
        auto const crank = sincos(fma(p.crank_speed, t, p.start_angle));
        Real const dy = fnma(p.crank_length, crank.sin, s[0]);
        Real const reach = fnma(s[1], s[1], fnma(dy, dy, p.rod_length * p.rod_length));
        Real const x = fma(p.crank_length, crank.cos, sqrt(max(reach, Real(0.0))));
        Real const zero(0.0);
        Vec3<Real> const still{zero, zero, zero};
        return Way::motion(axes(attitude(s[4], s[5], s[6])), Vec3<Real>{x, s[0], s[1]}, still, still, p.joint.way);
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
