#pragma once

#include "kernels/joint/face_pair.hpp"
#include "kernels/joint/joint.hpp"
#include "kernels/joint/way.hpp"
#include "kernels/laws/friction.hpp"
#include "kernels/math/vec3.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// What a force does to the two free translations of a mechanism: its power is (y·vy + z·vz).
template <class Real> struct Translation { Real y, z; };

/// The joint's pose and motion as its stiffness needs them.
template <class Real> struct JointFrame {
    ProfiledMotion<Real> motion;           // as the joint's forces see it, in way coordinates
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
template <class Real, class Laws> class JointLinearisation {
public:
    SLIDEWAY_FN JointLinearisation(JointFrame<Real> const& frame, ContactMemory<Real> const& memory,
                                   JointParameters<Real> const& p, Conditions<Laws> const& block,
                                   JointStiffness<Real>& out)
        : frame_(frame), memory_(memory), p_(p), block_(block), out_(out) {}

    /// @return how many apex–face pairs are in contact.
    SLIDEWAY_FN Real fill() {
        auto const& motion = frame_.motion;
        auto const& v = motion.velocity;
        // 0, or NaN in a lane whose pose or motion is: else it would depend on its neighbours' contacts what such a lane gets.
        auto const& place = motion.axes.x;
        Real const whole = ((motion.y + motion.z) + (place.x + place.y)) +
                           (((v.x + v.y) + (v.z + frame_.spin.x)) + (frame_.spin.y + frame_.spin.z));
        out_.fill(whole - whole);
        Real touching(0.0);
        add_faces<Axis::y>(cross(motion.spin, motion.axes.y), touching);
        add_faces<Axis::z>(cross(motion.spin, motion.axes.z), touching);
        return touching;
    }

private:
    /// A face in the frame x = sliding, y = its normal, z = across, for both axes.  For the Z faces that frame is left-handed:
    /// their levers are −ρ, which gives torques and slips their signs back.
    struct Face {
        Real side;
        Vec3<Real> lever, lever_along, lever_across;  // ρ = lever ± along ± across [m]
        Vec3<Real> velocity, spin;
        Translation<Real> x, normal, z;
    };

    /// A generalized force: B_iᵀ f.
    struct Generalized {
        Translation<Real> push;
        Vec3<Real> turn;
    };

    /// A multiple of g, or a sum of the g of one face: level · (−s n) on the translations, turning about x and z.
    struct Gradient { Real level, x, z; };

    /// @param m ω × n
    template <Axis axis> SLIDEWAY_FN void add_faces(Vec3<Real> const& m, Real& touching) {
        using Faces = FacePair<axis>;
        auto const& motion = frame_.motion;
        auto const depths = Faces::depths(motion, p_.geometry);
        auto const rates = Faces::rates(Faces::arranged(m), Faces::arranged(motion.velocity), motion, p_.geometry);
        Real const zero(0.0);
        for (int i = 0; i < 2; ++i) {
            Real const side(i == 0 ? 1.0 : -1.0);
            auto const depth = depths.on(side), rate = rates.on(side);
            FaceMotion<Real> face;
            face.touching = {depth.a > zero, depth.b > zero, depth.c > zero, depth.d > zero};
            if (!any_of(face.touching)) continue;
            Quad<Real> v0{zero, zero, zero, zero};
            if (block_.remembers) v0 = memory_.impact_speed[Faces::first_face + i];
            face.apex = {{depth.a, rate.a, v0.a}, {depth.b, rate.b, v0.b}, {depth.c, rate.c, v0.c}, {depth.d, rate.d, v0.d}};
            touching = touching + ((count<Real>(face.touching.a) + count<Real>(face.touching.b)) +
                                   (count<Real>(face.touching.c) + count<Real>(face.touching.d)));
            add_face<axis>(block_.law.stiffness(face, Faces::contact(p_.contact), p_.contact), side);
        }
    }

    /// Not inlined: the code would multiply.
    template <Axis axis> SLIDEWAY_NOINLINE void add_face(FaceStiffness<Real> const& f, Real side) {
        auto const face = face_of<axis>(side);
        auto const front = face.lever + face.lever_along, rear = face.lever - face.lever_along;
        Quad<Vec3<Real>> const lever{front + face.lever_across, front - face.lever_across, rear - face.lever_across,
                                     rear + face.lever_across};
        Quad<Generalized> force;  // B_iᵀ e_i
        if (block_.friction) {
            force = add_friction<axis>(face, lever, f.normal);
        } else {
            force = {bare_force(face, lever.a), bare_force(face, lever.b), bare_force(face, lever.c),
                     bare_force(face, lever.d)};
        }
        Quad<Gradient> const g{gradient(side, lever.a), gradient(side, lever.b), gradient(side, lever.c),
                               gradient(side, lever.d)};
        add_product<axis>(face, force, coupled(f.by_depth, g), out_.by_place);
        add_product<axis>(face, force, block_.law.couples() ? coupled(f.by_rate, g) : own(f.by_rate, g), out_.by_rate);
    }

    template <Axis axis> SLIDEWAY_FN Face face_of(Real side) const {
        auto const& g = p_.geometry;
        auto const& m = frame_.motion;
        // The way's axes in the slider's frame.
        Vec3<Real> const x{m.axes.x.x, m.axes.y.x, m.axes.z.x};
        Vec3<Real> const y{m.axes.x.y, m.axes.y.y, m.axes.z.y};
        Vec3<Real> const z{m.axes.x.z, m.axes.y.z, m.axes.z.z};
        Face face;
        face.side = side;
        face.lever_along = FacePair<axis>::arranged_axial(m.half_length * x);
        face.velocity = FacePair<axis>::arranged(frame_.velocity);
        face.spin = FacePair<axis>::arranged(frame_.spin);
        face.x = frame_.x;
        if constexpr (axis == Axis::y) {
            face.lever = FacePair<axis>::arranged_axial(fma(fms(side, g.half_width, m.y), y, negated(m.z) * z));
            face.lever_across = FacePair<axis>::arranged_axial(g.half_depth * z);
            face.normal = frame_.y_normal;
            face.z = frame_.z;
        } else {
            face.lever = FacePair<axis>::arranged_axial(fma(fms(side, g.half_depth, m.z), z, negated(m.y) * y));
            face.lever_across = FacePair<axis>::arranged_axial(g.half_width * y);
            face.normal = frame_.z_normal;
            face.z = frame_.y;
        }
        if (m.is_profiled) face.lever = face.lever + FacePair<axis>::arranged_axial(m.shift * x);
        return face;
    }

    SLIDEWAY_FN static Gradient gradient(Real side, Vec3<Real> const& lever) {
        return {Real(1.0), side * lever.z, negated(side) * lever.x};
    }

    SLIDEWAY_FN static Generalized bare_force(Face const& face, Vec3<Real> const& lever) {
        Real const& s = face.side;
        return {{s * face.normal.y, s * face.normal.z}, {negated(s) * lever.z, Real(0.0), s * lever.x}};
    }

    /// B_iᵀ e_i with e = (x, s, z).
    SLIDEWAY_FN static Generalized force_of(Face const& face, Vec3<Real> const& lever, Real x, Real z) {
        return {{fma(face.side, face.normal.y, fma(face.x.y, x, face.z.y * z)),
                 fma(face.side, face.normal.z, fma(face.x.z, x, face.z.z * z))},
                cross(lever, {x, face.side, z})};
    }

    /// Σ_j slopes_ij g_j of the four apices i.
    SLIDEWAY_FN static Quad<Gradient> coupled(Quad<ApexSlopes<Real>> const& slopes,
                                                    Quad<Gradient> const& g) {
        auto const row = [](ApexSlopes<Real> const& r, Gradient const& own, Gradient const& across,
                            Gradient const& along, Gradient const& opposite) {
            return Gradient{
                (r.own + r.across) + (r.along + r.opposite),
                fma(r.own, own.x, fma(r.across, across.x, fma(r.along, along.x, r.opposite * opposite.x))),
                fma(r.own, own.z, fma(r.across, across.z, fma(r.along, along.z, r.opposite * opposite.z)))};
        };
        return {row(slopes.a, g.a, g.b, g.d, g.c), row(slopes.b, g.b, g.a, g.c, g.d), row(slopes.c, g.c, g.d, g.b, g.a),
                row(slopes.d, g.d, g.c, g.a, g.b)};
    }

    /// The same where each force depends on its own apex alone.
    SLIDEWAY_FN static Quad<Gradient> own(Quad<ApexSlopes<Real>> const& slopes, Quad<Gradient> const& g) {
        auto const row = [](Real const& slope, Gradient const& own) {
            return Gradient{slope, slope * own.x, slope * own.z};
        };
        return {row(slopes.a.own, g.a), row(slopes.b.own, g.b), row(slopes.c.own, g.c), row(slopes.d.own, g.d)};
    }

    /// matrix += Σ_i force_i rows_iᵀ.
    template <Axis axis>
    SLIDEWAY_FN void add_product(Face const& face, Quad<Generalized> const& force,
                                 Quad<Gradient> const& rows, Real (*matrix)[5]) const {
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
        if (block_.friction) {
            add_row(place<axis>(1), f.a.turn.y, f.b.turn.y, f.c.turn.y, f.d.turn.y);
        }
        add_row(place<axis>(2), f.a.turn.z, f.b.turn.z, f.c.turn.z, f.d.turn.z);
    }

    /// Index in ν of the spin about the face frame's x, y or z.
    template <Axis axis> SLIDEWAY_FN static constexpr int place(int direction) {
        if (axis == Axis::y || direction == 0) return 2 + direction;
        return direction == 1 ? 4 : 3;
    }

    /// Σ F T; Σ F T C and Σ F Cᵀ T C with the columns (0, ρy), (ρz, −ρx), (−ρy, 0) of C, the slips that turning brings.
    struct SlipDamping {
        Real xx, xz, zz;
        Real p1, p2, p3, q1, q2;
        Real turn_xx, turn_yy, turn_zz, turn_xy, turn_yz, turn_xz;

        SLIDEWAY_FN void add(Vec3<Real> const& lever, Real a, Real b, Real c) {
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
        }
    };

    /// With friction: all of B_iᵀ e_i, and −Σ F Bᵀ T B into the damping.
    template <Axis axis>
    SLIDEWAY_FN Quad<Generalized> add_friction(Face const& face, Quad<Vec3<Real>> const& levers, Quad<Real> const& normal) {
        Real const zero(0.0);
        SlipDamping slip{zero, zero, zero, zero, zero, zero, zero, zero, zero, zero, zero, zero, zero, zero};
        auto const add = [&](Vec3<Real> const& lever, Real const& load) {
            auto const v = face.velocity + cross(face.spin, lever);
            auto const slopes = StickSlipStiffness::apex(v.x, v.z, p_.friction);
            slip.add(lever, load * slopes.xx, load * slopes.xz, load * slopes.zz);
            return force_of(face, lever, slopes.push_x, slopes.push_z);
        };
        Quad<Generalized> const force{add(levers.a, normal.a), add(levers.b, normal.b), add(levers.c, normal.c),
                                      add(levers.d, normal.d)};
        subtract<axis>(face, slip);
        return force;
    }

    template <Axis axis> SLIDEWAY_FN void subtract(Face const& face, SlipDamping const& slip) {
        auto const take = [&](int i, int j, Real const& value) {
            out_.by_rate[i][j] = out_.by_rate[i][j] - value;
            if (i != j) out_.by_rate[j][i] = out_.by_rate[j][i] - value;
        };
        constexpr int x = place<axis>(0), y = place<axis>(1), z = place<axis>(2);
        take(x, x, slip.turn_xx);
        take(x, y, slip.turn_xy);
        take(x, z, slip.turn_xz);
        take(y, y, slip.turn_yy);
        take(y, z, slip.turn_yz);
        take(z, z, slip.turn_zz);
        auto const& tx = face.x;
        auto const& tz = face.z;
        take(0, x, fma(tx.y, slip.p2, tz.y * slip.p3));
        take(1, x, fma(tx.z, slip.p2, tz.z * slip.p3));
        take(0, y, fma(tx.y, slip.q1, tz.y * slip.q2));
        take(1, y, fma(tx.z, slip.q1, tz.z * slip.q2));
        take(0, z, negated(fma(tx.y, slip.p1, tz.y * slip.p2)));
        take(1, z, negated(fma(tx.z, slip.p1, tz.z * slip.p2)));
        Real const x_y = fma(slip.xx, tx.y, slip.xz * tz.y), z_y = fma(slip.xz, tx.y, slip.zz * tz.y);
        Real const x_z = fma(slip.xx, tx.z, slip.xz * tz.z), z_z = fma(slip.xz, tx.z, slip.zz * tz.z);
        take(0, 0, fma(tx.y, x_y, tz.y * z_y));
        take(0, 1, fma(tx.z, x_y, tz.z * z_y));
        take(1, 1, fma(tx.z, x_z, tz.z * z_z));
    }

    JointFrame<Real> const& frame_;
    ContactMemory<Real> const& memory_;
    JointParameters<Real> const& p_;
    Conditions<Laws> const& block_;
    JointStiffness<Real>& out_;
};

}  // namespace slideway::inline SLIDEWAY_ISA
