#pragma once

#include "kernels/joint/point_pair.hpp"
#include "kernels/linkage/linkage_motion.hpp"
#include "kernels/linkage/linkage_parameters.hpp"
#include "kernels/linkage/linkage_report.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// A journal of one body in the bearing of another.  With e from the bearing's centre to the journal's
///   δ = |e| − c,  δ' = e·e'/|e|,  F = K δⁿ and its damping, along −e/|e| on the journal, at its point that is next to the bearing;
/// friction −μ(|v|) F v/|v| there, v = ⊥e/|e| · (e' − ω_B ⊥e) + R_A (ω_A − ω_B), so that no couple is left over and its power is −μ F |v|.
/// Source: docs/explanation/linkages.md, after Flores, Ambrósio, Claro and Lankarani (2008).
/// @tparam Motion LinkageMotion
template <class Motion> struct Journal {
    using Real = typename Motion::Real;
    int closure;
    LinkagePoint<Real> pin, hole;
    Vec2<Real> outward;  // e/|e|
    Real distance, depth, rate;

    SLIDEWAY_FN Journal(Motion const& motion, int at) : closure(at) {
        auto const& of = motion.plan()->closure[at];
        auto const& numbers = motion.numbers().closure[at];
        pin = motion.point(of.body[0], numbers.point[0], of.arm[0]);
        hole = motion.point(of.body[1], numbers.point[1], of.arm[1]);
        auto const e = pin.place - hole.place;
        distance = sqrt(max(dot(e, e), Real(1e-60)));
        Real const inverse = Real(1.0) / distance;
        outward = inverse * e;
        depth = distance - numbers.clearance;
        rate = dot(outward, pin.velocity - hole.velocity);
    }

    /// Pushes both bodies.  @param v0 δ' of the last touch, where that counts  @param told what a report has of the contact; nullptr: nothing
    SLIDEWAY_FN void push(Motion& motion, Real v0, bool remembers, bool has_friction, LinkageContact<Real>* told) const {
        Real const zero(0.0), one(1.0);
        auto const& p = motion.numbers();
        auto const& numbers = p.closure[closure];
        Real const elastic = pair_load(depth, numbers.contact);
        Real const force = pair_force(elastic, depth, rate, v0, numbers.contact, p.damping, remembers);
        auto const& of = motion.plan()->closure[closure];
        auto pushed = negated(force) * outward;
        Real loss = zero;
        if (has_friction) {
            auto const aside = across(outward);
            Real const spin = motion.spin(of.body[1]), between = motion.spin(of.body[0]) - spin;
            Real const slip = fma(numbers.journal, between, fnma(spin, distance, dot(aside, pin.velocity - hole.velocity)));
            pushed = add(pushed, pair_friction(slip, force, p.friction, loss), aside);
        }
        // The same point of both.
        auto const at_pin = add(pin.arm, numbers.journal, outward), at_hole = at_pin + ((pin.place - pin.arm) - (hole.place - hole.arm));
        motion.push(of.body[0], at_pin, pushed);
        motion.push(of.body[1], at_hole, negated(one) * pushed);
        if (told == nullptr) return;
        LinkageContact<Real>::at(told->normal_force, of.pair) = force;
        told->force[closure] = force;
        told->potential = fma(numbers.contact.potential_share * elastic, max(depth, zero), told->potential);
        told->damping_power = fma(force - elastic, rate, told->damping_power);
        told->elastic_power = fma(elastic, rate, told->elastic_power);
        told->friction_power = told->friction_power + loss;
        told->points = told->points + count<Real>(depth > zero);
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
