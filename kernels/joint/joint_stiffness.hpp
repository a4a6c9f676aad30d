#pragma once

#include "kernels/joint/apices.hpp"
#include "kernels/joint/joint.hpp"
#include "kernels/joint/way.hpp"
#include "kernels/laws/conservative_stiffness.hpp"
#include "kernels/laws/face_stiffness.hpp"
#include "kernels/laws/friction_stiffness.hpp"
#include "kernels/laws/paper_stiffness.hpp"
#include "kernels/math/vec3.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// What a force does to the two free translations of a mechanism: its power is (y·vy + z·vz).
template <class Real> struct Translation { Real y, z; };

/// The joint's pose and motion as its stiffness needs them.
template <class Real> struct JointFrame {
    JointMotion<Real> motion;              // as the joint's forces see it, in way coordinates
    Vec3<Real> velocity, spin;             // u' [m/s] and ω [rad/s] along the slider's axes
    Translation<Real> x, y, z;             // of unit forces along the slider's axes
    Translation<Real> y_normal, z_normal;  // the same without the force's component along the way's X
};

/// Derivatives of the joint's generalized force on ν = (vy, vz, ωx, ωy, ωz), ω along the slider's axes: by the displacements
/// that ν integrates to, and by ν.
template <class Real> struct JointStiffness {
    Real by_place[5][5];  // K
    Real by_rate[5][5];   // D
    Real touching;        // apex–face pairs in contact

    SLIDEWAY_FN void clear() {
        for (auto* matrix : {by_place, by_rate}) {
            for (int i = 0; i < 5; ++i) {
                for (int j = 0; j < 5; ++j) matrix[i][j] = Real(0.0);
            }
        }
        touching = Real(0.0);
    }
};

/// The structural Jacobian of the clearance joint.  Pair i (apex–face, side s, normal n, arm ρ from the slider's centre) has
/// δ_i' = g_iᵀν + drive with g_i = (−s n, s n × ρ), and the slip v_i = B_i ν + drive; the force on it is F_i per newton e_i =
/// s n − μ t, t = v_i/V, whose generalized force is B_iᵀ e_i = −(g_i + μ B_iᵀ t).  Then
///   K = Σ_ij B_iᵀ e_i (∂F_i/∂δ_j) g_jᵀ,   D = Σ_ij B_iᵀ e_i (∂F_i/∂δ_j') g_jᵀ − Σ_i F_i B_iᵀ T_i B_i,
/// T = μ'(V) t tᵀ + μ/V (1 − t tᵀ) in the face's plane.  K is unsymmetric through the friction that normal forces bring along.
/// Left out, because it is not stiff: the turning of g and B with the pose, the change of slip with the pose.
/// A face is rigid, so the g of its apices are one plane, g = level + σx along + σ_across across with the apices' signs σ:
/// the sums run over three motions of the plane instead of four apices.
/// Arms and vectors are in the slider's frame, where n is an axis: g has no component about it.
template <class Law, class Friction, class Damping> struct JointLinearisation {
    template <class Real, class Memory>
    SLIDEWAY_FN static void stiffness(JointFrame<Real> const& frame, Memory const& memory,
                                      JointParameters<Real> const& p, JointStiffness<Real>& out) {
        auto const& g = p.geometry;
        auto const& motion = frame.motion;
        auto const& v = motion.velocity;
        out.clear();
        Vec3<Real> const& ny = motion.axes.y;
        auto const my = cross(motion.spin, ny);
        add_faces<Axis::y>(penetrations(g.clearance_y, g.half_width, g.half_depth, g.half_length,
                                        motion.axes.y_shortfall, ny.z, ny.x, motion.y, motion.z),
                           penetration_rates(g.half_width, g.half_depth, g.half_length, ny.y, ny.z, my.y, my.z, my.x,
                                             motion.y, motion.z, v.y, v.z),
                           {p.contact.surface_stiffness_y, p.contact.across_y_face, p.contact.along}, frame, memory, p,
                           out);
        Vec3<Real> const& nz = motion.axes.z;
        auto const mz = cross(motion.spin, nz);
        add_faces<Axis::z>(penetrations(g.clearance_z, g.half_depth, g.half_width, g.half_length,
                                        motion.axes.z_shortfall, nz.y, nz.x, motion.z, motion.y),
                           penetration_rates(g.half_depth, g.half_width, g.half_length, nz.z, nz.y, mz.z, mz.y, mz.x,
                                             motion.z, motion.y, v.z, v.y),
                           {p.contact.surface_stiffness_z, p.contact.across_z_face, p.contact.along}, frame, memory, p,
                           out);
    }

private:
    enum class Axis { y, z };

    /// A face in the frame x = sliding, y = its normal, z = across, for both axes.  For the Z faces that frame is left-handed:
    /// their levers are −ρ, which gives torques and slips their signs back.
    template <class Real> struct Face {
        Real side;
        Vec3<Real> lever, lever_along, lever_across;  // ρ = lever ± along ± across [m]
        Vec3<Real> velocity, spin;
        Translation<Real> x, normal, z;
    };

    /// A generalized force.
    template <class Real> struct Generalized {
        Translation<Real> push;
        Vec3<Real> turn;
    };

    template <Axis axis, class Real> SLIDEWAY_FN static Vec3<Real> local(Vec3<Real> const& v) {
        if constexpr (axis == Axis::y) return v;
        return {v.x, v.z, v.y};
    }
    template <Axis axis, class Real> SLIDEWAY_FN static Vec3<Real> local_lever(Vec3<Real> const& v) {
        if constexpr (axis == Axis::y) return v;
        return {negated(v.x), negated(v.z), negated(v.y)};
    }

    template <Axis axis, class Real, class Memory>
    SLIDEWAY_FN static void add_faces(FacePair<Real> const& depths, FacePair<Real> const& rates,
                                      FaceContact<Real> const& contact, JointFrame<Real> const& frame,
                                      Memory const& memory, JointParameters<Real> const& p,
                                      JointStiffness<Real>& out) {
        Real const zero(0.0);
        for (int i = 0; i < 2; ++i) {
            Real const side(i == 0 ? 1.0 : -1.0);
            FaceMotion<Real> m;
            m.depth = apices(depths, side);
            m.touching = {m.depth.a > zero, m.depth.b > zero, m.depth.c > zero, m.depth.d > zero};
            if (none((m.touching.a | m.touching.b) | (m.touching.c | m.touching.d))) continue;
            m.rate = apices(rates, side);
            m.impact_speed = {zero, zero, zero, zero};
            if constexpr (Damping::has_memory) m.impact_speed = memory.speeds[(axis == Axis::y ? 0 : 2) + i];
            out.touching = out.touching + ((count<Real>(m.touching.a) + count<Real>(m.touching.b)) +
                                           (count<Real>(m.touching.c) + count<Real>(m.touching.d)));
            auto const f = LawStiffness<Law>::template face<Damping>(m, contact, p.contact);
            add_face<axis>(f, side, frame, p, out);
        }
    }

    /// Not inlined: the code would multiply.
    template <Axis axis, class Real>
    SLIDEWAY_NOINLINE static void add_face(FaceStiffness<Real> const& f, Real side, JointFrame<Real> const& frame,
                                           JointParameters<Real> const& p, JointStiffness<Real>& out) {
        auto const face = face_of<axis>(side, frame, p.geometry);
        // e of the four apices
        Real const zero(0.0);
        Vec3<Real> const bare{zero, side, zero};
        Quad<Vec3<Real>> force{bare, bare, bare, bare};
        if constexpr (Friction::enabled) add_friction<axis>(face, f.normal, p.friction, force, out.by_rate);
        // g = level ± along ± across
        auto const& s = face.side;
        Generalized<Real> const level{{negated(s) * face.normal.y, negated(s) * face.normal.z},
                                      {s * face.lever.z, zero, negated(s) * face.lever.x}};
        Vec3<Real> const along{s * face.lever_along.z, zero, negated(s) * face.lever_along.x};
        Vec3<Real> const across{s * face.lever_across.z, zero, negated(s) * face.lever_across.x};
        add_product<axis, true>(f.by_depth, face, force, level, along, across, out.by_place);
        add_product<axis, DampingStiffness<Damping>::couples>(f.by_rate, face, force, level, along, across,
                                                              out.by_rate);
    }

    template <Axis axis, class Real>
    SLIDEWAY_FN static Face<Real> face_of(Real side, JointFrame<Real> const& frame, JointGeometry<Real> const& g) {
        auto const& m = frame.motion;
        // The way's axes in the slider's frame.
        Vec3<Real> const x{m.axes.x.x, m.axes.y.x, m.axes.z.x};
        Vec3<Real> const y{m.axes.x.y, m.axes.y.y, m.axes.z.y};
        Vec3<Real> const z{m.axes.x.z, m.axes.y.z, m.axes.z.z};
        Face<Real> face;
        face.side = side;
        face.lever_along = local_lever<axis>(g.half_length * x);
        face.velocity = local<axis>(frame.velocity);
        face.spin = local<axis>(frame.spin);
        face.x = frame.x;
        if constexpr (axis == Axis::y) {
            face.lever = local_lever<axis>(fma(fms(side, g.half_width, m.y), y, negated(m.z) * z));
            face.lever_across = local_lever<axis>(g.half_depth * z);
            face.normal = frame.y_normal;
            face.z = frame.z;
        } else {
            face.lever = local_lever<axis>(fma(fms(side, g.half_depth, m.z), z, negated(m.y) * y));
            face.lever_across = local_lever<axis>(g.half_width * y);
            face.normal = frame.z_normal;
            face.z = frame.y;
        }
        return face;
    }

    /// Sum of B_iᵀ f_i over the four apices.
    template <class Real>
    SLIDEWAY_FN static Generalized<Real> resultant(Face<Real> const& face, Quad<Vec3<Real>> const& f) {
        auto const front = f.a + f.b, rear = f.c + f.d;
        auto const total = front + rear, along = front - rear, across = (f.a + f.d) - (f.b + f.c);
        Generalized<Real> q;
        q.push.y = fma(face.normal.y, total.y, fma(face.x.y, total.x, face.z.y * total.z));
        q.push.z = fma(face.normal.z, total.y, fma(face.x.z, total.x, face.z.z * total.z));
        q.turn = cross(face.lever, total) + cross(face.lever_along, along) + cross(face.lever_across, across);
        return q;
    }

    /// The change of the four forces with one motion of the plane.
    template <class Real>
    SLIDEWAY_FN static Quad<Vec3<Real>> forces(Quad<Vec3<Real>> const& e, Real const& a, Real const& b, Real const& c,
                                               Real const& d) {
        return {a * e.a, b * e.b, c * e.c, d * e.d};
    }

    /// matrix += Σ_ij B_iᵀ e_i slopes_ij g_jᵀ.
    template <Axis axis, bool coupled, class Real>
    SLIDEWAY_FN static void add_product(Quad<ApexSlopes<Real>> const& slopes, Face<Real> const& face,
                                        Quad<Vec3<Real>> const& e, Generalized<Real> const& level,
                                        Vec3<Real> const& along, Vec3<Real> const& across, Real (*matrix)[5]) {
        // Seen from an apex, whose signs are taken out, `along` moves its neighbour across the way with it and the others
        // against it.
        auto const by_level = [](ApexSlopes<Real> const& r) {
            if constexpr (!coupled)
                return r.own;
            else
                return (r.own + r.across) + (r.along + r.opposite);
        };
        auto const by_along = [](ApexSlopes<Real> const& r) {
            if constexpr (!coupled)
                return r.own;
            else
                return (r.own + r.across) - (r.along + r.opposite);
        };
        auto const by_across = [](ApexSlopes<Real> const& r) {
            if constexpr (!coupled)
                return r.own;
            else
                return (r.own - r.across) + (r.along - r.opposite);
        };
        auto const& r = slopes;
        auto const first = resultant(face, forces(e, by_level(r.a), by_level(r.b), by_level(r.c), by_level(r.d)));
        auto const second =
            resultant(face, forces(e, by_along(r.a), by_along(r.b), negated(by_along(r.c)), negated(by_along(r.d))));
        auto const third = resultant(
            face, forces(e, by_across(r.a), negated(by_across(r.b)), negated(by_across(r.c)), by_across(r.d)));
        auto const add_row = [&](int i, Real const& x, Real const& y, Real const& z) {
            auto& row = matrix[i];
            row[0] = fma(x, level.push.y, row[0]);
            row[1] = fma(x, level.push.z, row[1]);
            row[2] = fma(x, level.turn.x, fma(y, along.x, fma(z, across.x, row[2])));
            auto& last = row[place<axis>(2)];
            last = fma(x, level.turn.z, fma(y, along.z, fma(z, across.z, last)));
        };
        add_row(0, first.push.y, second.push.y, third.push.y);
        add_row(1, first.push.z, second.push.z, third.push.z);
        add_row(place<axis>(0), first.turn.x, second.turn.x, third.turn.x);
        add_row(place<axis>(1), first.turn.y, second.turn.y, third.turn.y);
        add_row(place<axis>(2), first.turn.z, second.turn.z, third.turn.z);
    }

    /// Index in ν of the spin about the face frame's x, y or z.
    template <Axis axis> SLIDEWAY_FN static constexpr int place(int direction) {
        if (axis == Axis::y || direction == 0) return 2 + direction;
        return direction == 1 ? 4 : 3;
    }

    /// Friction of the four apices: the tangential part of e, and −Σ F Bᵀ T B into the damping.
    template <Axis axis, class Real>
    SLIDEWAY_FN static void add_friction(Face<Real> const& face, Quad<Real> const& normal,
                                         FrictionParameters<Real> const& friction, Quad<Vec3<Real>>& e,
                                         Real (*damping)[5]) {
        auto const front = face.lever + face.lever_along, rear = face.lever - face.lever_along;
        Real const zero(0.0);
        // Σ F T; Σ F T C and Σ F Cᵀ T C with the columns (0, ρy), (ρz, −ρx), (−ρy, 0) of C, the slips that turning brings.
        Real xx = zero, xz = zero, zz = zero;
        Real p1 = zero, p2 = zero, p3 = zero, q1 = zero, q2 = zero;
        Real turn_xx = zero, turn_yy = zero, turn_zz = zero, turn_xy = zero, turn_yz = zero, turn_xz = zero;
        auto const add = [&](Vec3<Real> const& lever, Real const& load, Vec3<Real>& direction) {
            auto const v = face.velocity + cross(face.spin, lever);
            auto const slopes = StickSlipStiffness::apex(v.x, v.z, friction);
            direction.x = slopes.push_x;
            direction.z = slopes.push_z;
            Real const a = load * slopes.xx, b = load * slopes.xz, c = load * slopes.zz;
            xx = xx + a;
            xz = xz + b;
            zz = zz + c;
            Real const ay = a * lever.y, by = b * lever.y, cy = c * lever.y;
            Real const bend_x = fms(a, lever.z, b * lever.x), bend_z = fms(b, lever.z, c * lever.x);
            p1 = p1 + ay;
            p2 = p2 + by;
            p3 = p3 + cy;
            q1 = q1 + bend_x;
            q2 = q2 + bend_z;
            turn_xx = fma(lever.y, cy, turn_xx);
            turn_zz = fma(lever.y, ay, turn_zz);
            turn_xz = fnma(lever.y, by, turn_xz);
            turn_xy = fma(lever.y, bend_z, turn_xy);
            turn_yz = fnma(lever.y, bend_x, turn_yz);
            turn_yy = fma(lever.z, bend_x, fnma(lever.x, bend_z, turn_yy));
        };
        add(front + face.lever_across, normal.a, e.a);
        add(front - face.lever_across, normal.b, e.b);
        add(rear - face.lever_across, normal.c, e.c);
        add(rear + face.lever_across, normal.d, e.d);

        auto const subtract = [&](int i, int j, Real const& value) {
            damping[i][j] = damping[i][j] - value;
            if (i != j) damping[j][i] = damping[j][i] - value;
        };
        constexpr int x = place<axis>(0), y = place<axis>(1), z = place<axis>(2);
        subtract(x, x, turn_xx);
        subtract(x, y, turn_xy);
        subtract(x, z, turn_xz);
        subtract(y, y, turn_yy);
        subtract(y, z, turn_yz);
        subtract(z, z, turn_zz);
        auto const& tx = face.x;
        auto const& tz = face.z;
        subtract(0, x, fma(tx.y, p2, tz.y * p3));
        subtract(1, x, fma(tx.z, p2, tz.z * p3));
        subtract(0, y, fma(tx.y, q1, tz.y * q2));
        subtract(1, y, fma(tx.z, q1, tz.z * q2));
        subtract(0, z, negated(fma(tx.y, p1, tz.y * p2)));
        subtract(1, z, negated(fma(tx.z, p1, tz.z * p2)));
        Real const x_y = fma(xx, tx.y, xz * tz.y), z_y = fma(xz, tx.y, zz * tz.y);
        Real const x_z = fma(xx, tx.z, xz * tz.z), z_z = fma(xz, tx.z, zz * tz.z);
        subtract(0, 0, fma(tx.y, x_y, tz.y * z_y));
        subtract(0, 1, fma(tx.z, x_y, tz.z * z_y));
        subtract(1, 1, fma(tx.z, x_z, tz.z * z_z));
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
