#pragma once

#include "kernels/laws/friction.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Friction of one apex in the plane of its face (directions x and z of that plane), linearised: per newton of normal force
/// it pushes with −μ t, and f = −F T (v − v₀) about the present sliding velocity.
template <class Real> struct FrictionSlopes {
    Real push_x, push_z;  // −μ t, t = v_t/V
    Real xx, xz, zz;      // T [s/m]: μ'(V) along t, μ/V across it
};

/// μ(V) [−] and dμ/dV [s/m].
template <class Real> struct FrictionCoefficient { Real value, slope; };

/// Derivatives of StickSlipFriction.
struct StickSlipStiffness {
    /// @param v_x, v_z sliding velocity [m/s].  At rest T is isotropic, μ'(0), and the push vanishes.
    template <class Real>
    SLIDEWAY_FN static FrictionSlopes<Real> apex(Real v_x, Real v_z, FrictionParameters<Real> const& friction) {
        // The floor keeps μ/V at its limit μ'(0).
        Real const speed = max(sqrt(fma(v_x, v_x, v_z * v_z)), Real(1e-100));
        Real const inverse = Real(1.0) / speed;
        auto const mu = coefficient(speed, friction);
        Real const t_x = v_x * inverse, t_z = v_z * inverse;
        Real const round = mu.value * inverse, excess = mu.slope - round;
        Real const along_x = excess * t_x;
        return {negated(mu.value) * t_x, negated(mu.value) * t_z, fma(along_x, t_x, round), along_x * t_z,
                fma(excess * t_z, t_z, round)};
    }

    /// StickSlipFriction::coefficient with its derivative.  @param speed V ≥ 0 [m/s].
    template <class Real>
    SLIDEWAY_FN static FrictionCoefficient<Real> coefficient(Real speed, FrictionParameters<Real> const& f) {
        Real const zero(0.0);
        auto const slipping = speed >= f.slip_speed;
        if (all(slipping)) return {f.kinetic_coefficient, zero};
        Real const quarter(1.5707963267948966), half(0.5);
        auto const sticking = speed < f.stick_speed;
        // μ = offset + amplitude · sin(angle) on both curves, the angle within ±π/2.
        Real const falling = max(fnma(speed - f.stick_speed, f.fall, quarter), negated(quarter));
        Real const angle = select(sticking, speed * f.rise, falling);
        Real const amplitude =
            select(sticking, f.static_coefficient, half * (f.static_coefficient - f.kinetic_coefficient));
        Real const offset = select(sticking, zero, half * (f.static_coefficient + f.kinetic_coefficient));
        Real const pace = select(sticking, f.rise, negated(f.fall));
        Real const cosine = sin_quarter(quarter - abs(angle));
        return {select(slipping, f.kinetic_coefficient, fma(amplitude, sin_quarter(angle), offset)),
                select(slipping, zero, amplitude * pace * cosine)};
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
