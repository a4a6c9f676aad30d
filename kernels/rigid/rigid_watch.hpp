#pragma once

#include "kernels/laws/face.hpp"
#include "kernels/real.hpp"
#include "kernels/rigid/rigid_scales.hpp"
#include "kernels/steppers/contact_watch.hpp"
#include "kernels/steppers/cubic_roots.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Ends the steps of a member with rigid contacts where a pair that is not held meets: a corner its wall, an apex its face.
/// And where a number falls below 0 that may not while contact lasts.
/// @tparam quads of pairs: one per face of the clearance joint, one for the corners of the planar slider
/// @tparam Derived has a function see these numbers by `each_number`: in which lanes, as they were at the start of the step, as they are at its end
template <class Real, int quads, class Derived> class TouchWatch {
public:
    /// Remembers what the next step starts from.
    template <class Contact> SLIDEWAY_FN void keep(Mask<Real> taken, Contact const& contact) {
        for (int face = 0; face < quads; ++face) {
            depth_[face] = select(taken, contact.watched[face], depth_[face]);
            rate_[face] = select(taken, contact.rate[face], rate_[face]);
        }
    }

    /// Fraction of the step at which the first event is, 1 where none is before the end or the end is the event.
    /// @param located depth [m] up to which it counts as that
    template <class Contact>
    SLIDEWAY_FN Real earliest(Mask<Real> candidates, Contact const& end, Real step, Real located, Watching) const {
        Real fraction(1.0);
        auto const meet = [&](Real d0, Real v0, Real d1, Real v1) {
            fraction = min(fraction, meeting(candidates, {d0, step * v0, d1, step * v1}, located));
        };
        for (int face = 0; face < quads; ++face) each_of_four(meet, depth_[face], rate_[face], end.watched[face], end.rate[face]);
        static_cast<Derived const*>(this)->each_number(end, [&](Mask<Real> in, Real before, Real after) {
            fraction = min(fraction, falling(candidates & in, before, after));
        });
        return fraction;
    }

    /// Time until the next event, of a step that ends before all of them [s], as fast as what changes does; 0 where one is there, or none comes.
    /// @param step that has come so far [s]
    template <class Contact> SLIDEWAY_FN Real way_on(Contact const& end, Real step, Real located) const {
        Way way;
        auto const meet = [&](Real depth, Real rate) {
            auto const comes = rate > Real(0.0);
            way.add(comes & (depth < negated(located)), negated(depth) / select(comes, rate, Real(1.0)));
            way.is_there(comes & (depth >= negated(located)));
        };
        for (int face = 0; face < quads; ++face) each_of_four(meet, end.watched[face], end.rate[face]);
        static_cast<Derived const*>(this)->each_number(end, [&](Mask<Real> in, Real before, Real after) { way.fall(in, before, after, step); });
        return way.time();
    }

private:
    /// What a number that must not be negative may fall below 0 by.
    static constexpr double slack = 1e-9;

    /// The shortest of several times.
    class Way {
    public:
        SLIDEWAY_FN void add(Mask<Real> in, Real time) { least_ = select(in, min(least_, time), least_); }
        SLIDEWAY_FN void is_there(Mask<Real> in) { least_ = select(in, Real(0.0), least_); }
        /// Until a number falls to 0, by the straight line through both ends of the step.
        SLIDEWAY_FN void fall(Mask<Real> in, Real before, Real after, Real step) {
            auto const falls = in & (after < before) & (before > Real(slack));
            add(falls & (after > Real(slack)), step * after / select(falls, before - after, Real(1.0)));
            is_there(falls & (after <= Real(slack)));
        }
        SLIDEWAY_FN Real time() const { return select(least_ < Real(never), least_, Real(0.0)); }

    private:
        static constexpr double never = 1e300;
        Real least_ = Real(never);
    };

    /// Where it falls just below 0, by the straight line through both ends.
    SLIDEWAY_FN static Real falling(Mask<Real> candidates, Real before, Real after) {
        auto const falls = candidates & (after < Real(-slack));
        Real const start = max(before, Real(0.0));
        Real const fraction = (start + Real(0.5 * slack)) / select(falls, start - after, Real(1.0));
        return select(falls, min(max(fraction, Real(0.01)), Real(0.99)), Real(1.0));
    }

    /// A depth and its slope at both ends of [0, 1].
    struct Curve { Real v0, s0, v1, s1; };

    /// Where a pair first meets from inside.
    SLIDEWAY_FN static Real meeting(Mask<Real> candidates, Curve curve, Real located) {
        Real const zero(0.0), one(1.0);
        // What ends on zero is at its event, and what came there before is found all the same.  One that only leaves is
        // not there again, whatever rounding makes of heights that are next to nothing.
        auto const leaves = (max(curve.s0, curve.s1) <= zero) & (max(abs(curve.v0), abs(curve.v1)) <= Real(64.0) * located);
        // One that lasted may leave from a hair inside: it meets again where it comes as deep as it was.
        curve.v1 = curve.v1 - max(curve.v0, zero);
        curve.v0 = min(curve.v0, zero);
        curve.v1 = select((abs(curve.v1) <= located) | leaves, negated(located), curve.v1);
        // What lasts was put back, and may have brought another pair a hair inside: that meets at once.
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

    Quad<Real> depth_[quads], rate_[quads];
};

/// Where steps of a block between rigid walls end: a corner meets its wall, a lasting contact opens, slips the other way, or no longer
/// sticks.
template <class Real> class RigidWatch : public TouchWatch<Real, 1, RigidWatch<Real>> {
public:
    template <class Contact> SLIDEWAY_FN void keep(Mask<Real> taken, Contact const& contact) {
        TouchWatch<Real, 1, RigidWatch>::keep(taken, contact);
        for (int i = 0; i < 2; ++i) {
            pressure_[i] = select(taken, contact.pressure[i], pressure_[i]);
            grip_[i] = select(taken, contact.grip[i], grip_[i]);
        }
    }
    template <class Contact, class See> SLIDEWAY_FN void each_number(Contact const& end, See const& see) const {
        for (int i = 0; i < 2; ++i) {
            see(mask_of<Real>(true), pressure_[i], end.pressure[i]);
            see(mask_of<Real>(true), grip_[i], end.grip[i]);
        }
    }

private:
    Real pressure_[2], grip_[2];
};

/// Where steps of a slider in a rigid joint end: an apex meets its face, a pair that lasts comes to rest along it or begins to slip.
template <class Real> class JointWatch : public TouchWatch<Real, face_count, JointWatch<Real>> {
public:
    template <class Contact> SLIDEWAY_FN void keep(Mask<Real> taken, Contact const& contact) {
        TouchWatch<Real, face_count, JointWatch>::keep(taken, contact);
        for (int face = 0; face < face_count; ++face) {
            for (int j = 0; j < 2; ++j) slip_[j][face] = select(taken, contact.slip[j][face], slip_[j][face]);
            slides_[face] = select(taken, contact.slides[face], slides_[face]);
        }
    }
    /// Of each pair its slip, where it slides, along what that was, and what is left of it until one that sticks slips.
    template <class Contact, class See> SLIDEWAY_FN void each_number(Contact const& end, See const& see) const {
        auto const one_pair = [&](Real slides, Real u0, Real v0, Real u1, Real v1) {
            Real const zero(0.0), most(slip_again);
            if (none(slides != zero)) return;
            Real const start = sqrt(fma(u0, u0, v0 * v0));
            auto const moves = start > zero;
            Real const along = fma(u0, u1, v0 * v1) / select(moves, start, Real(1.0));
            Real const now = sqrt(fma(u1, u1, v1 * v1));
            see(Mask<Real>(moves & (slides > zero)), start, along);
            see(Mask<Real>(slides < zero), most - start, most - now);
        };
        for (int face = 0; face < face_count; ++face) each_of_four(one_pair, slides_[face], slip_[0][face], slip_[1][face], end.slip[0][face], end.slip[1][face]);
    }

private:
    Quad<Real> slip_[2][face_count], slides_[face_count];
};

}  // namespace slideway::inline SLIDEWAY_ISA
