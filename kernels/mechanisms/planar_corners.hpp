#pragma once

#include "kernels/joint/apex.hpp"
#include "kernels/joint/point_pair.hpp"
#include "kernels/laws/face.hpp"
#include "kernels/mechanisms/planar_links.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Force on the slider's centre and torque about it.
template <class Real> struct PlanarPush { Real fx, fy, torque; };

/// δ of the corners and its parts that are linear in the signs.
template <class Real> struct PlanarCorners {
    Quad<Real> depth, rate;
    Real front, rear, base;
    Real lift, lift_slope, base_slope, tall, w3;

    SLIDEWAY_FN PlanarCorners(PlanarLinks<Real> const& links, Real const* s, PlanarParameters<Real> const& p)
        : PlanarCorners(links.y, links.vy, s[2], s[5], p) {}

    /// @param y, vy of the block's centre across the walls  @param pitch, spin of the block against them  @param p has half_length, half_height, clearance
    template <class Parameters> SLIDEWAY_FN PlanarCorners(Real y, Real vy, Real pitch, Real spin, Parameters const& p) {
        auto tilt = sincos(pitch);
        w3 = spin;
        lift = p.half_length * tilt.sin;
        base = fma(p.half_height, tilt.versine, p.clearance);
        lift_slope = p.half_length * tilt.cos;
        base_slope = p.half_height * tilt.sin;
        tall = p.half_height * tilt.cos;
        front = y + lift;
        rear = y - lift;
        depth = {front - base, negated(front) - base, negated(rear) - base, rear - base};
        Real const front_rate = fma(lift_slope, w3, vy), rear_rate = fnma(lift_slope, w3, vy);
        Real const base_rate = base_slope * w3;
        rate = {front_rate - base_rate, negated(front_rate) - base_rate, negated(rear_rate) - base_rate,
                rear_rate - base_rate};
    }

    SLIDEWAY_FN Real deepest() const { return max(max(depth.a, depth.b), max(depth.c, depth.d)); }

    /// 0, or NaN in a lane whose angles are, whatever its neighbours touch.
    SLIDEWAY_FN PlanarPush<Real> push_of_nothing() const {
        Real const whole = front + (rear + base), nothing = whole - whole;
        return {nothing, nothing, nothing};
    }

    /// Elastic forces [N].
    SLIDEWAY_FN Quad<Real> loads(PointContact<Real> const& point) const {
        return {pair_load(depth.a, point), pair_load(depth.b, point), pair_load(depth.c, point), pair_load(depth.d, point)};
    }
    /// The same with their damping.  @param v0 δ' of the last touches, which count if `remembers`
    SLIDEWAY_FN Quad<Real> damped(Quad<Real> const& elastic, Quad<Real> const& v0, PointContact<Real> const& point, DampingParameters<Real> const& damping,
                                  bool remembers) const {
        auto const of = [&](Real load, Real deep, Real rate_of, Real speed) { return pair_force(load, deep, rate_of, speed, point, damping, remembers); };
        return {of(elastic.a, depth.a, rate.a, v0.a), of(elastic.b, depth.b, rate.b, v0.b), of(elastic.c, depth.c, rate.c, v0.c),
                of(elastic.d, depth.d, rate.d, v0.d)};
    }

    /// −F ∂δ/∂q of each corner.
    SLIDEWAY_FN void add_normal(Quad<Real> const& force, PlanarPush<Real>& push) const {
        push.fy = push.fy + ((force.b - force.a) + (force.c - force.d));
        push.torque = push.torque + fma(lift_slope, (force.b - force.a) + (force.d - force.c), base_slope * sum(force));
    }

    /// @return Σ μ F V [W].  @param vx of the slider's centre
    template <class Parameters>
    SLIDEWAY_FN Real add_friction(Quad<Real> const& force, Real vx, Parameters const& p, PlanarPush<Real>& push) const {
        Real power(0.0);
        auto const rub = [&](Real load, Real height) {  // height of the corner over the slider's centre
            Real const along = pair_friction(fnma(height, w3, vx), load, p.friction, power);
            push.fx = push.fx + along;
            push.torque = fnma(height, along, push.torque);
        };
        rub(force.a, lift + tall);
        rub(force.b, lift - tall);
        rub(force.c, negated(lift) - tall);
        rub(force.d, tall - lift);
        return power;
    }
};

/// Gap of a corner: its penetration negated [m].
template <class Real>
SLIDEWAY_FN Real planar_gap(Real t, Real const* s, PlanarParameters<Real> const& p, DrivePlan const& drive, Apex corner) {
    auto const crank = sincos(given_crank(drive, t, s[0], s[3], p).place);
    auto const tilt = sincos(s[2]);
    Real const y = fma(p.crank_length, crank.sin, p.rod_length * sincos(s[1]).sin);
    Real const lift = p.half_length * tilt.sin, base = fma(p.half_height, tilt.versine, p.clearance);
    Real const height = corner.index < 2 ? y + lift : y - lift;
    bool const upper = corner.index == 0 || corner.index == 3;
    return base - (upper ? height : negated(height));
}

}  // namespace slideway::inline SLIDEWAY_ISA
