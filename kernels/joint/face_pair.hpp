#pragma once

#include "kernels/joint/way.hpp"
#include "kernels/joint/way_profile.hpp"
#include "kernels/laws/apex_order.hpp"
#include "kernels/laws/contact.hpp"
#include "kernels/laws/face.hpp"
#include "kernels/math/vec3.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

template <class Real> struct JointGeometry {
    Real half_length;  // L_k/2 [m]
    Real half_width;   // w_a/2, along Y [m]
    Real half_depth;   // w_b/2, along Z [m]
    Real clearance_y;  // c_a, per side [m]
    Real clearance_z;  // c_b [m]
};

/// A number of each apex of two opposite faces, as an affine function of the three signs: on side s it is
/// base + s·middle + s·(s_across·across + s_x·along).  Penetrations are such numbers, and so are their rates.
template <class Real> struct ApexNumbers {
    Real base, middle, across, along;

    /// Of the four apices of the face on `side` (+1 or −1).
    SLIDEWAY_FN Quad<Real> on(Real side) const { return quad(side, side * along); }
    /// The same in another order.
    template <bool all> SLIDEWAY_FN Quad<Real> on(Real side, ApexOrder<Real> const& order) const {
        return order.template around<all>(fma(side, middle, base), side * along, side * across);
    }
    /// Of one, by its signs.
    SLIDEWAY_FN Real at(Real side, Real sign_along, Real sign_across) const { return one(side, side * along, sign_along, sign_across); }
    /// The largest of the four, bit for bit, since rounding keeps the order.
    SLIDEWAY_FN Real largest(Real side) const { return (fma(side, middle, base) + abs(along)) + abs(across); }

protected:
    /// @param forwards half of what those in front have more than those behind
    SLIDEWAY_FN Quad<Real> quad(Real side, Real forwards) const {
        Real const centre = fma(side, middle, base), sideways = side * across;
        Real const front = centre + forwards, rear = centre - forwards;
        return {front + sideways, front - sideways, rear - sideways, rear + sideways};
    }
    SLIDEWAY_FN Real one(Real side, Real forwards, Real sign_along, Real sign_across) const {
        return (fma(side, middle, base) + sign_along * forwards) + sign_across * (side * across);
    }
};

/// The same of faces of which one may open along the way as the other does: + s_x skew.
template <class Real> struct TaperedNumbers : ApexNumbers<Real> {
    Real skew;

    SLIDEWAY_FN TaperedNumbers(ApexNumbers<Real> const& straight, Real of_skew) : ApexNumbers<Real>(straight), skew(of_skew) {}

    SLIDEWAY_FN Quad<Real> on(Real side) const { return this->quad(side, forwards(side)); }
    template <bool all> SLIDEWAY_FN Quad<Real> on(Real side, ApexOrder<Real> const& order) const {
        return order.template around<all>(fma(side, this->middle, this->base), forwards(side), side * this->across);
    }
    SLIDEWAY_FN Real at(Real side, Real sign_along, Real sign_across) const { return this->one(side, forwards(side), sign_along, sign_across); }
    SLIDEWAY_FN Real largest(Real side) const { return (fma(side, this->middle, this->base) + abs(forwards(side))) + abs(this->across); }

    /// Less a number of the contact segment's ends.
    SLIDEWAY_FN static TaperedNumbers less(ApexNumbers<Real> const& n, EndNumbers<Real> const& of) {
        return {{n.base - of.base, n.middle - of.middle, n.across, n.along - of.along}, negated(of.skew)};
    }
    /// Nothing less.
    SLIDEWAY_FN static TaperedNumbers straight(ApexNumbers<Real> const& n) { return {n, Real(0.0)}; }

private:
    SLIDEWAY_FN Real forwards(Real side) const { return fma(side, this->along, skew); }
};

/// Two opposite faces in the frame (x, main, across), `main` along their normal if the slider lies straight.
template <class Real> struct FaceFrame {
    Vec3<Real> normal;  // n of the face on side +1
    Real shortfall;     // n_main − 1
    Real main, across;  // the slider's centre p from the way's axis [m]
    Real half_main, half_across, half_length, clearance;  // [m]

    /// δ = −c + s[(n − 1) ρ + …] of the apices (model.md 3, clearance first).  With ρ = (s_x L_k/2, s w/2 − p, s_across w_across/2 −
    /// p_across): base = −c + (n_main − 1) w/2, middle = −(n_main p + n_across p_across).
    SLIDEWAY_FN ApexNumbers<Real> depths() const {
        return {fms(shortfall, half_main, clearance), negated(fma(normal.z, across, fma(shortfall, main, main))),
                normal.z * half_across, normal.x * half_length};
    }
    /// δ' = s[(ω × n)·ρ − n_y v_y − n_z v_z] (model.md 3).  @param m ω × n  @param v u', both in this frame
    SLIDEWAY_FN ApexNumbers<Real> rates(Vec3<Real> const& m, Vec3<Real> const& v) const {
        Real const turning = fma(m.y, main, m.z * across);
        Real const moving = fma(normal.y, v.y, normal.z * v.z);
        return {m.y * half_main, negated(turning + moving), m.z * half_across, m.x * half_length};
    }
};

enum class Axis { y, z };

/// The two faces normal to one of the slider's axes.  They are seen in the frame (x, main, across), `main` along their normal if the
/// slider lies straight; that of the Z faces, (x, z, y), is left-handed: angular velocities and torques change their sign.
/// Forces, patterns, gaps, approach and stiffness all see the faces through this.
template <Axis axis> struct FacePair {
    static constexpr bool is_y = axis == Axis::y;
    static constexpr int first_face = is_y ? 0 : 2;  // the one on side +1; the other is next

    /// A vector in that frame, and back.
    template <class Real> SLIDEWAY_FN static Vec3<Real> arranged(Vec3<Real> const& v) {
        if constexpr (is_y) return v;
        return {v.x, v.z, v.y};
    }
    template <class Real> SLIDEWAY_FN static Vec3<Real> arranged_axial(Vec3<Real> const& v) {
        if constexpr (is_y) return v;
        return {negated(v.x), negated(v.z), negated(v.y)};
    }

    template <class Real> SLIDEWAY_FN static Real half_main(JointGeometry<Real> const& g) {
        return is_y ? g.half_width : g.half_depth;
    }
    template <class Real> SLIDEWAY_FN static Real half_across(JointGeometry<Real> const& g) {
        return is_y ? g.half_depth : g.half_width;
    }
    /// The slider's centre from the way's axis.
    template <class Real> SLIDEWAY_FN static Real main(JointMotion<Real> const& motion) {
        return is_y ? motion.y : motion.z;
    }
    template <class Real> SLIDEWAY_FN static Real across(JointMotion<Real> const& motion) {
        return is_y ? motion.z : motion.y;
    }
    /// n of the face on side +1, in the frame of the faces.
    template <class Real> SLIDEWAY_FN static Vec3<Real> normal(JointMotion<Real> const& motion) {
        return arranged(is_y ? motion.axes.y : motion.axes.z);
    }

    /// δ of the apices.
    template <class Real>
    SLIDEWAY_FN static ApexNumbers<Real> depths(JointMotion<Real> const& motion, JointGeometry<Real> const& g) {
        return frame(motion, g).depths();
    }
    /// δ'.  @param m ω × n  @param v u', both in the frame of the faces
    template <class Real>
    SLIDEWAY_FN static ApexNumbers<Real> rates(Vec3<Real> const& m, Vec3<Real> const& v, JointMotion<Real> const& motion,
                                               JointGeometry<Real> const& g) {
        return frame(motion, g).rates(m, v);
    }
    /// The same where the way may have a profile, or end.
    template <class Real>
    SLIDEWAY_FN static TaperedNumbers<Real> depths(ProfiledMotion<Real> const& motion, JointGeometry<Real> const& g) {
        auto const n = frame(motion, g).depths();
        return motion.is_profiled ? TaperedNumbers<Real>::less(n, motion.profile.depth[first_face / 2]) : TaperedNumbers<Real>::straight(n);
    }
    template <class Real>
    SLIDEWAY_FN static TaperedNumbers<Real> rates(Vec3<Real> const& m, Vec3<Real> const& v, ProfiledMotion<Real> const& motion, JointGeometry<Real> const& g) {
        auto const n = frame(motion, g).rates(m, v);
        return motion.is_profiled ? TaperedNumbers<Real>::less(n, motion.profile.rate[first_face / 2]) : TaperedNumbers<Real>::straight(n);
    }
    template <class Motion, class Real> SLIDEWAY_FN static FaceFrame<Real> frame(Motion const& motion, JointGeometry<Real> const& g) {
        return {normal(motion),
                is_y ? motion.axes.y_shortfall : motion.axes.z_shortfall,
                main(motion),
                across(motion),
                half_main(g),
                half_across(g),
                segment_half(motion, g.half_length),
                is_y ? g.clearance_y : g.clearance_z};
    }

    /// What the laws need to know of these faces.
    template <class Real> SLIDEWAY_FN static FaceContact<Real> contact(ContactParameters<Real> const& p) {
        return {is_y ? p.surface_stiffness_y : p.surface_stiffness_z, is_y ? p.across_y_face : p.across_z_face, p.along, is_y ? p.area_y : p.area_z};
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
