// The border between the joint and the contact laws: one face of the slider with its four apices.
#pragma once

#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// One value per apex of a face, in the order (X+, across+), (X+, across−), (X−, across−), (X−, across+), where
/// `across` is Z for the Y faces and Y for the Z faces.  Neighbours, cyclically, share an edge: a–b and c–d run
/// across the way, b–c and d–a along it.  Named members, because g++ keeps arrays of packs in memory.
template <class Value> struct Quad { Value a, b, c, d; };

/// The value of apex `index`, from 0 and around the face.
template <int index, class Quad> SLIDEWAY_FN auto& at(Quad& q) {
    if constexpr (index % 4 == 0) return q.a;
    else if constexpr (index % 4 == 1) return q.b;
    else if constexpr (index % 4 == 2) return q.c;
    else return q.d;
}

/// Has a function see the four values of quads, one of each at a time.
template <class See, class... Quads> SLIDEWAY_FN void each_of_four(See const& see, Quads const&... q) {
    see(q.a...), see(q.b...), see(q.c...), see(q.d...);
}
template <class Real> SLIDEWAY_FN Quad<Real> select(Mask<Real> m, Quad<Real> const& yes, Quad<Real> const& no) {
    return {select(m, yes.a, no.a), select(m, yes.b, no.b), select(m, yes.c, no.c), select(m, yes.d, no.d)};
}
template <class Real> SLIDEWAY_FN Real sum(Quad<Real> const& q) { return (q.a + q.b) + (q.c + q.d); }
template <class Real> SLIDEWAY_FN Real largest(Quad<Real> const& q) { return max(max(q.a, q.b), max(q.c, q.d)); }

/// 1/a … 1/d by one division (P. Montgomery's trick), to a few units in the last place.  The product of all four must neither
/// overflow nor vanish; who has no use for one of the four says one.
template <class Real> SLIDEWAY_FN Quad<Real> reciprocals(Quad<Real> const& q) {
    Real const ab = q.a * q.b, cd = q.c * q.d;
    Real const all = Real(1.0) / (ab * cd);
    Real const of_ab = all * cd, of_cd = all * ab;
    return {of_ab * q.b, of_ab * q.a, of_cd * q.d, of_cd * q.c};
}

/// Which contacts a face has.  Edges are named by their apices.
template <class Real> struct FaceModes {
    Mask<Real> surface;
    Quad<Mask<Real>> line;  // edge i lies between apices i and i + 1
    Quad<Mask<Real>> point;
};

/// One apex against its face.
template <class Real> struct ApexMotion {
    Real depth;         // δ [m], > 0 in contact
    Real rate;          // δ' [m/s]
    Real impact_speed;  // v0 [m/s]; read by RestitutionDamping alone, and only then there
};

/// What a face's law works on.
template <class Real> struct FaceMotion {
    Quad<ApexMotion<Real>> apex;
    Quad<Mask<Real>> touching;  // δ > 0, or held to be
};

/// The motion of a contact that the whole face makes: the mean of the rates, and the largest of the impact speeds.
template <class Real> SLIDEWAY_FN Real mean_rate(FaceMotion<Real> const& m) {
    return Real(0.25) * ((m.apex.a.rate + m.apex.b.rate) + (m.apex.c.rate + m.apex.d.rate));
}
template <class Real> SLIDEWAY_FN Real impact_speed(FaceMotion<Real> const& m) {
    return max(max(m.apex.a.impact_speed, m.apex.b.impact_speed), max(m.apex.c.impact_speed, m.apex.d.impact_speed));
}
/// Of the contact that edge `edge` makes.
template <int edge, class Real> SLIDEWAY_FN Real edge_impact_speed(FaceMotion<Real> const& m) {
    return max(at<edge>(m.apex).impact_speed, at<edge + 1>(m.apex).impact_speed);
}

/// What a law returns for a face.
template <class Real> struct FaceForces {
    Quad<Real> normal;   // F [N], damping included, >= 0
    Quad<Real> elastic;  // F without damping [N]
    Real potential;      // U of the elastic part [J]
    Mask<Real> outside;  // a line contact beyond its domain; the forces of that lane are NaN
};

/// Derivatives of one apex's force by the penetrations of the face's four apices: its own, those at the other ends of its
/// edges across and along the way, and the one across the face's diagonal.
template <class Real> struct ApexSlopes { Real own, across, along, opposite; };

/// The one by the apex at the other end of edge `edge`.
template <int edge, class Real> SLIDEWAY_FN Real& partner(ApexSlopes<Real>& slopes) {
    if constexpr (edge % 2 == 0) return slopes.across;
    else return slopes.along;
}

/// How the forces of a face answer to its motion: what an implicit step needs.  Row i of the matrices ∂F_i/∂δ_j and ∂F_i/∂δ'_j is
/// member i of the quads.
template <class Real> struct FaceStiffness {
    Quad<Real> normal;                // F [N], damping included
    Quad<ApexSlopes<Real>> by_depth;  // ∂F/∂δ [N/m]
    Quad<ApexSlopes<Real>> by_rate;   // ∂F/∂δ' [N s/m]

    SLIDEWAY_FN static FaceStiffness none() {
        Real const zero(0.0);
        ApexSlopes<Real> const row{zero, zero, zero, zero};
        return {{zero, zero, zero, zero}, {row, row, row, row}, {row, row, row, row}};
    }
};

/// Forces of a face without contact.
template <class Real> SLIDEWAY_FN FaceForces<Real> no_forces() {
    Real const zero(0.0);
    return {{zero, zero, zero, zero}, {zero, zero, zero, zero}, zero, mask_of<Real>(false)};
}

/// The edges of which both apices touch.
template <class Real> SLIDEWAY_FN Quad<Mask<Real>> touching_edges(Quad<Mask<Real>> const& t) {
    return {Mask<Real>(t.a & t.b), Mask<Real>(t.b & t.c), Mask<Real>(t.c & t.d), Mask<Real>(t.d & t.a)};
}

template <class Masks> SLIDEWAY_FN bool any_of(Masks const& m) { return any((m.a | m.b) | (m.c | m.d)); }

/// Modes of a face from its touching apices (model.md 4, Qian et al. 2020, 3.2.1): all four are one surface; else each
/// edge with both apices touching is a line, and each touching apex on no line is a point.
template <class Real> SLIDEWAY_FN FaceModes<Real> face_modes(Quad<Mask<Real>> const& t) {
    FaceModes<Real> m;
    auto const edge = touching_edges<Real>(t);
    m.surface = edge.a & edge.c;
    auto const open = !m.surface;
    m.line = {Mask<Real>(edge.a & open), Mask<Real>(edge.b & open), Mask<Real>(edge.c & open), Mask<Real>(edge.d & open)};
    m.point = {Mask<Real>(t.a & !(edge.a | edge.d)), Mask<Real>(t.b & !(edge.a | edge.b)),
               Mask<Real>(t.c & !(edge.b | edge.c)), Mask<Real>(t.d & !(edge.c | edge.d))};
    return m;
}

/// Forces are clamped at zero: no contact pulls.  In this order the maximum hands a NaN on.
template <class Real> SLIDEWAY_FN Real clamped(Real force) { return max(Real(0.0), force); }

}  // namespace slideway::inline SLIDEWAY_ISA
