#pragma once

#include "kernels/laws/face.hpp"
#include "kernels/math/trigonometry.hpp"
#include "kernels/math/vec3.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

template <class Real> struct FrictionParameters {
    Real static_coefficient;   // μs
    Real kinetic_coefficient;  // μd
    Real stick_speed;          // Vs [m/s]
    Real slip_speed;           // Vd [m/s]
    Real rise;                 // π/(2 Vs) [s/m]
    Real fall;                 // π/(Vd − Vs) [s/m]
};

/// One face as friction sees it.  Apex positions and velocities are affine in the apex's signs: centre ± along ± across.
template <class Real> struct SlidingFace {
    Vec3<Real> normal;                 // unit normal n
    Vec3<Real> centre, along, across;  // ρ [m] from the slider's centre
    Vec3<Real> velocity;               // u' of the slider's centre [m/s]
    Vec3<Real> spin;                   // ω of the slider [rad/s]
};

template <class Real> struct FrictionLoad {
    Vec3<Real> force;   // [N]
    Vec3<Real> torque;  // about the slider's centre [N m]
    Real power;         // Σ μ F V, what friction takes [W]
};

/// No friction: no code.
struct NoFriction {
    static constexpr bool enabled = false;
};

/// Stick–slip friction.  Source: Qian et al. 2020 (5)–(6), whose garbled cases continuity at Vs and Vd settles.
struct StickSlipFriction {
    static constexpr bool enabled = true;

    /// −μ(V) F v_t/V at the four apices of a face, v = u' + ω × ρ and v_t = v − (v·n)n, with all components.
    /// @param normal F of the four apices [N].
    template <class Real>
    SLIDEWAY_NOINLINE static FrictionLoad<Real> load(SlidingFace<Real> const& face, Quad<Real> const& normal,
                                                     FrictionParameters<Real> const& friction) {
        auto const v_centre = face.velocity + cross(face.spin, face.centre);
        auto const v_across = cross(face.spin, face.across);
        auto const v_along = cross(face.spin, face.along);
        auto const v_front = v_centre + v_along, v_rear = v_centre - v_along;
        FrictionLoad<Real> load;
        load.power = Real(0.0);
        auto const a = apex(v_front + v_across, face.normal, normal.a, friction, load.power);
        auto const b = apex(v_front - v_across, face.normal, normal.b, friction, load.power);
        auto const c = apex(v_rear - v_across, face.normal, normal.c, friction, load.power);
        auto const d = apex(v_rear + v_across, face.normal, normal.d, friction, load.power);
        auto const front = a + b, rear = c + d;
        load.force = front + rear;
        load.torque =
            cross(face.centre, load.force) + cross(face.across, (a + d) - (b + c)) + cross(face.along, front - rear);
        return load;
    }

    /// μ(V): μs sin(π V/2Vs) below Vs; (μs+μd)/2 + (μs−μd)/2 · cos(π (V−Vs)/(Vd−Vs)) up to Vd; μd above.  C¹.
    /// @param speed V >= 0 [m/s].
    template <class Real> SLIDEWAY_FN static Real coefficient(Real speed, FrictionParameters<Real> const& f) {
        auto const slipping = speed >= f.slip_speed;
        if (all(slipping)) return f.kinetic_coefficient;
        // Both curves are one sine on [−π/2, π/2]: cos(q) = sin(π/2 − q).
        Real const quarter(1.5707963267948966);
        auto const sticking = speed < f.stick_speed;
        Real const falling = max(fnma(speed - f.stick_speed, f.fall, quarter), negated(quarter));
        Real const sine = sin_quarter(select(sticking, speed * f.rise, falling));
        Real const half(0.5);
        Real const amplitude =
            select(sticking, f.static_coefficient, half * (f.static_coefficient - f.kinetic_coefficient));
        Real const offset = select(sticking, Real(0.0), half * (f.static_coefficient + f.kinetic_coefficient));
        return select(slipping, f.kinetic_coefficient, fma(amplitude, sine, offset));
    }

private:
    template <class Real>
    SLIDEWAY_FN static Vec3<Real> apex(Vec3<Real> const& v, Vec3<Real> const& n, Real normal,
                                       FrictionParameters<Real> const& friction, Real& power) {
        auto const v_t = v - dot(v, n) * n;
        Real const speed = sqrt(dot(v_t, v_t));
        Real const force = coefficient(speed, friction) * normal;
        power = fma(force, speed, power);
        // μ vanishes with V: any floor keeps the quotient finite.
        return negated(force / max(speed, Real(1e-300))) * v_t;
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
