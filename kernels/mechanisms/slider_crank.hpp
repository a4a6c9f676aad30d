#pragma once

#include "kernels/mechanisms/faults.hpp"
#include "kernels/mechanisms/slider_base.hpp"
#include "kernels/mechanisms/slider_contact.hpp"
#include "kernels/mechanisms/slider_turning.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// The spatial slider-crank with clearance in its translational joint.  State: y z vy vz φ ϑ ψ ωx ωy ωz (SI, model.md 1); the
/// crank turns at constant speed, x follows from the rod.  Source: Qian et al. 2020, section 4; equations as in model.md 6.
/// What a scene does not need is not in its instance: law, friction, pose of the way and damping are template arguments.
template <class Law, class Friction, class Way, class Damping>
struct SliderCrank : SliderBase, SliderContact<SliderCrank<Law, Friction, Way, Damping>, Law, Friction, Way, Damping> {
    using SliderCrankContact = SliderContact<SliderCrank, Law, Friction, Way, Damping>;
    using typename SliderCrankContact::Contact;
    template <class Real> using Memory = typename SliderCrankContact::template Memory<Real>;

    /// Time derivative of the state.
    /// @param t time [s]; @param s the state, `size` values; @param rates their derivatives, NaN where a fault is set.
    /// @param report filled if Full; the derivative has the same bits without.
    template <bool Full, class Real>
    SLIDEWAY_NOINLINE static Faults<Real> derivative(Real t, Real const* s, SliderParameters<Real> const& p,
                                                     Memory<Real> const& memory, Real* rates,
                                                     SliderReport<Real>* report) {
        Real const y = s[0], z = s[1], vy = s[2], vz = s[3];
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

        auto turning = SliderTurning<Real>::of(s);

        // The joint, in way coordinates.
        auto const& way = p.joint.way;
        auto motion = Way::motion(turning.axes, Vec3<Real>{x, y, z}, Vec3<Real>{vx, vy, vz}, turning.spin, way);
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

        rates[0] = vy;
        rates[1] = vz;
        rates[2] = ay_b;
        rates[3] = az_b;
        turning.put_rates(wrench.torque, motion.axes, p.inertia, p.inverse_inertia, rates);

        if constexpr (Full) {
            PointMotion<Real> pin{{ax, ay, zero}, {vax, vay, zero}, {aax, aay, zero}};
            PointMotion<Real> end{{x, y, z}, {vx, vy, vz}, {fma(ky, ay_b, fma(kz, az_b, bias)), ay_b, az_b}};
            report->fill(pin, end, d, turning, contact_force, p);
        }
        return faults;
    }

    /// Of the slider's centre [m]; where the rod does not reach, as far as it is.
    template <class Real>
    SLIDEWAY_FN static Vec3<Real> position(Real t, Real const* s, SliderParameters<Real> const& p) {
        auto const crank = sincos(fma(p.crank_speed, t, p.start_angle));
        Real const dy = fnma(p.crank_length, crank.sin, s[0]);
        Real const reach = fnma(s[1], s[1], fnma(dy, dy, p.rod_length * p.rod_length));
        return {fma(p.crank_length, crank.cos, sqrt(max(reach, Real(0.0)))), s[0], s[1]};
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
