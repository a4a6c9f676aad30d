#pragma once

#include "kernels/laws/face.hpp"
#include "kernels/mechanisms/event_info.hpp"
#include "kernels/real.hpp"
#include "kernels/steppers/contact_watch.hpp"
#include "kernels/steppers/cubic_roots.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Where steps of a member with rigid contacts end: a corner meets its wall, a lasting contact opens, slips the other way, or no longer
/// sticks.
template <class Real> class RigidWatch {
public:
    /// What pressure and grip may fall below 0 by.
    static constexpr double slack = 1e-9;

    /// Remembers what the next step starts from.
    template <class Contact> SLIDEWAY_FN void keep(Mask<Real> taken, Contact const& contact) {
        auto const take = [&](Real from, Real& to) { to = select(taken, from, to); };
        auto const take_quad = [&](Quad<Real> const& from, Quad<Real>& to) {
            take(from.a, to.a);
            take(from.b, to.b);
            take(from.c, to.c);
            take(from.d, to.d);
        };
        take_quad(contact.watched[0], depth_);
        take_quad(contact.rate[0], rate_);
        for (int i = 0; i < 2; ++i) {
            take(contact.pressure[i], pressure_[i]);
            take(contact.grip[i], grip_[i]);
        }
    }

    /// Fraction of the step at which the first event is, 1 where none is before the end or the end is the event.
    /// @param located depth [m] up to which it counts as that
    template <class Contact>
    SLIDEWAY_FN Real earliest(Mask<Real> candidates, Contact const& end, Real step, Real located, Watching) const {
        Real fraction(1.0);
        auto const& depth = end.watched[0];
        auto const& rate = end.rate[0];
        auto const meet = [&](Real d0, Real v0, Real d1, Real v1) {
            fraction = min(fraction, meeting(candidates, {d0, step * v0, d1, step * v1}, located));
        };
        meet(depth_.a, rate_.a, depth.a, rate.a);
        meet(depth_.b, rate_.b, depth.b, rate.b);
        meet(depth_.c, rate_.c, depth.c, rate.c);
        meet(depth_.d, rate_.d, depth.d, rate.d);
        for (int i = 0; i < 2; ++i) {
            fraction = min(fraction, min(falling(candidates, pressure_[i], end.pressure[i]), falling(candidates, grip_[i], end.grip[i])));
        }
        return fraction;
    }

private:
    /// A depth and its slope at both ends of [0, 1].
    struct Curve { Real v0, s0, v1, s1; };

    /// Where a corner first comes to its wall from inside.
    SLIDEWAY_FN static Real meeting(Mask<Real> candidates, Curve curve, Real located) {
        Real const zero(0.0), one(1.0);
        // What ends on its wall is at its event, and what came there before is found all the same.  A corner that only leaves its wall is
        // not there again, whatever rounding makes of heights that are next to nothing.
        auto const leaves = (max(curve.s0, curve.s1) <= zero) & (max(abs(curve.v0), abs(curve.v1)) <= Real(64.0) * located);
        curve.v0 = min(curve.v0, zero);
        curve.v1 = select((abs(curve.v1) <= located) | leaves, negated(located), curve.v1);
        // What lasts was put back onto its wall, and may have brought another corner a hair inside: that meets its wall at once.
        auto const at_once = candidates & (curve.v0 >= zero) & (curve.s0 > zero);
        auto const crossing = candidates & !at_once & may_cross(curve.v0, curve.s0, curve.v1, curve.s1);
        Real const soonest = select(at_once, Real(1e-12), one);
        if (none(crossing)) return soonest;
        return min(soonest, first_zero(crossing, curve));
    }

    SLIDEWAY_NOINLINE static Real first_zero(Mask<Real> crossing, Curve const& curve) {
        auto const rises = cubic_zeros(crossing, curve.v0, curve.s0, curve.v1, curve.s1, Direction::rising);
        // A step that is cut must become shorter, whatever rounding says.
        Real const first = min(rises.at[0].theta, min(rises.at[1].theta, rises.at[2].theta));
        return select(rises.any, min(first, Real(1 - 1e-12)), Real(1.0));
    }

    /// Where a number that must not be negative falls just below 0, by the straight line through both ends.
    SLIDEWAY_FN static Real falling(Mask<Real> candidates, Real before, Real after) {
        auto const falls = candidates & (after < Real(-slack));
        Real const start = max(before, Real(0.0));
        Real const fraction = (start + Real(0.5 * slack)) / select(falls, start - after, Real(1.0));
        return select(falls, min(max(fraction, Real(0.01)), Real(0.99)), Real(1.0));
    }

    Quad<Real> depth_, rate_;
    Real pressure_[2], grip_[2];
};

}  // namespace slideway::inline SLIDEWAY_ISA
