#pragma once

#include <type_traits>

#include "kernels/block.hpp"
#include "kernels/joint/contact_report.hpp"
#include "kernels/math/trigonometry.hpp"
#include "kernels/mechanisms/faults.hpp"
#include "kernels/mechanisms/no_memory.hpp"
#include "kernels/mechanisms/planar_parameters.hpp"
#include "kernels/mechanisms/planar_report.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Of the planar slider's corners.
template <class Real> struct CornerMemory : ImpactSpeeds<Real, 1> {};

/// What all planar slider-cranks share.
struct PlanarBase {
    using Inputs = slideway::Inputs;
    static constexpr int size = info(Mechanism::planar_slider_crank).states;
    static constexpr bool can_hold = false;
    template <class Real> using Parameters = PlanarParameters<Real>;
    template <class Real> using Report = PlanarReport<Real>;

    /// Sizes against which integrator.atol is meant: c/l1, c/l2, 2c/L_k, and times ω.
    template <class Real> SLIDEWAY_FN static void scales(PlanarParameters<Real> const& p, Real* scale) {
        scale[0] = p.clearance / p.crank_length;
        scale[1] = p.clearance / p.rod_length;
        scale[2] = p.clearance / p.half_length;
        for (int i = 0; i < 3; ++i) scale[3 + i] = scale[i] * p.rate_scale;
    }

    /// Energy of the slider at the scale of its velocity, M (c ω)² [J], against which the audit's absolute tolerance is meant.
    template <class Real> SLIDEWAY_FN static Real energy_scale(PlanarParameters<Real> const& p) {
        Real const speed = p.clearance * p.rate_scale;
        return p.slider_mass * speed * speed;
    }

    /// Length [m] against which the tolerance of a located touch is meant.
    template <class Real> SLIDEWAY_FN static Real touch_scale(PlanarParameters<Real> const& p) { return p.clearance; }

    SLIDEWAY_HD static PlanarParameters<double> parameters(Inputs const& inputs) { return planar_parameters(inputs); }

    /// θ2 and its rate follow from the slider's y and vy: l1 sin θ1 + l2 sin θ2 = y.  NaN where the rod does not reach.
    SLIDEWAY_HD static void initial_state(Inputs const& in, double* s) {
        auto const crank = sincos(in.start_angle);
        double const sine = (in.y - in.crank_length * crank.sin) / in.rod_length;
        s[0] = in.start_angle;
        s[1] = ::asin(sine);
        s[2] = in.pitch;
        s[3] = in.crank_speed;
        s[4] = (in.vy - in.crank_length * crank.cos * in.crank_speed) / (in.rod_length * ::sqrt(1 - sine * sine));
        s[5] = in.wz;
    }

    /// Which component of the state an entry of `series_table` is; -1 if none.
    SLIDEWAY_HD static constexpr int state_of_series(int series) {
        for (int i = 0; i < size; ++i) {
            if (static_cast<int>(info(Mechanism::planar_slider_crank).state[i]) == series) return i;
        }
        return -1;
    }

    /// An impact speed as it may be remembered: a shadow's is carried on from the member's.
    template <class Real> SLIDEWAY_HD static Real remembered(Real speed) {
        return max(speed, Real(least_impact_speed));
    }
};

/// The planar slider-crank whose slider is a block between two walls (Flores, Leine & Glocker 2010; model.md 7).  State: θ1 θ2 ψ
/// θ1' θ2' ψ', absolute angles of crank, rod and slider.  Penetration of corner (s3, s1):
///   δ = s1 (y + s3 a sin ψ) − 2b sin²(ψ/2) − c,   y = l1 sin θ1 + l2 sin θ2,
/// with the point law at each corner, its force along Y, friction along X.
/// @tparam free_crank no drive holds the crank at ω; else θ1 = θ0 + ω t.
template <class Friction, class Damping, bool free_crank> struct PlanarSliderCrank : PlanarBase {
    static constexpr bool has_memory = Damping::has_memory;
    template <class Real> using Memory = std::conditional_t<has_memory, CornerMemory<Real>, NoMemory<Real>>;

    /// Time derivative of the state.
    /// @param report filled if Full; the derivative has the same bits without.
    template <bool Full, class Real>
    SLIDEWAY_NOINLINE static Faults<Real> derivative(Real t, Real const* s, PlanarParameters<Real> const& p,
                                                     Memory<Real> const& memory, Real* rates,
                                                     PlanarReport<Real>* report) {
        Real const zero(0.0), one(1.0), half(0.5);
        Real const w1 = free_crank ? s[3] : p.crank_speed, w2 = s[4], w3 = s[5];
        auto const crank = sincos(free_crank ? s[0] : fma(p.crank_speed, t, p.start_angle));
        auto const rod = sincos(s[1]), block = sincos(s[2]);
        Real const x1 = p.crank_length * crank.cos, y1 = p.crank_length * crank.sin;
        Real const x2 = p.rod_length * rod.cos, y2 = p.rod_length * rod.sin;
        Real const y = y1 + y2, vx = negated(fma(y1, w1, y2 * w2)), vy = fma(x1, w1, x2 * w2);

        // Corners: δ and its parts that are linear in the signs.
        Real const lift = p.half_length * block.sin, base = fma(p.half_height, block.versine, p.clearance);
        Real const lift_slope = p.half_length * block.cos, base_slope = p.half_height * block.sin;
        Real const front = y + lift, rear = y - lift;
        Quad<Real> const depth{front - base, negated(front) - base, negated(rear) - base, rear - base};
        Real const front_rate = fma(lift_slope, w3, vy), rear_rate = fnma(lift_slope, w3, vy);
        Real const base_rate = base_slope * w3;
        Quad<Real> const rate{front_rate - base_rate, negated(front_rate) - base_rate, negated(rear_rate) - base_rate,
                              rear_rate - base_rate};
        // 0, or NaN in a lane whose angles are, whatever its neighbours touch.
        Real const whole = front + (rear + base), nothing = whole - whole;
        Real fx = nothing, fy = nothing, torque = nothing;
        Quad<Real> force{zero, zero, zero, zero}, elastic = force;
        if constexpr (Full) clear(report->contact, depth, rate);
        if (any(deepest(depth) > zero)) {
            Quad<Real> speeds{zero, zero, zero, zero};
            if constexpr (has_memory) speeds = memory.speeds[0];
            elastic = {load(depth.a, p), load(depth.b, p), load(depth.c, p), load(depth.d, p)};
            force = {damped(elastic.a, depth.a, rate.a, speeds.a, p), damped(elastic.b, depth.b, rate.b, speeds.b, p),
                     damped(elastic.c, depth.c, rate.c, speeds.c, p), damped(elastic.d, depth.d, rate.d, speeds.d, p)};
            // −F ∂δ/∂q of each corner.
            fy = fy + ((force.b - force.a) + (force.c - force.d));
            torque = torque + fma(lift_slope, (force.b - force.a) + (force.d - force.c), base_slope * sum(force));
            if constexpr (Friction::enabled) {
                Real const tall = p.half_height * block.cos;
                Real power = zero;
                auto const rub = [&](Real load, Real height) {  // height of the corner over the slider's centre
                    Real const slip = fnma(height, w3, vx), speed = abs(slip);
                    Real const drag = Friction::coefficient(speed, p.friction) * load;
                    Real const along = negated(drag) * (slip / max(speed, Real(1e-70)));
                    fx = fx + along;
                    torque = fnma(height, along, torque);
                    power = fma(drag, speed, power);
                };
                rub(force.a, lift + tall);
                rub(force.b, lift - tall);
                rub(force.c, negated(lift) - tall);
                rub(force.d, tall - lift);
                if constexpr (Full) report->contact.friction_power = power;
            }
            if constexpr (Full) tell(report->contact, force, elastic, p);
        }

        // M(θ) θ'' = R: inertia of the links, gravity, and the force on their common end.
        Real const cosine = fma(crank.cos, rod.cos, crank.sin * rod.sin);
        Real const sine = fms(crank.sin, rod.cos, crank.cos * rod.sin);
        Real const m12 = p.m12 * cosine, centrifugal = p.m12 * sine;
        Real const pull_1 = fms(p.gravity_y, crank.cos, p.gravity_x * crank.sin);
        Real const pull_2 = fms(p.gravity_y, rod.cos, p.gravity_x * rod.sin);
        Real const r1 = fma(p.crank_moment, pull_1, fms(x1, fy, y1 * fx)) - centrifugal * (w2 * w2);
        Real const r2 = fma(p.rod_moment, pull_2, fms(x2, fy, y2 * fx)) + centrifugal * (w1 * w1);
        Real a1 = zero, a2 = zero;
        if constexpr (free_crank) {
            Real const scale = one / fms(p.m11, p.m22, m12 * m12);
            a1 = fms(p.m22, r1, m12 * r2) * scale;
            a2 = fms(p.m11, r2, m12 * r1) * scale;
        } else {
            a2 = r2 / p.m22;
        }
        rates[0] = w1;
        rates[1] = w2;
        rates[2] = w3;
        rates[3] = a1;
        rates[4] = a2;
        rates[5] = torque / p.slider_inertia;

        if constexpr (Full) {
            report->x = x1 + x2;
            report->y = y;
            report->vx = vx;
            report->vy = vy;
            report->acceleration = {negated(fma(x1, w1 * w1, fma(y1, a1, fma(x2, w2 * w2, y2 * a2)))),
                                    fma(x1, a1, fma(x2, a2, negated(fma(y1, w1 * w1, y2 * (w2 * w2))))), zero};
            report->top = report->front = zero;
            Real const drive = free_crank ? zero : fms(m12, a2, r1);
            report->crank_torque = report->drive_torque = drive;
            report->crank_power = drive * w1;
            Real const kinetic = half * fma(p.m11 * w1, w1, fma(p.m22 * w2, w2, p.slider_inertia * w3 * w3));
            Real const height = fma(p.crank_moment, fma(p.gravity_x, crank.cos, p.gravity_y * crank.sin),
                                    p.rod_moment * fma(p.gravity_x, rod.cos, p.gravity_y * rod.sin));
            report->energy = (fma(m12 * w1, w2, kinetic) - height) + report->contact.potential;
            // x − x_ideal as in SliderReport::fill.
            Real const ideal = sqrt(max(fnma(y1, y1, p.rod_length * p.rod_length), zero));
            Real const shift = y * (y1 + y1 - y) / (x2 + ideal);
            report->position_error = sqrt(fma(shift, shift, y * y));
            report->rod_spin = abs(w2);
        }
        return Faults<Real>::none();
    }

    /// Gap of a corner: its penetration negated [m].  @param corner a b c d from 0
    template <class Real>
    SLIDEWAY_NOINLINE static Real gap(Real t, Real const* s, PlanarParameters<Real> const& p, bool, int corner) {
        auto const crank = sincos(free_crank ? s[0] : fma(p.crank_speed, t, p.start_angle));
        auto const block = sincos(s[2]);
        Real const y = fma(p.crank_length, crank.sin, p.rod_length * sincos(s[1]).sin);
        Real const lift = p.half_length * block.sin, base = fma(p.half_height, block.versine, p.clearance);
        Real const height = corner < 2 ? y + lift : y - lift;
        bool const upper = corner == 0 || corner == 3;
        return base - (upper ? height : negated(height));
    }

private:
    template <class Real> SLIDEWAY_FN static Real deepest(Quad<Real> const& q) {
        return max(max(q.a, q.b), max(q.c, q.d));
    }

    template <class Real> SLIDEWAY_FN static Real load(Real depth, PlanarParameters<Real> const& p) {
        auto const touches = depth > Real(0.0);
        Real const safe = select(touches, depth, Real(1.0));
        return select(touches, point_load(safe, p.point), Real(0.0));
    }
    template <class Real>
    SLIDEWAY_FN static Real damped(Real elastic, Real depth, Real rate, Real speed, PlanarParameters<Real> const& p) {
        Real const v0 = max(speed, Real(least_impact_speed));
        return select(depth > Real(0.0), Damping::point_force(elastic, depth, rate, v0, p.point, p.damping), Real(0.0));
    }

    template <class Real>
    SLIDEWAY_FN static void clear(PlanarContact<Real>& contact, Quad<Real> const& depth, Quad<Real> const& rate) {
        Real const zero(0.0);
        contact.penetration[0] = depth;
        contact.rate[0] = rate;
        contact.normal_force[0] = {zero, zero, zero, zero};
        contact.surfaces = contact.lines = contact.points = zero;
        contact.potential = contact.friction_power = contact.damping_power = zero;
    }

    template <class Real>
    SLIDEWAY_FN static void tell(PlanarContact<Real>& contact, Quad<Real> const& force, Quad<Real> const& elastic,
                                 PlanarParameters<Real> const& p) {
        Real const zero(0.0);
        auto const& depth = contact.penetration[0];
        auto const& rate = contact.rate[0];
        contact.normal_force[0] = force;
        Real const stored = fma(elastic.a, max(depth.a, zero), elastic.b * max(depth.b, zero)) +
                            fma(elastic.c, max(depth.c, zero), elastic.d * max(depth.d, zero));
        contact.potential = p.point.potential_share * stored;
        contact.damping_power = fma(force.a - elastic.a, rate.a, (force.b - elastic.b) * rate.b) +
                                fma(force.c - elastic.c, rate.c, (force.d - elastic.d) * rate.d);
        auto const a = depth.a > zero, b = depth.b > zero, c = depth.c > zero, d = depth.d > zero;
        auto const upper = a & d, lower = b & c;
        contact.surfaces = count<Real>(upper) + count<Real>(lower);
        contact.points =
            (count<Real>(a & !upper) + count<Real>(d & !upper)) + (count<Real>(b & !lower) + count<Real>(c & !lower));
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
