#pragma once

#include "kernels/joint/contact_report.hpp"
#include "kernels/math/vec3.hpp"
#include "kernels/mechanisms/mechanism_report.hpp"
#include "kernels/mechanisms/slider_parameters.hpp"
#include "kernels/mechanisms/slider_turning.hpp"
#include "kernels/observers/quantities.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// All that a state of a mechanism with one slider in a clearance joint tells beside its derivative.
/// @tparam Contact a ContactReport, or more
template <class Real, class Contact> struct SliderReportOf : MechanismReport<Real> {
    static constexpr int apices = 8;
    Contact contact;
    Real rod_spin_z;  // the rod's angular velocity about Z [rad/s]

    /// Roll, yaw and pitch [rad].
    SLIDEWAY_FN static Real tilt(Real const* state, int axis) { return state[4 + axis]; }

    /// Value of an entry of `series_table` beyond the state.
    SLIDEWAY_FN Real series_value(int entry) const {
        auto const series = static_cast<Series>(entry);
        return series == Series::rod_angular_velocity ? rod_spin_z : this->common_series(series, contact);
    }

    /// What the slider alone tells.  @param u motion of its centre.
    SLIDEWAY_FN void fill_slider(PointMotion<Real> const& u, SliderTurning<Real> const& turning,
                                 SliderParameters<Real> const& p) {
        this->x = u.position.x;
        this->vx = u.velocity.x;
        this->acceleration = u.acceleration;
        // a + ω' × ρ + ω × (ω × ρ) along the sensor's own axis e, ρ = h e: e·a − h (|ω|² − ω_e²).
        Real const mount(0.01);
        auto const& w = turning.omega;
        Real const about_y = fma(w.x, w.x, w.z * w.z), about_z = fma(w.x, w.x, w.y * w.y);
        this->top = fnma(p.joint.geometry.half_width + mount, about_y, dot(turning.axes.y, u.acceleration));
        this->front = fnma(p.joint.geometry.half_depth + mount, about_z, dot(turning.axes.z, u.acceleration));
    }

    /// Of a slider without crank and rod.  @param drive force of the drive along X [N].
    SLIDEWAY_FN void fill_guided(PointMotion<Real> const& u, SliderTurning<Real> const& turning, Real drive,
                                 SliderParameters<Real> const& p, bool powers_alone) {
        this->crank_power = drive * u.velocity.x;
        if (powers_alone) return;
        fill_slider(u, turning, p);
        Real const zero(0.0), half(0.5);
        auto const& w = turning.omega;
        Vec3<Real> gravity{p.gravity_x, p.gravity_y, p.gravity_z};
        Vec3<Real> momentum{p.inertia.x * w.x, p.inertia.y * w.y, p.inertia.z * w.z};
        Real const kinetic = half * fma(p.slider_mass, dot(u.velocity, u.velocity), dot(w, momentum));
        this->energy = fnma(p.slider_mass, dot(gravity, u.position), kinetic) + contact.potential;
        this->crank_torque = this->drive_torque = this->rod_spin = rod_spin_z = zero;
        this->position_error = sqrt(fma(u.position.y, u.position.y, u.position.z * u.position.z));
    }

    /// Of a slider on a rod.  @param a, b motion of the crank pin and of the slider's centre  @param d their distance along X [m]
    SLIDEWAY_CARD_CALL void fill_crank(PointMotion<Real> const& a, PointMotion<Real> const& b, Real d,
                                SliderTurning<Real> const& turning, Vec3<Real> const& contact_force,
                                SliderParameters<Real> const& p, bool powers_alone) {
        Real const half(0.5), one(1.0);
        auto const& omega = turning.omega;
        Vec3<Real> gravity{p.gravity_x, p.gravity_y, p.gravity_z};

        // Force of the crank pin on the rod: F_A = m_AA a_A + m_AB a_B − m_r (1 − f_r) g⃗ + Λ with
        // Λ = M a_B − F_c − M g⃗ + m_BB a_B + m_AB a_A − m_r f_r g⃗ (model.md 6).
        auto rod_end = p.mass * b.acceleration + p.m_ab * a.acceleration - contact_force;
        auto pin_force =
            p.m_aa * a.acceleration + p.m_ab * b.acceleration + rod_end - (p.slider_mass + p.rod_mass) * gravity;
        this->crank_power = dot(pin_force, a.velocity);
        if (powers_alone) return;
        fill_slider(b, turning, p);
        this->crank_torque = fms(a.position.x, pin_force.y, a.position.y * pin_force.x);
        // m_c g (r/2) cos(θ + β) = −(m_c r/2)(g_y cos θ − g_x sin θ)
        Real const inverse_r = one / p.crank_length;
        Real const lever = fms(p.gravity_y, a.position.x, p.gravity_x * a.position.y) * inverse_r;
        this->drive_torque = fnma(p.crank_moment, lever, this->crank_torque);

        // E = ½M|u'|² + ½m_r|(1−f_r)v_A + f_r v_B|² + ½(J/L²)|v_B−v_A|² + ½ωᵀIω − M g⃗·u − m_r g⃗·((1−f_r)A + f_r B) + U.
        auto const center = p.rod_mass_center;
        auto rod_velocity = (one - center) * a.velocity + center * b.velocity;
        auto rod_position = (one - center) * a.position + center * b.position;
        auto relative = b.velocity - a.velocity;
        Vec3<Real> momentum{p.inertia.x * omega.x, p.inertia.y * omega.y, p.inertia.z * omega.z};
        Real const kinetic =
            half * (p.slider_mass * dot(b.velocity, b.velocity) + p.rod_mass * dot(rod_velocity, rod_velocity) +
                    p.rod_spin_mass * dot(relative, relative) + dot(omega, momentum));
        Real const height = p.slider_mass * dot(gravity, b.position) + p.rod_mass * dot(gravity, rod_position);
        this->energy = kinetic - height + contact.potential;

        this->position_error = this->error_of(d, a.position.y, b.position.y, b.position.z, p.rod_length);

        // No spin about the rod's own axis: ω = e × (v_B − v_A)/L, e the rod's direction.
        Real const inverse_l = one / p.rod_length;
        auto along = b.position - a.position;
        auto rod_turning = inverse_l * inverse_l * cross(along, relative);
        this->rod_spin = sqrt(dot(rod_turning, rod_turning));
        rod_spin_z = rod_turning.z;
    }
};

template <class Real> struct SliderReport : SliderReportOf<Real, ContactReport<Real>> {};

}  // namespace slideway::inline SLIDEWAY_ISA
