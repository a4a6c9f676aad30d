#pragma once

#include "kernels/joint/way.hpp"
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
    SLIDEWAY_FN Quad<Real> on(Real side) const {
        Real const centre = fma(side, middle, base);
        Real const sideways = side * across, forwards = side * along;
        Real const front = centre + forwards, rear = centre - forwards;
        return {front + sideways, front - sideways, rear - sideways, rear + sideways};
    }
    /// The same in another order.
    template <bool all> SLIDEWAY_FN Quad<Real> on(Real side, ApexOrder<Real> const& order) const {
        return order.template around<all>(fma(side, middle, base), side * along, side * across);
    }
    /// Of one, by its signs.
    SLIDEWAY_FN Real at(Real side, Real sign_along, Real sign_across) const {
        return (fma(side, middle, base) + sign_along * (side * along)) + sign_across * (side * across);
    }
    /// The largest of the four, bit for bit, since rounding keeps the order.
    SLIDEWAY_FN Real largest(Real side) const { return (fma(side, middle, base) + abs(along)) + abs(across); }
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
    template <class Real>
    SLIDEWAY_FN static FaceFrame<Real> frame(JointMotion<Real> const& motion, JointGeometry<Real> const& g) {
        return {normal(motion),
                is_y ? motion.axes.y_shortfall : motion.axes.z_shortfall,
                main(motion),
                across(motion),
                half_main(g),
                half_across(g),
                g.half_length,
                is_y ? g.clearance_y : g.clearance_z};
    }

    /// What the laws need to know of these faces.
    template <class Real> SLIDEWAY_FN static FaceContact<Real> contact(ContactParameters<Real> const& p) {
        return {is_y ? p.surface_stiffness_y : p.surface_stiffness_z, is_y ? p.across_y_face : p.across_z_face, p.along, is_y ? p.area_y : p.area_z};
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
