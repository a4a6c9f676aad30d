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

    SLIDEWAY_FN void fill(Real value) {
        for (auto* matrix : {by_place, by_rate}) {
            for (int i = 0; i < 5; ++i) {
                for (int j = 0; j < 5; ++j) matrix[i][j] = value;
            }
        }
    }
};

/// The structural Jacobian of the clearance joint.  Pair i (apex–face, side s, normal n, arm ρ from the slider's centre) has
/// δ_i' = g_iᵀν + drive with g_i = (−s n, s n × ρ), and the slip v_i = B_i ν + drive; the force on it is F_i per newton e_i =
/// s n − μ t, t = v_i/V, whose generalized force is B_iᵀ e_i = −(g_i + μ B_iᵀ t).  Then
///   K = Σ_i B_iᵀ e_i (Σ_j ∂F_i/∂δ_j g_j)ᵀ,   D = Σ_i B_iᵀ e_i (Σ_j ∂F_i/∂δ_j' g_j)ᵀ − Σ_i F_i B_iᵀ T_i B_i,
/// T = μ'(V) t tᵀ + μ/V (1 − t tᵀ) in the face's plane.  K is unsymmetric through the friction that normal forces bring along.
/// Left out, because it is not stiff: the turning of g and B with the pose, the change of slip with the pose.
/// Arms and vectors are in the slider's frame, where n is an axis: g has no component about it.
template <class Law, class Friction, class Damping> struct JointLinearisation {
    /// @return how many apex–face pairs are in contact.
    template <class Real, class Memory>
    SLIDEWAY_FN static Real stiffness(JointFrame<Real> const& frame, Memory const& memory,
                                      JointParameters<Real> const& p, JointStiffness<Real>& out) {
        auto const& g = p.geometry;
        auto const& motion = frame.motion;
        auto const& v = motion.velocity;
        // 0, or NaN in a lane whose pose or motion is: else it would depend on its neighbours' contacts what such a lane gets.
        auto const& place = motion.axes.x;
        Real const whole = ((motion.y + motion.z) + (place.x + place.y)) +
                           (((v.x + v.y) + (v.z + frame.spin.x)) + (frame.spin.y + frame.spin.z));
        out.fill(whole - whole);
        Real touching(0.0);
        Vec3<Real> const& ny = motion.axes.y;
        auto const my = cross(motion.spin, ny);
        add_faces<Axis::y>(penetrations(g.clearance_y, g.half_width, g.half_depth, g.half_length,
                                        motion.axes.y_shortfall, ny.z, ny.x, motion.y, motion.z),
                           penetration_rates(g.half_width, g.half_depth, g.half_length, ny.y, ny.z, my.y, my.z, my.x,
                                             motion.y, motion.z, v.y, v.z),
                           {p.contact.surface_stiffness_y, p.contact.across_y_face, p.contact.along}, frame, memory, p,
                           out, touching);
        Vec3<Real> const& nz = motion.axes.z;
        auto const mz = cross(motion.spin, nz);
        add_faces<Axis::z>(penetrations(g.clearance_z, g.half_depth, g.half_width, g.half_length,
                                        motion.axes.z_shortfall, nz.y, nz.x, motion.z, motion.y),
                           penetration_rates(g.half_depth, g.half_width, g.half_length, nz.z, nz.y, mz.z, mz.y, mz.x,
                                             motion.z, motion.y, v.z, v.y),
                           {p.contact.surface_stiffness_z, p.contact.across_z_face, p.contact.along}, frame, memory, p,
                           out, touching);
        return touching;
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

    /// A generalized force: B_iᵀ f.
    template <class Real> struct Generalized {
        Translation<Real> push;
        Vec3<Real> turn;
    };

    /// A multiple of g, or a sum of the g of one face: level · (−s n) on the translations, turning about x and z.
    template <class Real> struct Gradient { Real level, x, z; };

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
                                      JointStiffness<Real>& out, Real& touching) {
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
            touching = touching + ((count<Real>(m.touching.a) + count<Real>(m.touching.b)) +
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
        auto const front = face.lever + face.lever_along, rear = face.lever - face.lever_along;
        Quad<Vec3<Real>> const lever{front + face.lever_across, front - face.lever_across, rear - face.lever_across,
                                     rear + face.lever_across};
        Quad<Generalized<Real>> force;  // B_iᵀ e_i
        if constexpr (Friction::enabled) {
            add_friction<axis>(face, lever, f.normal, p.friction, force, out.by_rate);
        } else {
            force = {bare_force(face, lever.a), bare_force(face, lever.b), bare_force(face, lever.c),
                     bare_force(face, lever.d)};
        }
        Quad<Gradient<Real>> const g{gradient(side, lever.a), gradient(side, lever.b), gradient(side, lever.c),
                                     gradient(side, lever.d)};
        add_product<axis>(face, force, coupled(f.by_depth, g), out.by_place);
        add_product<axis>(face, force, DampingStiffness<Damping>::couples ? coupled(f.by_rate, g) : own(f.by_rate, g),
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

    template <class Real> SLIDEWAY_FN static Gradient<Real> gradient(Real side, Vec3<Real> const& lever) {
        return {Real(1.0), side * lever.z, negated(side) * lever.x};
    }

    template <class Real>
    SLIDEWAY_FN static Generalized<Real> bare_force(Face<Real> const& face, Vec3<Real> const& lever) {
        Real const& s = face.side;
        return {{s * face.normal.y, s * face.normal.z}, {negated(s) * lever.z, Real(0.0), s * lever.x}};
    }

    /// B_iᵀ e_i with e = (x, s, z).
    template <class Real>
    SLIDEWAY_FN static Generalized<Real> force_of(Face<Real> const& face, Vec3<Real> const& lever, Real x, Real z) {
        return {{fma(face.side, face.normal.y, fma(face.x.y, x, face.z.y * z)),
                 fma(face.side, face.normal.z, fma(face.x.z, x, face.z.z * z))},
                cross(lever, {x, face.side, z})};
    }

    /// Σ_j slopes_ij g_j of the four apices i.
    template <class Real>
    SLIDEWAY_FN static Quad<Gradient<Real>> coupled(Quad<ApexSlopes<Real>> const& slopes,
                                                    Quad<Gradient<Real>> const& g) {
        auto const row = [](ApexSlopes<Real> const& r, Gradient<Real> const& own, Gradient<Real> const& across,
                            Gradient<Real> const& along, Gradient<Real> const& opposite) {
            return Gradient<Real>{
                (r.own + r.across) + (r.along + r.opposite),
                fma(r.own, own.x, fma(r.across, across.x, fma(r.along, along.x, r.opposite * opposite.x))),
                fma(r.own, own.z, fma(r.across, across.z, fma(r.along, along.z, r.opposite * opposite.z)))};
        };
        return {row(slopes.a, g.a, g.b, g.d, g.c), row(slopes.b, g.b, g.a, g.c, g.d), row(slopes.c, g.c, g.d, g.b, g.a),
                row(slopes.d, g.d, g.c, g.a, g.b)};
    }

    /// The same where each force depends on its own apex alone.
    template <class Real>
    SLIDEWAY_FN static Quad<Gradient<Real>> own(Quad<ApexSlopes<Real>> const& slopes, Quad<Gradient<Real>> const& g) {
        auto const row = [](Real const& slope, Gradient<Real> const& own) {
            return Gradient<Real>{slope, slope * own.x, slope * own.z};
        };
        return {row(slopes.a.own, g.a), row(slopes.b.own, g.b), row(slopes.c.own, g.c), row(slopes.d.own, g.d)};
    }

    /// matrix += Σ_i force_i rows_iᵀ.
    template <Axis axis, class Real>
    SLIDEWAY_FN static void add_product(Face<Real> const& face, Quad<Generalized<Real>> const& force,
                                        Quad<Gradient<Real>> const& rows, Real (*matrix)[5]) {
        Real const normal_y = negated(face.side) * face.normal.y, normal_z = negated(face.side) * face.normal.z;
        auto const add_row = [&](int i, Real const& a, Real const& b, Real const& c, Real const& d) {
            auto& row = matrix[i];
            Real const level = fma(a, rows.a.level, fma(b, rows.b.level, fma(c, rows.c.level, d * rows.d.level)));
            auto& last = row[place<axis>(2)];
            row[0] = fma(level, normal_y, row[0]);
            row[1] = fma(level, normal_z, row[1]);
            row[2] = fma(a, rows.a.x, fma(b, rows.b.x, fma(c, rows.c.x, fma(d, rows.d.x, row[2]))));
            last = fma(a, rows.a.z, fma(b, rows.b.z, fma(c, rows.c.z, fma(d, rows.d.z, last))));
        };
        auto const& f = force;
        add_row(0, f.a.push.y, f.b.push.y, f.c.push.y, f.d.push.y);
        add_row(1, f.a.push.z, f.b.push.z, f.c.push.z, f.d.push.z);
        add_row(place<axis>(0), f.a.turn.x, f.b.turn.x, f.c.turn.x, f.d.turn.x);
        if constexpr (Friction::enabled) {
            add_row(place<axis>(1), f.a.turn.y, f.b.turn.y, f.c.turn.y, f.d.turn.y);
        }
        add_row(place<axis>(2), f.a.turn.z, f.b.turn.z, f.c.turn.z, f.d.turn.z);
    }

    /// Index in ν of the spin about the face frame's x, y or z.
    template <Axis axis> SLIDEWAY_FN static constexpr int place(int direction) {
        if (axis == Axis::y || direction == 0) return 2 + direction;
        return direction == 1 ? 4 : 3;
    }

    /// With friction: all of B_iᵀ e_i, and −Σ F Bᵀ T B into the damping.
    template <Axis axis, class Real>
    SLIDEWAY_FN static void add_friction(Face<Real> const& face, Quad<Vec3<Real>> const& levers,
                                         Quad<Real> const& normal, FrictionParameters<Real> const& friction,
                                         Quad<Generalized<Real>>& force, Real (*damping)[5]) {
        Real const zero(0.0);
        // Σ F T; Σ F T C and Σ F Cᵀ T C with the columns (0, ρy), (ρz, −ρx), (−ρy, 0) of C, the slips that turning brings.
        Real xx = zero, xz = zero, zz = zero;
        Real p1 = zero, p2 = zero, p3 = zero, q1 = zero, q2 = zero;
        Real turn_xx = zero, turn_yy = zero, turn_zz = zero, turn_xy = zero, turn_yz = zero, turn_xz = zero;
        auto const add = [&](Vec3<Real> const& lever, Real const& load) {
            auto const v = face.velocity + cross(face.spin, lever);
            auto const slopes = StickSlipStiffness::apex(v.x, v.z, friction);
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
            return force_of(face, lever, slopes.push_x, slopes.push_z);
        };
        force = {add(levers.a, normal.a), add(levers.b, normal.b), add(levers.c, normal.c), add(levers.d, normal.d)};

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
