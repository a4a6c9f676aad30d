#pragma once

#include "kernels/joint/contact_memory.hpp"
#include "kernels/laws/face.hpp"
#include "kernels/real.hpp"
#include "kernels/steppers/cubic_roots.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Depths and rates of the pairs that may touch at the start of a step, and where inside it they meet or leave their faces.
/// @tparam quads of them: one per face of the clearance joint, one for the corners of the planar slider
template <class Real, int quads = face_count> class GapHistory {
public:
    /// Remembers the gaps at the start of the next step.  @param r ContactReport or PlanarContact
    template <class Contact> SLIDEWAY_FN void keep(Mask<Real> taken, Contact const& r) {
        for (int face = 0; face < quads; ++face) {
            start_depth_[face] = select(taken, r.penetration[face], start_depth_[face]);
            start_rate_[face] = select(taken, r.rate[face], start_rate_[face]);
        }
    }

    /// Where the next step starts, of a pair [m].
    SLIDEWAY_FN Real start_depth(int pair) const {
        auto const& face = start_depth_[pair / 4];
        int const place = pair % 4;
        return place == 0 ? face.a : place == 1 ? face.b : place == 2 ? face.c : face.d;
    }

    /// The next step, ended just beyond the first change of a pair that meets its face or leaves it, with the acceleration of the step that has been made.
    /// Changes within a fiftieth of it are crossed.
    /// @param step that has been made [s]; 0 where its start is not known  @param next step without changes [s]
    template <class Contact> SLIDEWAY_FN Real next_step(Contact const& end, Real step, Real next) const {
        constexpr double beyond = 1.001, shortest = 0.02;
        Real const zero(0.0), half = Real(0.5) * next, per_step = Real(1.0) / select(step > zero, step, Real(1.0));
        auto const is_known = step > zero;
        Real first = next;
        auto const look = [&](Real before, Real depth, Real rate) {
            Real const acceleration = select(is_known, (rate - before) * per_step, zero);
            auto const touches = depth > zero;
            Mask<Real> const changes = touches ^ (fma(next, fma(half, acceleration, rate), depth) > zero);
            if (none(changes)) return;
            // 0 = gap − v τ − ½ a τ².
            Real const gap = abs(depth), v = select(touches, negated(rate), rate), a = select(touches, negated(acceleration), acceleration);
            Real const denominator = v + sqrt(max(fma(v, v, (a + a) * gap), zero));
            Mask<Real> const comes = changes & (denominator > zero);
            Real const time = (gap + gap) / select(comes, denominator, Real(1.0));
            first = select(comes & (time > Real(shortest) * next), min(first, Real(beyond) * time), first);
        };
        for (int face = 0; face < quads; ++face) {
            auto const &before = start_rate_[face], &depth = end.penetration[face], &rate = end.rate[face];
            look(before.a, depth.a, rate.a), look(before.b, depth.b, rate.b), look(before.c, depth.c, rate.c), look(before.d, depth.d, rate.d);
        }
        return first;
    }

protected:
    /// Where in (0, 1) pairs first pass to the other side of zero depth, by half of `located` so that they lie there for certain, and
    /// whether they come back before the end.  From the cubic through both ends' depths and rates: a pair that changes twice inside
    /// one step ends it where it started, and is found all the same.
    struct Change {
        Real fraction;  // of the step, 1 where there is none
        Mask<Real> returns;
    };

    /// Values and slopes at both ends of [0, 1].
    struct Curve { Real v0, s0, v1, s1; };

    /// A pair that may change, turned so that it starts below zero.
    struct Passage {
        Mask<Real> lanes;
        Curve depth;
    };

    /// @param located depth up to which a change at the end of the step counts as its end.
    SLIDEWAY_FN static Passage passage(Mask<Real> candidates, Real d0, Real v0, Real d1, Real v1, Real step, Real located) {
        Real const zero(0.0), target = Real(0.5) * located;
        // Turned so that all start below: on zero is apart, and there `located` makes room for a start that is the last change.
        auto const touches = d0 > zero;
        Real const start = select(touches, negated(d0), d0), reached = select(touches, negated(d1), d1);
        Real const along = select(touches, negated(step), step);
        Real const end = select(reached > located, reached, min(reached, zero));
        Curve const depth{start - target, along * v0, end - target, along * v1};
        return {Mask<Real>(candidates & may_cross(depth.v0, depth.s0, depth.v1, depth.s1)), depth};
    }
    /// Whether a pair that touches, or does not, may change, told from less: a cubic lies within the span of its Bézier ordinates (`may_cross`),
    /// and those of most pairs are all apart, or all deeper than `located`.
    SLIDEWAY_FN static Mask<Real> may_change(Mask<Real> touches, Real d0, Real v0, Real d1, Real v1, Real step, Real located) {
        Real const third = Real(1.0 / 3) * step, c1 = fma(third, v0, d0), c2 = fnma(third, v1, d1);
        auto const rises = max(max(d0, d1), max(c1, c2)) > Real(0.0), falls = min(min(d0, d1), min(c1, c2)) <= located;
        return (touches & falls) | (negation(touches) & rises);
    }
    SLIDEWAY_FN static Change first_change(Mask<Real> candidates, Real d0, Real v0, Real d1, Real v1, Real step, Real located) {
        auto const pair = passage(candidates, d0, v0, d1, v1, step, located);
        if (none(pair.lanes)) return {Real(1.0), mask_of<Real>(false)};
        return first_zero(pair.lanes, pair.depth);
    }

    /// The first changes of pairs one after the other.  In most lanes one pair changes at most, not the same in all: it waits for those of
    /// the others, and one search serves them all.
    struct FirstChange {
        Real fraction = Real(1.0);
        Mask<Real> waits = mask_of<Real>(false);
        Curve waiting{Real(0.0), Real(0.0), Real(0.0), Real(0.0)};

        SLIDEWAY_FN void add(Passage const& pair) {
            if (none(pair.lanes)) return;
            Mask<Real> const both = pair.lanes & waits;
            if (any(both)) [[unlikely]] fraction = min(fraction, first_zero(both, pair.depth).fraction);
            auto const& to = waiting;
            auto const& from = pair.depth;
            waiting = {select(waits, to.v0, from.v0), select(waits, to.s0, from.s0), select(waits, to.v1, from.v1),
                       select(waits, to.s1, from.s1)};
            waits = waits | pair.lanes;
        }
        SLIDEWAY_FN Real of_all() const { return any(waits) ? min(fraction, first_zero(waits, waiting).fraction) : fraction; }
    };

    /// The least fraction for a face: `of` tells that of one pair.
    template <class Contact, class OfPair>
    SLIDEWAY_FN Real least_of_face(int face, Contact const& end, OfPair const& of) const {
        auto const& d0 = start_depth_[face];
        auto const& v0 = start_rate_[face];
        auto const& d1 = end.penetration[face];
        auto const& v1 = end.rate[face];
        return min(min(of(d0.a, v0.a, d1.a, v1.a), of(d0.b, v0.b, d1.b, v1.b)),
                   min(of(d0.c, v0.c, d1.c, v1.c), of(d0.d, v0.d, d1.d, v1.d)));
    }

    Quad<Real> start_depth_[quads], start_rate_[quads];

private:
    SLIDEWAY_NOINLINE static Change first_zero(Mask<Real> crossing, Curve const& depth) {
        Real const zero(0.0), one(1.0);
        auto const rises = cubic_zeros(crossing, depth.v0, depth.s0, depth.v1, depth.s1, Direction::rising);
        Real const first = min(rises.at[0].theta, min(rises.at[1].theta, rises.at[2].theta));
        auto const twice = (rises.at[0].theta <= one) & (rises.at[2].theta <= one);
        return {select(rises.any, min(first, Real(0.999)), one), Mask<Real>(rises.any & (twice | (depth.v1 < zero)))};
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
