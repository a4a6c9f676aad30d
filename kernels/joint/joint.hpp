#pragma once

#include "kernels/joint/apices.hpp"
#include "kernels/joint/contact_report.hpp"
#include "kernels/joint/way.hpp"
#include "kernels/laws/contact.hpp"
#include "kernels/laws/face.hpp"
#include "kernels/laws/friction.hpp"
#include "kernels/math/vec3.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

template <class Real> struct JointParameters {
    JointGeometry<Real> geometry;
    WayParameters<Real> way;
    ContactParameters<Real> contact;
    FrictionParameters<Real> friction;
};

/// What the way does to the slider, in way coordinates.  The force is what acts on the translation: of the normal forces
/// without their component along the way's X, of friction all (model.md 4, 5).
template <class Real> struct Wrench {
    Vec3<Real> force;   // [N]
    Vec3<Real> torque;  // about the slider's centre [N m]
};

/// The clearance joint: eight apices → sixteen penetrations → contact modes → forces → wrench on the slider.
/// Source: Qian et al. 2020, 3.2; apices and faces as in its Table 2.  `Law`, `Friction` and `Damping` are chosen per scene.
template <class Law, class Friction, class Damping> struct Joint {
    static constexpr bool has_memory = Damping::has_memory;

    /// @tparam Full also fill the report (penetrations, forces, modes, powers); the wrench has the same bits without.
    /// @param outside set where a line contact is beyond its domain; the wrench of such a lane is NaN.
    template <bool Full, class Real, class Memory>
    SLIDEWAY_FN static Wrench<Real> wrench(JointMotion<Real> const& motion, Memory const& memory,
                                           JointParameters<Real> const& p, ContactReport<Real>* report,
                                           Mask<Real>& outside) {
        auto const& g = p.geometry;
        Real const zero(0.0);
        outside = mask_of<Real>(false);
        if constexpr (Full) report->clear();
        Wrench<Real> w{{zero, zero, zero}, {zero, zero, zero}};

        Vec3<Real> const& ny = motion.axes.y;
        auto const my = cross(motion.spin, ny);
        Vec3<Real> const& v = motion.velocity;
        FaceContact<Real> const y_face{p.contact.surface_stiffness_y, p.contact.across_y_face, p.contact.along};
        add_faces<Axis::y, Full>(penetrations(g.clearance_y, g.half_width, g.half_depth, g.half_length,
                                              motion.axes.y_shortfall, ny.z, ny.x, motion.y, motion.z),
                                 penetration_rates(g.half_width, g.half_depth, g.half_length, ny.y, ny.z, my.y, my.z,
                                                   my.x, motion.y, motion.z, v.y, v.z),
                                 ny, g.half_width, g.half_depth, y_face, motion, memory, p, report, outside, w);

        Vec3<Real> const& nz = motion.axes.z;
        auto const mz = cross(motion.spin, nz);
        FaceContact<Real> const z_face{p.contact.surface_stiffness_z, p.contact.across_z_face, p.contact.along};
        add_faces<Axis::z, Full>(penetrations(g.clearance_z, g.half_depth, g.half_width, g.half_length,
                                              motion.axes.z_shortfall, nz.y, nz.x, motion.z, motion.y),
                                 penetration_rates(g.half_depth, g.half_width, g.half_length, nz.z, nz.y, mz.z, mz.y,
                                                   mz.x, motion.z, motion.y, v.z, v.y),
                                 nz, g.half_depth, g.half_width, z_face, motion, memory, p, report, outside, w);
        return w;
    }

    /// Which of the sixteen apex–face pairs touch: bit 4·face + i for the i-th apex of a face, as a number.
    template <class Real>
    SLIDEWAY_FN static Real pattern(JointMotion<Real> const& motion, JointGeometry<Real> const& g) {
        Vec3<Real> const &ny = motion.axes.y, &nz = motion.axes.z;
        auto const y = penetrations(g.clearance_y, g.half_width, g.half_depth, g.half_length, motion.axes.y_shortfall,
                                    ny.z, ny.x, motion.y, motion.z);
        auto const z = penetrations(g.clearance_z, g.half_depth, g.half_width, g.half_length, motion.axes.z_shortfall,
                                    nz.y, nz.x, motion.z, motion.y);
        Real const one(1.0), sixteen(16.0);
        Real code = face_pattern(apices(z, negated(one)));
        code = fma(code, sixteen, face_pattern(apices(z, one)));
        code = fma(code, sixteen, face_pattern(apices(y, negated(one))));
        return fma(code, sixteen, face_pattern(apices(y, one)));
    }

private:
    enum class Axis { y, z };

    template <class Real> SLIDEWAY_FN static Real face_pattern(Quad<Real> const& depth) {
        Real const zero(0.0);
        auto const bit = [&](Real d, double value) { return select(d > zero, Real(value), zero); };
        return (bit(depth.a, 1.0) + bit(depth.b, 2.0)) + (bit(depth.c, 4.0) + bit(depth.d, 8.0));
    }

    /// The vector with `main` along the axis, `across` along the other of Y and Z.
    template <Axis axis, class Real> SLIDEWAY_FN static Vec3<Real> arranged(Real x, Real main, Real across) {
        if constexpr (axis == Axis::y) return {x, main, across};
        return {x, across, main};
    }

    /// Both faces normal to one of the slider's axes.
    template <Axis axis, bool Full, class Real, class Memory>
    SLIDEWAY_FN static void add_faces(FacePair<Real> const& depths, FacePair<Real> const& rates, Vec3<Real> const& n,
                                      Real half_main, Real half_across, FaceContact<Real> const& face,
                                      JointMotion<Real> const& motion, Memory const& memory,
                                      JointParameters<Real> const& p, ContactReport<Real>* report, Mask<Real>& outside,
                                      Wrench<Real>& w) {
        Real const zero(0.0);
        Real const p_main = axis == Axis::y ? motion.y : motion.z;
        Real const p_across = axis == Axis::y ? motion.z : motion.y;
        // Σ sF, Σ F, Σ s s_x F and Σ s s_across F: all that the wrench needs of eight forces along one normal.
        Real net = zero, total = zero, net_along = zero, net_across = zero;
        bool contact = false;
        for (int i = 0; i < 2; ++i) {
            Real const side(i == 0 ? 1.0 : -1.0);
            int const index = (axis == Axis::y ? 0 : 2) + i;
            FaceMotion<Real> m;
            m.depth = apices(depths, side);
            m.touching = {m.depth.a > zero, m.depth.b > zero, m.depth.c > zero, m.depth.d > zero};
            if constexpr (Full) report->set_penetrations(index, m.depth);
            bool const touched = any((m.touching.a | m.touching.b) | (m.touching.c | m.touching.d));
            if constexpr (Full && has_memory) report->set_rates(index, apices(rates, side));
            if (!touched) continue;
            contact = true;
            m.rate = apices(rates, side);
            m.impact_speed = {zero, zero, zero, zero};
            if constexpr (has_memory) m.impact_speed = memory.speeds[index];
            auto const f = Law::template forces<Damping>(m, face, p.contact);
            outside = outside | f.outside;
            Real const front = f.normal.a + f.normal.b, rear = f.normal.c + f.normal.d;
            Real const pushed = front + rear;
            net = fma(side, pushed, net);
            total = total + pushed;
            net_along = fma(side, front - rear, net_along);
            net_across = fma(side, (f.normal.a + f.normal.d) - (f.normal.b + f.normal.c), net_across);
            if constexpr (Full) report->add_face(index, m, f);
            if constexpr (Friction::enabled) {
                SlidingFace<Real> const sliding{n,
                                                arranged<axis>(zero, fms(side, half_main, p_main), negated(p_across)),
                                                {p.geometry.half_length, zero, zero},
                                                arranged<axis>(zero, zero, half_across),
                                                motion.velocity,
                                                motion.spin};
                auto const friction = Friction::load(sliding, f.normal, p.friction);
                w.force = w.force + friction.force;
                w.torque = w.torque + friction.torque;
                if constexpr (Full) report->friction_power = report->friction_power + friction.power;
            }
        }
        if (!contact) return;
        auto const force = net * n;
        auto const arm = arranged<axis>(p.geometry.half_length * net_along, fnma(p_main, net, half_main * total),
                                        fnma(p_across, net, half_across * net_across));
        w.force.y = w.force.y + force.y;
        w.force.z = w.force.z + force.z;
        w.torque = w.torque + cross(arm, n);
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
