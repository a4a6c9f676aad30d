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
    /// Whether a step may hold its contacts: HeldContacts is then the memory.
    static constexpr bool can_hold = Law::switches && !has_memory;

    /// @tparam Full also fill the report (penetrations, forces, modes, powers); the wrench has the same bits without.
    /// @param outside set where a line contact is beyond its domain; the wrench of such a lane is NaN.
    template <bool Full, class Real, class Memory>
    SLIDEWAY_FN static Wrench<Real> wrench(JointMotion<Real> const& motion, Memory const& memory,
                                           JointParameters<Real> const& p, ContactReport<Real>* report,
                                           Mask<Real>& outside) {
        outside = mask_of<Real>(false);
        if constexpr (Full) report->clear();
        // 0, or NaN in a lane whose pose is: else it would depend on its neighbours' contacts what such a lane gets.
        Real const whole = (motion.y + motion.z) + (motion.axes.x.x + motion.axes.y.z);
        Real const nothing = whole - whole;
        Wrench<Real> w;
        w.force = w.torque = {nothing, nothing, nothing};
        add_faces<Axis::y, Full>(motion.axes.y, motion.axes.y_shortfall, motion, memory, p, report, outside, w);
        add_faces<Axis::z, Full>(motion.axes.z, motion.axes.z_shortfall, motion, memory, p, report, outside, w);
        return w;
    }

    /// What a state has the contact code do, as a number: bit i where the i-th apex of either Y face touches, bit 4 + i for the Z
    /// faces.  The two faces of an axis are worked on in one pass, so that their sides make no difference.
    template <class Real>
    SLIDEWAY_FN static Real pattern(JointMotion<Real> const& motion, JointGeometry<Real> const& g) {
        return fma(Real(16.0), axis_pattern(z_depths(motion, g)), axis_pattern(y_depths(motion, g)));
    }

    /// Penetration of one apex in the Y or the Z face on its side [m].
    template <class Real>
    SLIDEWAY_FN static Real penetration(JointMotion<Real> const& motion, JointGeometry<Real> const& g, bool z_faces,
                                        int apex) {
        auto const depths = z_faces ? z_depths(motion, g) : y_depths(motion, g);
        int const first = z_faces ? 2 : 0;
        for (int side = 0; side < 2; ++side) {
            auto const of_face = apices(depths, Real(side == 0 ? 1.0 : -1.0));
            if (face_apex(first + side, 0) == apex) return of_face.a;
            if (face_apex(first + side, 1) == apex) return of_face.b;
            if (face_apex(first + side, 2) == apex) return of_face.c;
            if (face_apex(first + side, 3) == apex) return of_face.d;
        }
        return Real(not_a_number);
    }

    /// The longest way [m] that an apex made between two poses towards a face which it touches only in the second; 0 where none does.
    template <class Real>
    SLIDEWAY_FN static Real approach(JointMotion<Real> const& before, JointMotion<Real> const& after,
                                     JointGeometry<Real> const& g) {
        auto const y0 = y_depths(before, g), y1 = y_depths(after, g);
        auto const z0 = z_depths(before, g), z1 = z_depths(after, g);
        Real longest(0.0);
        for (int i = 0; i < 2; ++i) {
            Real const side(i == 0 ? 1.0 : -1.0);
            longest = max(longest, face_approach(apices(y0, side), apices(y1, side)));
            longest = max(longest, face_approach(apices(z0, side), apices(z1, side)));
        }
        return longest;
    }

private:
    enum class Axis { y, z };

    template <class Real>
    SLIDEWAY_FN static FacePair<Real> y_depths(JointMotion<Real> const& motion, JointGeometry<Real> const& g) {
        Vec3<Real> const& n = motion.axes.y;
        return penetrations(g.clearance_y, g.half_width, g.half_depth, g.half_length, motion.axes.y_shortfall, n.z, n.x,
                            motion.y, motion.z);
    }

    template <class Real>
    SLIDEWAY_FN static FacePair<Real> z_depths(JointMotion<Real> const& motion, JointGeometry<Real> const& g) {
        Vec3<Real> const& n = motion.axes.z;
        return penetrations(g.clearance_z, g.half_depth, g.half_width, g.half_length, motion.axes.z_shortfall, n.y, n.x,
                            motion.z, motion.y);
    }

    template <class Real> SLIDEWAY_FN static Real face_approach(Quad<Real> const& before, Quad<Real> const& after) {
        Real const zero(0.0);
        auto const way = [&](Real from, Real to) { return select((from <= zero) & (to > zero), to - from, zero); };
        return max(max(way(before.a, after.a), way(before.b, after.b)),
                   max(way(before.c, after.c), way(before.d, after.d)));
    }

    template <class Real> SLIDEWAY_FN static Real axis_pattern(FacePair<Real> const& depths) {
        Real const zero(0.0);
        auto const plus = apices(depths, Real(1.0)), minus = apices(depths, Real(-1.0));
        auto const bit = [&](Real p, Real m, double value) { return select(max(p, m) > zero, Real(value), zero); };
        return (bit(plus.a, minus.a, 1.0) + bit(plus.b, minus.b, 2.0)) +
               (bit(plus.c, minus.c, 4.0) + bit(plus.d, minus.d, 8.0));
    }

    /// A vector in the frame (x, main, across) of the faces normal to an axis, and back.  The Z faces' is (x, z, y), which is
    /// left-handed: angular velocities and torques change their sign.
    template <Axis axis, class Real> SLIDEWAY_FN static Vec3<Real> arranged(Vec3<Real> const& v) {
        if constexpr (axis == Axis::y) return v;
        return {v.x, v.z, v.y};
    }
    template <Axis axis, class Real> SLIDEWAY_FN static Vec3<Real> arranged_axial(Vec3<Real> const& v) {
        if constexpr (axis == Axis::y) return v;
        return {negated(v.x), negated(v.z), negated(v.y)};
    }

    /// Both faces normal to one of the slider's axes.
    template <Axis axis, bool Full, class Real, class Memory>
    SLIDEWAY_FN static void add_faces(Vec3<Real> const& face_normal, Real shortfall, JointMotion<Real> const& motion,
                                      Memory const& memory, JointParameters<Real> const& p, ContactReport<Real>* report,
                                      Mask<Real>& outside, Wrench<Real>& w) {
        constexpr bool is_y = axis == Axis::y;
        Real const zero(0.0);
        auto const& g = p.geometry;
        Real const half_main = is_y ? g.half_width : g.half_depth, half_across = is_y ? g.half_depth : g.half_width;
        Real const p_main = is_y ? motion.y : motion.z, p_across = is_y ? motion.z : motion.y;
        auto n = arranged<axis>(face_normal);
        auto depths = penetrations(is_y ? g.clearance_y : g.clearance_z, half_main, half_across, g.half_length,
                                   shortfall, n.z, n.x, p_main, p_across);
        Mask<Real> on_plus = deepest_apex(depths, Real(1.0)) > zero, on_minus = deepest_apex(depths, Real(-1.0)) > zero;
        constexpr int first = is_y ? 0 : 2;
        Real const half(0.5);
        bool holding = false;
        if constexpr (can_hold) {
            holding = any(memory.holding > half);
            if (holding) {
                on_plus = sum(memory.touching[first]) > half;
                on_minus = sum(memory.touching[first + 1]) > half;
            }
        }
        bool const rates_reported = Full && (has_memory || holding);
        if constexpr (Full) {
            report->set_penetrations(first, apices(depths, Real(1.0)));
            report->set_penetrations(first + 1, apices(depths, Real(-1.0)));
        }
        bool const touched = any(on_plus | on_minus);
        if (!rates_reported && !touched) return;

        auto v = arranged<axis>(motion.velocity);
        auto spin = arranged_axial<axis>(motion.spin);
        auto m = cross(spin, n);
        auto rates = penetration_rates(half_main, half_across, g.half_length, n.y, n.z, m.y, m.z, m.x, p_main, p_across,
                                       v.y, v.z);
        if constexpr (Full) {
            if (rates_reported) {
                report->set_rates(first, apices(rates, Real(1.0)));
                report->set_rates(first + 1, apices(rates, Real(-1.0)));
                if (!touched) return;
            }
        }
        FaceContact<Real> contact{is_y ? p.contact.surface_stiffness_y : p.contact.surface_stiffness_z,
                                  is_y ? p.contact.across_y_face : p.contact.across_z_face, p.contact.along};
        // Σ sF, Σ F, Σ s s_x F and Σ s s_across F: all that the wrench needs of eight forces along one normal.
        Real net = zero, total = zero, net_along = zero, net_across = zero;
        Vec3<Real> force{zero, zero, zero}, torque{zero, zero, zero};
        // A slider rarely touches on both sides: one pass takes each lane's face, a second the other face of those lanes that
        // touch on both.
        Mask<Real> const both = on_plus & on_minus;
        for (int pass = 0; pass < 2; ++pass) {
            Mask<Real> const is_plus = pass == 0 ? on_plus : mask_of<Real>(false);
            Mask<Real> const seen = pass == 0 ? mask_of<Real>(true) : both;
            Real const side = select(is_plus, Real(1.0), Real(-1.0));
            FaceMotion<Real> face;
            face.depth = apices(depths, side);
            face.rate = apices(rates, side);
            face.touching = {Mask<Real>(seen & (face.depth.a > zero)), Mask<Real>(seen & (face.depth.b > zero)),
                             Mask<Real>(seen & (face.depth.c > zero)), Mask<Real>(seen & (face.depth.d > zero))};
            if constexpr (can_hold) {
                if (holding) {
                    auto const& plus = memory.touching[first];
                    auto const& minus = memory.touching[first + 1];
                    face.touching = {Mask<Real>(seen & (select(is_plus, plus.a, minus.a) > half)),
                                     Mask<Real>(seen & (select(is_plus, plus.b, minus.b) > half)),
                                     Mask<Real>(seen & (select(is_plus, plus.c, minus.c) > half)),
                                     Mask<Real>(seen & (select(is_plus, plus.d, minus.d) > half))};
                }
            }
            face.impact_speed = {zero, zero, zero, zero};
            if constexpr (has_memory) {
                auto const& plus = memory.speeds[first];
                auto const& minus = memory.speeds[first + 1];
                face.impact_speed = {select(is_plus, plus.a, minus.a), select(is_plus, plus.b, minus.b),
                                     select(is_plus, plus.c, minus.c), select(is_plus, plus.d, minus.d)};
            }
            auto f = Law::template forces<Damping, Full>(face, contact, p.contact);
            outside = outside | f.outside;
            Real const front = f.normal.a + f.normal.b, rear = f.normal.c + f.normal.d;
            Real const pushed = front + rear;
            net = fma(side, pushed, net);
            total = total + pushed;
            net_along = fma(side, front - rear, net_along);
            net_across = fma(side, (f.normal.a + f.normal.d) - (f.normal.b + f.normal.c), net_across);
            if constexpr (Full) report->add_face(first, is_plus, face, f);
            if constexpr (Friction::enabled) {
                SlidingFace<Real> sliding{
                    n, fms(side, half_main, p_main), negated(p_across), g.half_length, half_across, v, spin};
                auto friction = Friction::load(sliding, f.normal, p.friction);
                force = force + friction.force;
                torque = torque + friction.torque;
                if constexpr (Full) report->friction_power = report->friction_power + friction.power;
            }
            if (none(both)) break;
        }
        Vec3<Real> arm{g.half_length * net_along, fnma(p_main, net, half_main * total),
                       fnma(p_across, net, half_across * net_across)};
        force = {force.x, fma(net, n.y, force.y), fma(net, n.z, force.z)};
        torque = torque + cross(arm, n);
        w.force = w.force + arranged<axis>(force);
        w.torque = w.torque + arranged_axial<axis>(torque);
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
