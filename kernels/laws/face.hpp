// The border between the joint and the contact laws: one face of the slider with its four apices.
#pragma once

#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// One value per apex of a face, in the order (X+, across+), (X+, across−), (X−, across−), (X−, across+), where
/// `across` is Z for the Y faces and Y for the Z faces.  Neighbours, cyclically, share an edge: a–b and c–d run
/// across the way, b–c and d–a along it.  Named members, because g++ keeps arrays of packs in memory.
template <class Value> struct Quad { Value a, b, c, d; };

template <class Real> SLIDEWAY_FN Real sum(Quad<Real> const& q) { return (q.a + q.b) + (q.c + q.d); }

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
    Mask<Real> ab, bc, cd, da;  // lines
    Quad<Mask<Real>> point;
};

/// What a face's law works on.
template <class Real> struct FaceMotion {
    Quad<Real> depth;           // δ [m], > 0 in contact
    Quad<Real> rate;            // δ' [m/s]
    Quad<Mask<Real>> touching;  // δ > 0
    Quad<Real> impact_speed;    // v0 [m/s]; read by RestitutionDamping alone
};

/// What a law returns for a face.
template <class Real> struct FaceForces {
    Quad<Real> normal;   // F [N], damping included, >= 0
    Quad<Real> elastic;  // F without damping [N]
    Real potential;      // U of the elastic part [J]
    Mask<Real> outside;  // a line contact beyond its domain; the forces of that lane are NaN
};

/// Modes of a face from its touching apices (model.md 4, Qian et al. 2020, 3.2.1): all four are one surface; else each
/// edge with both apices touching is a line, and each touching apex on no line is a point.
template <class Real> SLIDEWAY_FN FaceModes<Real> face_modes(Quad<Mask<Real>> const& t) {
    FaceModes<Real> m;
    auto const ab = t.a & t.b, bc = t.b & t.c, cd = t.c & t.d, da = t.d & t.a;
    m.surface = ab & cd;
    auto const open = !m.surface;
    m.ab = ab & open;
    m.bc = bc & open;
    m.cd = cd & open;
    m.da = da & open;
    m.point.a = t.a & !(ab | da);
    m.point.b = t.b & !(ab | bc);
    m.point.c = t.c & !(bc | cd);
    m.point.d = t.d & !(cd | da);
    return m;
}

/// Forces are clamped at zero: no contact pulls.  In this order the maximum hands a NaN on.
template <class Real> SLIDEWAY_FN Real clamped(Real force) { return max(Real(0.0), force); }

}  // namespace slideway::inline SLIDEWAY_ISA
