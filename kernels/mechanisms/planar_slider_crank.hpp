#pragma once

#include "kernels/conditions.hpp"
#include "kernels/joint/apex.hpp"
#include "kernels/joint/contact_memory.hpp"
#include "kernels/math/trigonometry.hpp"
#include "kernels/mechanisms/faults.hpp"
#include "kernels/mechanisms/planar_base.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// The planar slider-crank whose slider is a block between two walls (Flores, Leine & Glocker 2010; model.md 7).  State: θ1 θ2 ψ
/// θ1' θ2' ψ', absolute angles of crank, rod and slider.  Penetration of corner (s3, s1):
///   δ = s1 (y + s3 a sin ψ) − 2b sin²(ψ/2) − c,   y = l1 sin θ1 + l2 sin θ2,
/// with the point law at each corner, its force along Y, friction along X.  Unless the crank is free a drive holds it at ω: θ1 = θ0 + ω t.
struct PlanarSliderCrank : PlanarBase {
    template <class Real> using Memory = ContactMemory<Real, 1>;

    /// Time derivative of the state.
    /// @param report filled if Full; the derivative has the same bits without.
    template <bool Full, class Real, class Laws>
    SLIDEWAY_NOINLINE static Faults<Real> derivative(Real t, Real const* s, PlanarParameters<Real> const& p,
                                                     Memory<Real> const& memory, Conditions<Laws> const& block,
                                                     Real* rates, PlanarReport<Real>* report) {
        Links<Real> links(t, s, p, block.free_crank);
        Corners<Real> corners(links, s, p);
        if constexpr (Full) report->contact.start(corners.depth, corners.rate);
        auto push = corners.push_of_nothing();
        if (any(corners.deepest() > Real(0.0))) {
            Quad<Real> const elastic{load(corners.depth.a, p), load(corners.depth.b, p), load(corners.depth.c, p),
                                     load(corners.depth.d, p)};
            Quad<Real> force = damped(elastic, corners, memory, p, block.remembers);
            corners.add_normal(force, push);
            if (block.friction) {
                Real const power = corners.add_friction(force, links.vx, p, push);
                if constexpr (Full) report->contact.friction_power = power;
            }
            if constexpr (Full) report->contact.tell(force, elastic, p.point.potential_share);
        }
        auto motion = links.accelerations(push.fx, push.fy, p, block.free_crank);
        rates[0] = links.w1;
        rates[1] = links.w2;
        rates[2] = s[5];
        rates[3] = motion.a1;
        rates[4] = motion.a2;
        rates[5] = push.torque / p.slider_inertia;
        if constexpr (Full) links.tell(motion, s[5], p, block.free_crank, *report);
        return Faults<Real>::none();
    }

    /// Gap of a corner: its penetration negated [m].
    template <class Real, class Laws>
    SLIDEWAY_NOINLINE static Real gap(Real t, Real const* s, PlanarParameters<Real> const& p,
                                      Conditions<Laws> const& block, Apex corner) {
        auto const crank = sincos(block.free_crank ? s[0] : fma(p.crank_speed, t, p.start_angle));
        auto const tilt = sincos(s[2]);
        Real const y = fma(p.crank_length, crank.sin, p.rod_length * sincos(s[1]).sin);
        Real const lift = p.half_length * tilt.sin, base = fma(p.half_height, tilt.versine, p.clearance);
        Real const height = corner.index < 2 ? y + lift : y - lift;
        bool const upper = corner.index == 0 || corner.index == 3;
        return base - (upper ? height : negated(height));
    }

private:
    /// Angular accelerations of crank and rod, and what the equation of the crank lacks without them.
    template <class Real> struct LinkMotion { Real a1, a2, r1, m12; };

    /// Crank and rod, and their common end: the slider's centre.
    template <class Real> struct Links {
        Real w1, w2;
        SinCos<Real> crank, rod;
        Real x1, y1, x2, y2;
        Real y, vx, vy;

        SLIDEWAY_FN Links(Real t, Real const* s, PlanarParameters<Real> const& p, bool free_crank) {
            w1 = free_crank ? s[3] : p.crank_speed;
            w2 = s[4];
            crank = sincos(free_crank ? s[0] : fma(p.crank_speed, t, p.start_angle));
            rod = sincos(s[1]);
            x1 = p.crank_length * crank.cos;
            y1 = p.crank_length * crank.sin;
            x2 = p.rod_length * rod.cos;
            y2 = p.rod_length * rod.sin;
            y = y1 + y2;
            vx = negated(fma(y1, w1, y2 * w2));
            vy = fma(x1, w1, x2 * w2);
        }

        /// M(θ) θ'' = R: inertia of the links, gravity, and the force on their common end.
        SLIDEWAY_FN LinkMotion<Real> accelerations(Real fx, Real fy, PlanarParameters<Real> const& p, bool free_crank) const {
            Real const zero(0.0), one(1.0);
            Real const cosine = fma(crank.cos, rod.cos, crank.sin * rod.sin);
            Real const sine = fms(crank.sin, rod.cos, crank.cos * rod.sin);
            Real const m12 = p.m12 * cosine, centrifugal = p.m12 * sine;
            Real const pull_1 = fms(p.gravity_y, crank.cos, p.gravity_x * crank.sin);
            Real const pull_2 = fms(p.gravity_y, rod.cos, p.gravity_x * rod.sin);
            Real const r1 = fma(p.crank_moment, pull_1, fms(x1, fy, y1 * fx)) - centrifugal * (w2 * w2);
            Real const r2 = fma(p.rod_moment, pull_2, fms(x2, fy, y2 * fx)) + centrifugal * (w1 * w1);
            if (!free_crank) return {zero, r2 / p.m22, r1, m12};
            Real const scale = one / fms(p.m11, p.m22, m12 * m12);
            return {fms(p.m22, r1, m12 * r2) * scale, fms(p.m11, r2, m12 * r1) * scale, r1, m12};
        }

        SLIDEWAY_FN void tell(LinkMotion<Real> const& motion, Real w3, PlanarParameters<Real> const& p, bool free_crank,
                              PlanarReport<Real>& report) const {
            Real const zero(0.0), half(0.5);
            Real const &a1 = motion.a1, &a2 = motion.a2;
            report.x = x1 + x2;
            report.y = y;
            report.vx = vx;
            report.vy = vy;
            report.acceleration = {negated(fma(x1, w1 * w1, fma(y1, a1, fma(x2, w2 * w2, y2 * a2)))),
                                   fma(x1, a1, fma(x2, a2, negated(fma(y1, w1 * w1, y2 * (w2 * w2))))), zero};
            report.top = report.front = zero;  // sensors that it has not
            Real const drive = free_crank ? zero : fms(motion.m12, a2, motion.r1);
            report.crank_torque = report.drive_torque = drive;  // the crank's weight is in the equations
            report.crank_power = drive * w1;
            Real const kinetic = half * fma(p.m11 * w1, w1, fma(p.m22 * w2, w2, p.slider_inertia * w3 * w3));
            Real const height = fma(p.crank_moment, fma(p.gravity_x, crank.cos, p.gravity_y * crank.sin),
                                    p.rod_moment * fma(p.gravity_x, rod.cos, p.gravity_y * rod.sin));
            report.energy = (fma(motion.m12 * w1, w2, kinetic) - height) + report.contact.potential;
            report.position_error = report.distance_error(x2, y1, y, p.rod_length);
            report.rod_spin = abs(w2);
        }
    };

    /// Force on the slider's centre and torque about it.
    template <class Real> struct Push { Real fx, fy, torque; };

    /// δ of the corners and its parts that are linear in the signs.
    template <class Real> struct Corners {
        Quad<Real> depth, rate;
        Real front, rear, base;
        Real lift, lift_slope, base_slope, tall, w3;

        SLIDEWAY_FN Corners(Links<Real> const& links, Real const* s, PlanarParameters<Real> const& p) {
            auto tilt = sincos(s[2]);
            w3 = s[5];
            lift = p.half_length * tilt.sin;
            base = fma(p.half_height, tilt.versine, p.clearance);
            lift_slope = p.half_length * tilt.cos;
            base_slope = p.half_height * tilt.sin;
            tall = p.half_height * tilt.cos;
            front = links.y + lift;
            rear = links.y - lift;
            depth = {front - base, negated(front) - base, negated(rear) - base, rear - base};
            Real const front_rate = fma(lift_slope, w3, links.vy), rear_rate = fnma(lift_slope, w3, links.vy);
            Real const base_rate = base_slope * w3;
            rate = {front_rate - base_rate, negated(front_rate) - base_rate, negated(rear_rate) - base_rate,
                    rear_rate - base_rate};
        }

        SLIDEWAY_FN Real deepest() const { return max(max(depth.a, depth.b), max(depth.c, depth.d)); }

        /// 0, or NaN in a lane whose angles are, whatever its neighbours touch.
        SLIDEWAY_FN Push<Real> push_of_nothing() const {
            Real const whole = front + (rear + base), nothing = whole - whole;
            return {nothing, nothing, nothing};
        }

        /// −F ∂δ/∂q of each corner.
        SLIDEWAY_FN void add_normal(Quad<Real> const& force, Push<Real>& push) const {
            push.fy = push.fy + ((force.b - force.a) + (force.c - force.d));
            push.torque = push.torque + fma(lift_slope, (force.b - force.a) + (force.d - force.c), base_slope * sum(force));
        }

        /// @return Σ μ F V [W].  @param vx of the slider's centre
        SLIDEWAY_FN Real add_friction(Quad<Real> const& force, Real vx, PlanarParameters<Real> const& p,
                                      Push<Real>& push) const {
            Real power(0.0);
            auto const rub = [&](Real load, Real height) {  // height of the corner over the slider's centre
                Real const slip = fnma(height, w3, vx), speed = abs(slip);
                Real const drag = StickSlipFriction::coefficient(speed, p.friction) * load;
                Real const along = negated(drag) * (slip / max(speed, Real(1e-70)));
                push.fx = push.fx + along;
                push.torque = fnma(height, along, push.torque);
                power = fma(drag, speed, power);
            };
            rub(force.a, lift + tall);
            rub(force.b, lift - tall);
            rub(force.c, negated(lift) - tall);
            rub(force.d, tall - lift);
            return power;
        }
    };

    template <class Real> SLIDEWAY_FN static Real load(Real depth, PlanarParameters<Real> const& p) {
        auto const touches = depth > Real(0.0);
        Real const safe = select(touches, depth, Real(1.0));
        return select(touches, point_load(safe, p.point), Real(0.0));
    }

    template <class Real>
    SLIDEWAY_FN static Quad<Real> damped(Quad<Real> const& elastic, Corners<Real> const& c, Memory<Real> const& memory,
                                         PlanarParameters<Real> const& p, bool remembers) {
        auto const& v0 = memory.impact_speed[0];
        auto const of = [&](Real load, Real depth, Real rate, Real speed) {
            ApexMotion<Real> const corner{depth, rate, max(speed, Real(least_impact_speed))};
            Real const force = remembers ? RestitutionDamping::point_force(load, corner, p.point, p.damping)
                                         : PointDamping::point_force(load, corner, p.point, p.damping);
            return select(depth > Real(0.0), force, Real(0.0));
        };
        return {of(elastic.a, c.depth.a, c.rate.a, v0.a), of(elastic.b, c.depth.b, c.rate.b, v0.b),
                of(elastic.c, c.depth.c, c.rate.c, v0.c), of(elastic.d, c.depth.d, c.rate.d, v0.d)};
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
