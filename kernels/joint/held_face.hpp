#pragma once

#include "kernels/joint/contact_memory.hpp"
#include "kernels/laws/apex_order.hpp"
#include "kernels/laws/face.hpp"
#include "kernels/math/vec3.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// A face that a lane is held to touch, whichever of the four, and what touches there.
template <class Real> struct HeldFace {
    Mask<Real> is_z, is_plus;
    ApexOrder<Real> order;
    Quad<Mask<Real>> touching;  // apices in that order: where the first does not touch, the lane touches nothing
    Mask<Real> more;            // lanes that touch another face, too

    /// The first of some faces.  @param left lanes that touch each of them
    SLIDEWAY_FN static HeldFace first_of(Quad<Mask<Real>> const& left, ContactMemory<Real> const& memory) {
        Mask<Real> const y = left.a | left.b, z = left.c | left.d;
        HeldFace face;
        face.is_z = negation(y);
        face.is_plus = left.a | (face.is_z & left.c);
        face.more = (left.a & left.b) | (y & z) | (left.c & left.d);
        auto const held = face.choose(memory.held);
        auto const touches = [&](Real const& is_held) { return Mask<Real>((y | z) & (is_held > Real(0.5))); };
        Quad<Mask<Real>> const apices{touches(held.a), touches(held.b), touches(held.c), touches(held.d)};
        face.order = ApexOrder<Real>::of(apices);
        face.touching = face.order.from_face(apices);
        return face;
    }
    /// What is left of them after that.
    SLIDEWAY_FN static Quad<Mask<Real>> after_first(Quad<Mask<Real>> const& left) {
        Mask<Real> const y = left.a | left.b;
        return {mask_of<Real>(false), Mask<Real>(left.b & left.a), Mask<Real>(left.c & y), Mask<Real>(left.d & (y | left.c))};
    }
    SLIDEWAY_FN static Quad<Mask<Real>> faces_of(ContactMemory<Real> const& memory) {
        auto const touched = [&](int face) { return Mask<Real>(sum(memory.held[face]) > Real(0.5)); };
        return {touched(0), touched(1), touched(2), touched(3)};
    }

    /// As one number, a bit for each mask, and from there: what is held changes less often than it is looked at.
    SLIDEWAY_FN Real packed() const {
        Real bits(0.0);
        double value = 1;
        for (auto const* mask : {&is_z, &is_plus, &order.sideways, &order.forwards, &order.turned, &touching.a, &touching.b, &touching.c,
                                 &touching.d, &more}) {
            bits = bits + select(*mask, Real(value), Real(0.0));
            value += value;
        }
        return bits;
    }
    SLIDEWAY_FN static HeldFace unpacked(Real bits) {
        HeldFace face;
        face.is_z = bit_of<0>(bits);
        face.is_plus = bit_of<1>(bits);
        face.order = ApexOrder<Real>::by(bit_of<2>(bits), bit_of<3>(bits), bit_of<4>(bits));
        face.touching = {bit_of<5>(bits), bit_of<6>(bits), bit_of<7>(bits), bit_of<8>(bits)};
        face.more = bit_of<9>(bits);
        return face;
    }

    /// The apices that touch, a bit each in that order: lanes with as many have like work to do.
    SLIDEWAY_FN static Real pattern(ContactMemory<Real> const& memory) {
        auto const face = unpacked(memory.touched);
        auto const bit = [](Mask<Real> is, double value) { return select(is, Real(value), Real(0.0)); };
        return (bit(face.touching.a, 1) + bit(face.touching.b, 2)) + (bit(face.touching.c, 4) + bit(face.touching.d, 8));
    }

    /// Of the face, of what all four have.
    SLIDEWAY_FN Real choose(Real y_plus, Real y_minus, Real z_plus, Real z_minus) const {
        return select(is_z, select(is_plus, z_plus, z_minus), select(is_plus, y_plus, y_minus));
    }
    SLIDEWAY_FN Quad<Real> choose(Quad<Real> const* of) const {
        return {choose(of[0].a, of[1].a, of[2].a, of[3].a), choose(of[0].b, of[1].b, of[2].b, of[3].b),
                choose(of[0].c, of[1].c, of[2].c, of[3].c), choose(of[0].d, of[1].d, of[2].d, of[3].d)};
    }
    /// Of the Y faces, or of the Z faces.
    SLIDEWAY_FN Real choose(Real of_y, Real of_z) const { return select(is_z, of_z, of_y); }
    /// As of FacePair.
    SLIDEWAY_FN Vec3<Real> arranged(Vec3<Real> const& v) const { return {v.x, choose(v.y, v.z), choose(v.z, v.y)}; }
    SLIDEWAY_FN Vec3<Real> arranged_axial(Vec3<Real> const& v) const {
        return {choose(v.x, negated(v.x)), choose(v.y, negated(v.z)), choose(v.z, negated(v.y))};
    }
    SLIDEWAY_FN Real side() const { return select(is_plus, Real(1.0), Real(-1.0)); }
    SLIDEWAY_FN Real number() const { return choose(Real(0.0), Real(1.0), Real(2.0), Real(3.0)); }
};

}  // namespace slideway::inline SLIDEWAY_ISA
