// What the joint tells of a pose alone, whatever pushes there: these depend on neither law nor friction.
#pragma once

#include "kernels/joint/apex.hpp"
#include "kernels/joint/contact_memory.hpp"
#include "kernels/joint/contact_report.hpp"
#include "kernels/joint/face_pair.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

namespace detail {

template <class Real> SLIDEWAY_FN Real face_approach(Quad<Real> const& before, Quad<Real> const& after) {
    Real const zero(0.0);
    auto const way = [&](Real from, Real to) { return select((from <= zero) & (to > zero), to - from, zero); };
    return max(max(way(before.a, after.a), way(before.b, after.b)), max(way(before.c, after.c), way(before.d, after.d)));
}

template <class Real> SLIDEWAY_FN Real axis_pattern(auto const& depths) {
    Real const zero(0.0);
    auto const plus = depths.on(Real(1.0)), minus = depths.on(Real(-1.0));
    auto const bit = [&](Real p, Real m, double value) { return select(max(p, m) > zero, Real(value), zero); };
    return (bit(plus.a, minus.a, 1.0) + bit(plus.b, minus.b, 2.0)) +
           (bit(plus.c, minus.c, 4.0) + bit(plus.d, minus.d, 8.0));
}

}  // namespace detail

/// What a state has the contact code do, as a number: bit i where the i-th apex of either Y face touches, bit 4 + i for the Z
/// faces.  The two faces of an axis are worked on in one pass, so that their sides make no difference.
template <class Real>
SLIDEWAY_FN Real contact_pattern(ProfiledMotion<Real> const& motion, JointGeometry<Real> const& g) {
    return fma(Real(16.0), detail::axis_pattern<Real>(FacePair<Axis::z>::depths(motion, g)),
               detail::axis_pattern<Real>(FacePair<Axis::y>::depths(motion, g)));
}

/// Penetration of one apex in the Y or the Z face on its side [m].
template <class Motion, class Real>
SLIDEWAY_FN Real penetration(Motion const& motion, JointGeometry<Real> const& g, Apex apex) {
    auto const depths = apex.z_faces ? FacePair<Axis::z>::depths(motion, g) : FacePair<Axis::y>::depths(motion, g);
    int const first = apex.z_faces ? 2 : 0;
    for (int side = 0; side < 2; ++side) {
        auto const of_face = depths.on(Real(side == 0 ? 1.0 : -1.0));
        if (face_apex(first + side, 0) == apex.index) return of_face.a;
        if (face_apex(first + side, 1) == apex.index) return of_face.b;
        if (face_apex(first + side, 2) == apex.index) return of_face.c;
        if (face_apex(first + side, 3) == apex.index) return of_face.d;
    }
    return Real(not_a_number);
}

/// The longest way [m] that an apex made between two poses towards a face which it touches only in the second; 0 where none does.
template <class Real>
SLIDEWAY_FN Real longest_approach(ProfiledMotion<Real> const& before, ProfiledMotion<Real> const& after,
                                  JointGeometry<Real> const& g) {
    auto const y0 = FacePair<Axis::y>::depths(before, g), y1 = FacePair<Axis::y>::depths(after, g);
    auto const z0 = FacePair<Axis::z>::depths(before, g), z1 = FacePair<Axis::z>::depths(after, g);
    Real longest(0.0);
    for (int i = 0; i < 2; ++i) {
        Real const side(i == 0 ? 1.0 : -1.0);
        longest = max(longest, detail::face_approach(y0.on(side), y1.on(side)));
        longest = max(longest, detail::face_approach(z0.on(side), z1.on(side)));
    }
    return longest;
}

}  // namespace slideway::inline SLIDEWAY_ISA
