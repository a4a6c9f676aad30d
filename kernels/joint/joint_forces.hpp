#pragma once

#include "kernels/joint/contact_report.hpp"
#include "kernels/joint/face_pair.hpp"
#include "kernels/joint/way.hpp"
#include "kernels/joint/wrench.hpp"
#include "kernels/laws/friction.hpp"
#include "kernels/math/vec3.hpp"
#include "kernels/observers/quantities.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// The forces of a joint face by face, and of the pins beside it: for those who ask for them, from what the report tells in any case (model.md 17).
template <class Real> struct JointForces {
    Real force[face_count];     // normal force [N]
    Real along[face_count];     // where it acts along the way, from the slider's centre [m]; 0 without contact
    Real across[face_count];    // across the way from its axis, along Z at the Y faces and along Y at the Z faces [m]
    Real pv[face_count];        // Σ F V/A: pressure times sliding speed, its mean over the face [W/m²]
    Real pressure[face_count];  // Σ F/A [Pa]
    Quad<Real> approach[face_count], sliding[face_count];  // of the apices δ' and V [m/s]
    Vec3<Real> friction;        // on the slider, along the way's axes [N]
    Vec3<Real> contact;         // of the way on the slider, oil film included, along the axes of the ground [N]
    Vec3<Real> torque;          // of that about the centre of the slider's hole, likewise [N m]
    Vec3<Real> rod;             // of the rod on the slider [N]; 0 without a rod
    Vec3<Real> crank_pin;       // of the crank pin on the rod [N]

    /// Those of the joint; `contact` and `torque` along the way's axes.  @param rubs there is friction
    SLIDEWAY_FN void tell(ProfiledMotion<Real> const& motion, ContactReport<Real> const& report, JointParameters<Real> const& p, bool rubs) {
        Real const zero(0.0);
        friction = contact = torque = {zero, zero, zero};
        add_faces<Axis::y>(motion, report.normal_force, p, rubs);
        add_faces<Axis::z>(motion, report.normal_force, p, rubs);
        contact = contact + friction;
    }

    /// Value of an entry of `series_table` that is a force's.
    SLIDEWAY_FN Real series_value(int entry) const {
        using enum Series;
        constexpr auto follow = [](Series first, Series next, int rows) { return static_cast<int>(next) == static_cast<int>(first) + rows; };
        static_assert(follow(face_force_y_plus, face_along_y_plus, face_count) && follow(face_along_y_plus, face_across_y_plus, face_count) &&
                      follow(face_across_y_plus, face_pv_y_plus, face_count) && follow(face_pv_y_plus, friction_force_x, face_count));
        static_assert(follow(friction_force_x, contact_force_x, 3) && follow(contact_force_x, rod_force_x, 3) && follow(rod_force_x, crank_pin_force_x, 3) &&
                      follow(crank_pin_force_x, count, 3));
        int const place = entry - first_force_series, face = place % face_count, component = place - 4 * face_count;
        if (component < 0) return (place < face_count ? force : place < 2 * face_count ? along : place < 3 * face_count ? across : pv)[face];
        auto const& of = component < 3 ? friction : component < 6 ? contact : component < 9 ? rod : crank_pin;
        return component % 3 == 0 ? of.x : component % 3 == 1 ? of.y : of.z;
    }

private:
    template <Axis axis>
    SLIDEWAY_FN void add_faces(ProfiledMotion<Real> const& motion, Quad<Real> const* normals, JointParameters<Real> const& p, bool rubs) {
        using Faces = FacePair<axis>;
        Real const zero(0.0), one(1.0);
        auto const& g = p.geometry;
        auto const n = Faces::normal(motion), v = Faces::arranged(motion.velocity), spin = Faces::arranged_axial(motion.spin);
        Real const per_area = one / Faces::contact(p.contact).area;
        auto const rates = Faces::rates(cross(spin, n), v, motion, g);
        for (int i = Faces::first_face; i < Faces::first_face + 2; ++i) {
            Real const side(i == Faces::first_face ? 1.0 : -1.0);
            auto const& f = normals[i];
            Real const total = sum(f);
            auto const pushes = total > zero;
            Real const share = select(pushes, one / select(pushes, total, one), zero);
            force[i] = total;
            pressure[i] = total * per_area;
            approach[i] = rates.on(side);
            along[i] = fma(motion.half_length, ((f.a + f.b) - (f.c + f.d)) * share, select(pushes, motion.shift, zero));
            across[i] = Faces::half_across(g) * (((f.a + f.d) - (f.b + f.c)) * share);
            SlidingFace<Real> const rubbing{n, fms(side, Faces::half_main(g), Faces::main(motion)), negated(Faces::across(motion)), motion.half_length,
                                            Faces::half_across(g), velocity_of_middle(motion, v, spin), spin};
            auto const slip = StickSlipFriction::velocities(rubbing);
            auto& speed = sliding[i] = {sqrt(dot(slip.a, slip.a)), sqrt(dot(slip.b, slip.b)), sqrt(dot(slip.c, slip.c)), sqrt(dot(slip.d, slip.d))};
            pv[i] = per_area * fma(f.c, speed.c, fma(f.d, speed.d, fma(f.a, speed.a, f.b * speed.b)));
            Real const lengthwise = motion.push(Faces::first_face / 2, side, f.a + f.b, f.c + f.d);
            contact = contact + Faces::arranged(Vec3<Real>{lengthwise, side * total * n.y, side * total * n.z});
            Real const turned = side * total;
            Vec3<Real> const arm{turned * along[i], fnma(turned, Faces::main(motion), total * Faces::half_main(g)),
                                 turned * (across[i] - Faces::across(motion))};
            torque = torque + Faces::arranged_axial(cross(arm, n));
            if (!rubs) continue;
            auto const load = StickSlipFriction::load(rubbing, f, p.friction);
            friction = friction + Faces::arranged(load.force);
            auto of_friction = load.torque;
            add_torque_of_middle(motion, load.force, of_friction);
            torque = torque + Faces::arranged_axial(of_friction);
        }
    }
};

/// A report that has these, too.
template <class Real, class Report> struct ForceReport : Report {
    JointForces<Real> forces;  // where the block tells them

    /// Value of an entry of `series_table` beyond the state, or of a signal.
    SLIDEWAY_FN Real series_value(int entry) const {
        return entry >= first_force_series && entry < series_count ? forces.series_value(entry) : Report::series_value(entry);
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
