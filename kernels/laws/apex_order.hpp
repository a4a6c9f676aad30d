#pragma once

#include "kernels/laws/face.hpp"
#include "kernels/math/vec3.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// The apices of a face counted from one that touches: it comes first, a neighbour that touches second, and so on around the face.  Lanes
/// then have their contacts in the same places, whichever apices touch, and what no lane touches is left out.
template <class Real> struct ApexOrder {
    Mask<Real> sideways, forwards;  // the first is not the face's own first but beside it, across or along the way
    Mask<Real> turned;              // the second is the first's neighbour along the way
    Real across, along;             // signs of the first, across and along the way

    SLIDEWAY_FN static ApexOrder by(Mask<Real> sideways, Mask<Real> forwards, Mask<Real> turned) {
        Real const plus(1.0), minus(-1.0);
        return {sideways, forwards, turned, select(sideways, minus, plus), select(forwards, minus, plus)};
    }
    /// @param t apices that touch, in the face's own order
    SLIDEWAY_FN static ApexOrder of(Quad<Mask<Real>> const& t) {
        Mask<Real> const not_a = negation(t.a), sideways = not_a & (t.b | t.c), forwards = not_a & negation(t.b);
        auto const straight = by(sideways, forwards, mask_of<Real>(false));
        auto const from_first = straight.from_face(t);
        return by(sideways, forwards, Mask<Real>(from_first.d & negation(from_first.b)));
    }

    /// What each apex has, from the face's own order to this one, and back.
    template <class Value> SLIDEWAY_FN Quad<Value> from_face(Quad<Value> const& q) const { return turn(mirror(q)); }
    template <class Value> SLIDEWAY_FN Quad<Value> to_face(Quad<Value> const& q) const { return mirror(turn(q)); }

    /// Values of the apices from that of their centre and what the signs add.  @param all or the first two alone, the others being zero
    template <bool all, class Value>
    SLIDEWAY_FN Quad<Value> around(Value const& centre, Value const& by_along, Value const& by_across) const {
        auto forth = along * by_along, aside = across * by_across;
        auto front = centre + forth, rear = centre - forth;
        auto beside = front - aside, behind = rear + aside;
        auto first = front + aside, second = one_of(turned, behind, beside);
        if constexpr (all) return {first, second, rear - aside, one_of(turned, beside, behind)};
        else return {first, second, Value{}, Value{}};
    }

    /// Σ over the apices, plain and by their signs along and across the way.
    template <class Value> struct Sums { Value all, along, across; };
    template <bool all, class Value> SLIDEWAY_FN Sums<Value> sums(Quad<Value> const& q) const {
        if constexpr (all) {
            auto beside = one_of(turned, q.d, q.b), behind = one_of(turned, q.b, q.d);
            auto front = q.a + beside, rear = q.c + behind;
            auto same = q.a + behind, other = q.c + beside;
            return {front + rear, along * (front - rear), across * (same - other)};
        } else {
            auto sum = q.a + q.b, difference = q.a - q.b;
            return {sum, along * one_of(turned, difference, sum), across * one_of(turned, sum, difference)};
        }
    }

private:
    template <class Value> SLIDEWAY_FN Quad<Value> mirror(Quad<Value> const& q) const {
        Quad<Value> const aside{one_of(sideways, q.b, q.a), one_of(sideways, q.a, q.b), one_of(sideways, q.d, q.c),
                                one_of(sideways, q.c, q.d)};
        return {one_of(forwards, aside.d, aside.a), one_of(forwards, aside.c, aside.b), one_of(forwards, aside.b, aside.c),
                one_of(forwards, aside.a, aside.d)};
    }
    template <class Value> SLIDEWAY_FN Quad<Value> turn(Quad<Value> const& q) const {
        return {q.a, one_of(turned, q.d, q.b), q.c, one_of(turned, q.b, q.d)};
    }

    SLIDEWAY_FN static Real one_of(Mask<Real> m, Real const& yes, Real const& no) { return select(m, yes, no); }
    SLIDEWAY_FN static Vec3<Real> one_of(Mask<Real> m, Vec3<Real> const& yes, Vec3<Real> const& no) { return select(m, yes, no); }
    SLIDEWAY_FN static Mask<Real> one_of(Mask<Real> m, Mask<Real> yes, Mask<Real> no) {
        return (m & yes) | (negation(m) & no);
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
