#pragma once

#include "kernels/laws/apex_order.hpp"
#include "kernels/laws/face.hpp"
#include "kernels/math/trigonometry.hpp"
#include "kernels/math/vec3.hpp"
#include "kernels/real.hpp"
#include "kernels/simd/expect.hpp"

namespace slideway::inline SLIDEWAY_ISA {

template <class Real> struct FrictionParameters {
    Real static_coefficient;   // μs
    Real kinetic_coefficient;  // μd
    Real stick_speed;          // Vs [m/s]
    Real slip_speed;           // Vd [m/s]
    Real rise;                 // π/(2 Vs) [s/m]
    Real fall;                 // π/(Vd − Vs) [s/m]
};

/// One face as friction sees it, in the frame (x, main, across) of the face: main along its normal if the slider lies straight.
/// The apices lie at centre ± half_length along x ± half_across.
template <class Real> struct SlidingFace {
    Vec3<Real> normal;                // unit normal n
    Real centre_main, centre_across;  // of the apices' centre (0, main, across), from the slider's centre [m]
    Real half_length, half_across;    // [m]
    Vec3<Real> velocity;              // u' of the slider's centre [m/s]
    Vec3<Real> spin;                  // ω of the slider [rad/s]
};

template <class Real> struct FrictionLoad {
    Vec3<Real> force;   // [N]
    Vec3<Real> torque;  // about the slider's centre [N m]
    Real power;         // Σ μ F V, what friction takes [W]
};

/// What friction does to an apex per newton that it is pressed with.
template <class Real> struct Slip {
    Vec3<Real> drag;  // μ v_t/V, against the force
    Real power;       // μ V [m/s]
};

/// Stick–slip friction.  Source: Qian et al. 2020 (5)–(6), whose garbled cases continuity at Vs and Vd settles.
struct StickSlipFriction {
    /// v_t of the four apices of a face.
    template <class Real> SLIDEWAY_FN static Quad<Vec3<Real>> velocities(SlidingFace<Real> const& face) {
        Vec3<Real> w = face.spin;
        Vec3<Real> n = face.normal;
        Real const main = face.centre_main, across = face.centre_across;
        Real const length = face.half_length, width = face.half_across;
        Real const zero(0.0);
        // The velocity is affine in the apex's signs, and so is its tangential part.
        auto of_centre = tangential({fma(w.y, across, fnma(w.z, main, face.velocity.x)),
                                     fnma(w.x, across, face.velocity.y), fma(w.x, main, face.velocity.z)},
                                    n);
        auto of_length = tangential({zero, w.z * length, negated(w.y) * length}, n);
        auto of_width = tangential({w.y * width, negated(w.x) * width, zero}, n);
        auto front = of_centre + of_length, rear = of_centre - of_length;
        return {front + of_width, front - of_width, rear - of_width, rear + of_width};
    }

    /// −μ(V) F v_t/V at the four apices of a face, v = u' + ω × ρ and v_t = v − (v·n)n, with all components.
    /// @param normal F of the four apices [N].
    template <class Real>
    SLIDEWAY_NOINLINE static FrictionLoad<Real> load(SlidingFace<Real> const& face, Quad<Real> const& normal,
                                                     FrictionParameters<Real> const& friction) {
        Real const main = face.centre_main, across = face.centre_across;
        Real const length = face.half_length, width = face.half_across;
        auto [a, b, c, d] = velocities(face);
        Quad<Real> square{dot(a, a), dot(b, b), dot(c, c), dot(d, d)};
        Quad<Real> speed{sqrt(square.a), sqrt(square.b), sqrt(square.c), sqrt(square.d)};
        auto force = coefficients(speed, friction);
        force = {force.a * normal.a, force.b * normal.b, force.c * normal.c, force.d * normal.d};
        // 1/V = V/V², for the division need not wait for the root.  μ vanishes with V: any floor keeps the quotient finite.
        Real const floor(1e-70);
        auto inverse = reciprocals(
            Quad<Real>{max(square.a, floor), max(square.b, floor), max(square.c, floor), max(square.d, floor)});
        a = (force.a * (speed.a * inverse.a)) * a;
        b = (force.b * (speed.b * inverse.b)) * b;
        c = (force.c * (speed.c * inverse.c)) * c;
        d = (force.d * (speed.d * inverse.d)) * d;
        auto front = a + b, rear = c + d;
        auto drag = front + rear;  // against the force
        Real const along_y = front.y - rear.y, along_z = front.z - rear.z;
        Real const across_x = (a.x + d.x) - (b.x + c.x), across_y = (a.y + d.y) - (b.y + c.y);
        FrictionLoad<Real> load;
        load.force = {negated(drag.x), negated(drag.y), negated(drag.z)};
        load.torque = {fma(across, drag.y, fms(width, across_y, main * drag.z)),
                       fms(length, along_z, fma(across, drag.x, width * across_x)),
                       fms(main, drag.x, length * along_y)};
        load.power = fma(force.a, speed.a, fma(force.b, speed.b, fma(force.c, speed.c, force.d * speed.d)));
        return load;
    }

    /// μ v_t/V at the apices that touch, v = u' + ω × ρ, and what it takes per newton, μ V.  An apex that touches in no lane is left out.
    template <bool all, class Real>
    SLIDEWAY_FN static Quad<Slip<Real>> slips(SlidingFace<Real> const& face, ApexOrder<Real> const& order,
                                              Quad<Mask<Real>> const& touching, FrictionParameters<Real> const& friction) {
        Vec3<Real> w = face.spin;
        Vec3<Real> n = face.normal;
        Real const main = face.centre_main, across = face.centre_across;
        Real const length = face.half_length, width = face.half_across;
        Real const zero(0.0);
        auto velocity = order.template around<all>(tangential({fma(w.y, across, fnma(w.z, main, face.velocity.x)),
                                                                fnma(w.x, across, face.velocity.y), fma(w.x, main, face.velocity.z)},
                                                n),
                                     tangential({zero, w.z * length, negated(w.y) * length}, n),
                                     tangential({w.y * width, negated(w.x) * width, zero}, n));
        Quad<Slip<Real>> slips{slip(velocity.a, touching.a, friction), slip(velocity.b, touching.b, friction), {}, {}};
        if constexpr (all) slips.c = slip(velocity.c, touching.c, friction), slips.d = slip(velocity.d, touching.d, friction);
        return slips;
    }

    /// What those come to.
    template <bool all, class Real>
    SLIDEWAY_FN static FrictionLoad<Real> load(SlidingFace<Real> const& face, ApexOrder<Real> const& order,
                                               Quad<Slip<Real>> const& slips, Quad<Real> const& normal) {
        Real const main = face.centre_main, across = face.centre_across;
        Real const length = face.half_length, width = face.half_across;
        Quad<Vec3<Real>> drag{normal.a * slips.a.drag, normal.b * slips.b.drag, {}, {}};
        if constexpr (all) drag.c = normal.c * slips.c.drag, drag.d = normal.d * slips.d.drag;
        auto sum = order.template sums<all>(drag);
        FrictionLoad<Real> load;
        load.force = {negated(sum.all.x), negated(sum.all.y), negated(sum.all.z)};
        load.torque = {fma(across, sum.all.y, fms(width, sum.across.y, main * sum.all.z)),
                       fms(length, sum.along.z, fma(across, sum.all.x, width * sum.across.x)),
                       fms(main, sum.all.x, length * sum.along.y)};
        load.power = fma(normal.a, slips.a.power, normal.b * slips.b.power);
        if constexpr (all) load.power = load.power + fma(normal.c, slips.c.power, normal.d * slips.d.power);
        return load;
    }

    /// μ(V): μs sin(π V/2Vs) below Vs; (μs+μd)/2 + (μs−μd)/2 · cos(π (V−Vs)/(Vd−Vs)) up to Vd; μd above.  C¹.
    /// @param speed V >= 0 [m/s].
    template <class Real> SLIDEWAY_FN static Real coefficient(Real speed, FrictionParameters<Real> const& f) {
        SLIDEWAY_EXPECT(none(speed < Real(0.0)));
        auto const slipping = speed >= f.slip_speed;
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
    SLIDEWAY_FN static Slip<Real> slip(Vec3<Real> const& v, Mask<Real> touching, FrictionParameters<Real> const& friction) {
        Real const zero(0.0);
        if (none(touching)) return {{zero, zero, zero}, zero};
        Real const square = dot(v, v), speed = sqrt(square);
        auto const slow = touching & !(speed >= friction.slip_speed);
        Real const mu = any(slow) ? coefficient(speed, friction) : friction.kinetic_coefficient;
        Real const by_speed = mu * (speed * (Real(1.0) / max(square, Real(1e-70))));
        return {{select(touching, by_speed * v.x, zero), select(touching, by_speed * v.y, zero), select(touching, by_speed * v.z, zero)},
                select(touching, mu * speed, zero)};
    }

    /// μ of four apices.
    template <class Real>
    SLIDEWAY_FN static Quad<Real> coefficients(Quad<Real> const& speed, FrictionParameters<Real> const& f) {
        Real const slowest = min(min(speed.a, speed.b), min(speed.c, speed.d));
        Real const slip = f.kinetic_coefficient;
        if (all(slowest >= f.slip_speed)) return {slip, slip, slip, slip};
        return {coefficient(speed.a, f), coefficient(speed.b, f), coefficient(speed.c, f), coefficient(speed.d, f)};
    }

    /// v − (v·n)n.
    template <class Real> SLIDEWAY_FN static Vec3<Real> tangential(Vec3<Real> const& v, Vec3<Real> const& n) {
        Real const normal = dot(v, n);
        return {fnma(normal, n.x, v.x), fnma(normal, n.y, v.y), fnma(normal, n.z, v.z)};
    }
};

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
