#pragma once

#include "kernels/joint/attitude.hpp"
#include "kernels/math/vec3.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// How a slider lies and turns, whatever moves its centre: φ ϑ ψ and ω of model.md 1, I ω' = A_kᵀ τ − ω × I ω.
template <class Real> struct SliderTurning {
    Attitude<Real> angles;
    Axes<Real> axes;   // in the inertial frame
    Vec3<Real> omega;  // along the slider's axes [rad/s]
    Vec3<Real> spin;   // ω_I [rad/s]
    Real pitch_rate;   // ψ' [rad/s]

    /// @param s state that begins with y z vy vz φ ϑ ψ ωx ωy ωz.
    SLIDEWAY_FN static SliderTurning of(Real const* s) {
        SliderTurning t;
        t.omega = {s[7], s[8], s[9]};
        t.angles = attitude(s[4], s[5], s[6]);
        t.axes = slideway::axes(t.angles);
        Real const turn = fma(t.omega.y, t.angles.roll.sin, t.omega.z * t.angles.roll.cos);
        t.pitch_rate = turn / t.angles.yaw.cos;
        t.spin = from_slider(t.axes, t.omega);
        return t;
    }

    /// Derivatives of φ ϑ ψ ωx ωy ωz.  @param torque τ about the slider's centre [N m] and its axes, both in the frame of the joint.
    SLIDEWAY_CARD_CALL void put_rates(Vec3<Real> const& torque, Axes<Real> const& of_joint, Vec3<Real> const& inertia,
                               Vec3<Real> const& inverse_inertia, Real* rates) const {
        put_angles(rates);
        auto along = to_slider(of_joint, torque);
        Vec3<Real> momentum{inertia.x * omega.x, inertia.y * omega.y, inertia.z * omega.z};
        auto moment = along - cross(omega, momentum);
        rates[7] = moment.x * inverse_inertia.x;
        rates[8] = moment.y * inverse_inertia.y;
        rates[9] = moment.z * inverse_inertia.z;
    }
    /// The same where ω' is known.
    SLIDEWAY_FN void put_rates(Vec3<Real> const& spin_up, Real* rates) const {
        put_angles(rates);
        rates[7] = spin_up.x;
        rates[8] = spin_up.y;
        rates[9] = spin_up.z;
    }

private:
    SLIDEWAY_FN void put_angles(Real* rates) const {
        rates[4] = fma(pitch_rate, angles.yaw.sin, omega.x);
        rates[5] = fms(omega.y, angles.roll.cos, omega.z * angles.roll.sin);
        rates[6] = pitch_rate;
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
