#pragma once

#include "kernels/conditions.hpp"
#include "kernels/joint/contact_memory.hpp"
#include "kernels/joint/contact_report.hpp"
#include "kernels/joint/face_pair.hpp"
#include "kernels/joint/held_contacts.hpp"
#include "kernels/joint/way.hpp"
#include "kernels/joint/wrench.hpp"
#include "kernels/laws/contact.hpp"
#include "kernels/laws/face.hpp"
#include "kernels/laws/friction.hpp"
#include "kernels/math/vec3.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// The clearance joint: eight apices → sixteen penetrations → contact modes → forces → wrench on the slider.
/// Source: Qian et al. 2020, 3.2; apices and faces as in its Table 2.
/// @tparam Laws of the Conditions  @tparam Full also fill the report (penetrations, forces, modes, powers); the wrench has the same
/// bits without  @tparam Motion a JointMotion, or a ProfiledMotion
template <class Real, class Laws, bool Full, class Motion = JointMotion<Real>> class Joint {
public:
    SLIDEWAY_FN Joint(Motion const& motion, ContactMemory<Real> const& memory, JointParameters<Real> const& p,
                      Conditions<Laws> const& block, ContactReport<Real>* report)
        : motion_(motion), memory_(memory), p_(p), block_(block), report_(report) {}

    /// @param outside set where a line contact is beyond its domain; the wrench of such a lane is NaN.
    SLIDEWAY_FN Wrench<Real> wrench(Mask<Real>& outside) {
        outside = mask_of<Real>(false);
        if constexpr (Full) report_->clear(block_.powers_alone);
        // 0, or NaN in a lane whose pose is: else it would depend on its neighbours' contacts what such a lane gets.
        Real const whole = (motion_.y + motion_.z) + (motion_.axes.x.x + motion_.axes.y.z);
        Real const nothing = whole - whole;
        Wrench<Real> w;
        w.force = w.torque = {nothing, nothing, nothing};
        if (block_.by_clocks && any(memory_.holding > Real(0.5))) {
            // Of a copy: what a function of its own sees stays in memory, and the faces below are to have it in registers.
            auto seen = motion_;
            auto held = HeldContacts<Real, Laws, Full, Motion>::wrench(seen, memory_, p_, block_, report_);
            clock_rate_ = held.clock_rate;
            outside = held.outside;
            w.force = w.force + held.wrench.force;
            w.torque = w.torque + held.wrench.torque;
            return w;
        }
        add_faces<Axis::y>(outside, w);
        add_faces<Axis::z>(outside, w);
        return w;
    }

    /// Whether the depth of a pair is the clock's in any lane, and then its rate δ' [m/s].
    SLIDEWAY_FN bool has_clock() const { return block_.by_clocks && any(memory_.clock > Real(-0.5)); }
    SLIDEWAY_FN Real clock_rate() const { return clock_rate_; }

private:
    static constexpr bool may_have_profile = requires(Motion const& motion) { motion.profile; };

    /// What all that is pushed on one pair of faces comes to, in their frame.
    struct Push {
        // Σ sF, Σ F, Σ s s_x F and Σ s s_across F: all that the wrench needs of eight forces along one normal.
        Real net, total, along, across;
        Vec3<Real> force, torque;  // of friction

        SLIDEWAY_FN void add(Real side, Quad<Real> const& normal) {
            Real const front = normal.a + normal.b, rear = normal.c + normal.d;
            Real const pushed = front + rear;
            net = fma(side, pushed, net);
            total = total + pushed;
            along = fma(side, front - rear, along);
            across = fma(side, (normal.a + normal.d) - (normal.b + normal.c), across);
        }
    };

    /// Lanes that touch either face of a pair.
    struct Sides { Mask<Real> plus, minus; };

    /// Both faces normal to one of the slider's axes.
    template <Axis axis> SLIDEWAY_CARD_CALL void add_faces(Mask<Real>& outside, Wrench<Real>& w) {
        using Faces = FacePair<axis>;
        auto depths = Faces::depths(motion_, p_.geometry);
        bool const holding = block_.holds_contacts && any(memory_.holding > Real(0.5));
        auto touched = sides<axis>(depths, holding);
        bool const rates_reported = Full && !block_.powers_alone && (block_.remembers || block_.continuous || holding);
        if constexpr (Full) {
            if (!block_.powers_alone) {
                report_->penetration[Faces::first_face] = depths.on(Real(1.0));
                report_->penetration[Faces::first_face + 1] = depths.on(Real(-1.0));
            }
        }
        bool const touches = any(touched.plus | touched.minus);
        if (!rates_reported && !touches) return;
        auto v = Faces::arranged(motion_.velocity);
        auto spin = Faces::arranged_axial(motion_.spin);
        auto n = Faces::normal(motion_);
        auto rates = Faces::rates(cross(spin, n), v, motion_, p_.geometry);
        if constexpr (Full) {
            if (rates_reported) {
                report_->rate[Faces::first_face] = rates.on(Real(1.0));
                report_->rate[Faces::first_face + 1] = rates.on(Real(-1.0));
                if (!touches) return;
            }
        }
        Real const zero(0.0);
        Push push{zero, zero, zero, zero, {zero, zero, zero}, {zero, zero, zero}};
        // A slider rarely touches on both sides: one pass takes each lane's face, a second the other face of those lanes that
        // touch on both.
        Mask<Real> const both = touched.plus & touched.minus;
        auto contact = Faces::contact(p_.contact);
        for (int pass = 0; pass < 2; ++pass) {
            Mask<Real> const is_plus = pass == 0 ? touched.plus : mask_of<Real>(false);
            Mask<Real> const seen = pass == 0 ? mask_of<Real>(true) : both;
            Real const side = select(is_plus, Real(1.0), Real(-1.0));
            FaceMotion<Real> face;
            set_motion<axis>(face, depths.on(side), rates.on(side), is_plus);
            set_touching<axis>(face, seen, holding, is_plus);
            auto f = loads(face, contact);
            outside = outside | f.outside;
            push.add(side, f.normal);
            if constexpr (may_have_profile) push.force.x = push.force.x + motion_.push(Faces::first_face / 2, side, f.normal.a + f.normal.b, f.normal.c + f.normal.d);
            if constexpr (Full) {
                report_->add_powers(face, f);
                if (!block_.powers_alone) report_->add_face(Faces::first_face, is_plus, face, f);
            }
            auto const friction = friction_of<axis>({n, fms(side, Faces::half_main(p_.geometry), Faces::main(motion_)),
                                                     negated(Faces::across(motion_)), segment_half(motion_, p_.geometry.half_length),
                                                     Faces::half_across(p_.geometry), velocity_of_middle(motion_, v, spin), spin},
                                                    f.normal);
            push.force = push.force + friction.force;
            push.torque = push.torque + friction.torque;
            add_torque_of_middle(motion_, friction.force, push.torque);
            if constexpr (Full) report_->friction_power = report_->friction_power + friction.power;
            if (none(both)) [[likely]] break;
        }
        add_push<axis>(push, n, w);
    }

    /// What the law says of a face.
    SLIDEWAY_FN auto loads(FaceMotion<Real> const& face, FaceContact<Real> const& contact) const {
        if constexpr (Full) {
            return block_.law.forces(face, contact, p_.contact);
        } else {
            return block_.law.normals(face, contact, p_.contact);
        }
    }

    template <Axis axis> SLIDEWAY_FN Sides sides(auto const& depths, bool holding) const {
        if (!holding) {
            Real const zero(0.0);
            return {depths.largest(Real(1.0)) > zero, depths.largest(Real(-1.0)) > zero};
        }
        Real const half(0.5);
        constexpr int first = FacePair<axis>::first_face;
        return {sum(memory_.held[first]) > half, sum(memory_.held[first + 1]) > half};
    }

    template <Axis axis>
    SLIDEWAY_FN void set_motion(FaceMotion<Real>& face, Quad<Real> const& depth, Quad<Real> const& rate,
                                Mask<Real> is_plus) const {
        constexpr int first = FacePair<axis>::first_face;
        auto const& plus = memory_.impact_speed[first];
        auto const& minus = memory_.impact_speed[first + 1];
        auto const set = [](ApexMotion<Real>& apex, Real const& d, Real const& v) { apex.depth = d, apex.rate = v; };
        set(face.apex.a, depth.a, rate.a);
        set(face.apex.b, depth.b, rate.b);
        set(face.apex.c, depth.c, rate.c);
        set(face.apex.d, depth.d, rate.d);
        if (!block_.remembers) [[likely]] return;  // and nobody asks
        face.apex.a.impact_speed = select(is_plus, plus.a, minus.a);
        face.apex.b.impact_speed = select(is_plus, plus.b, minus.b);
        face.apex.c.impact_speed = select(is_plus, plus.c, minus.c);
        face.apex.d.impact_speed = select(is_plus, plus.d, minus.d);
    }

    template <Axis axis>
    SLIDEWAY_FN void set_touching(FaceMotion<Real>& face, Mask<Real> seen, bool holding, Mask<Real> is_plus) const {
        auto const& apex = face.apex;
        if (!holding) [[likely]] {
            Real const zero(0.0);
            face.touching = {Mask<Real>(seen & (apex.a.depth > zero)), Mask<Real>(seen & (apex.b.depth > zero)),
                             Mask<Real>(seen & (apex.c.depth > zero)), Mask<Real>(seen & (apex.d.depth > zero))};
            return;
        }
        constexpr int first = FacePair<axis>::first_face;
        auto const& plus = memory_.held[first];
        auto const& minus = memory_.held[first + 1];
        Real const half(0.5);
        face.touching = {
            Mask<Real>(seen & (select(is_plus, plus.a, minus.a) > half)),
            Mask<Real>(seen & (select(is_plus, plus.b, minus.b) > half)),
            Mask<Real>(seen & (select(is_plus, plus.c, minus.c) > half)),
            Mask<Real>(seen & (select(is_plus, plus.d, minus.d) > half))};
    }

    /// Nothing where the scene has none.
    template <Axis axis>
    SLIDEWAY_FN FrictionLoad<Real> friction_of(SlidingFace<Real> const& sliding, Quad<Real> const& normal) const {
        if (block_.friction) [[likely]] return StickSlipFriction::load(sliding, normal, p_.friction);
        Real const zero(0.0);
        return {{zero, zero, zero}, {zero, zero, zero}, zero};
    }

    template <Axis axis> SLIDEWAY_FN void add_push(Push const& push, Vec3<Real> const& n, Wrench<Real>& w) const {
        using Faces = FacePair<axis>;
        auto const& g = p_.geometry;
        Vec3<Real> arm{segment_half(motion_, g.half_length) * push.along, fnma(Faces::main(motion_), push.net, Faces::half_main(g) * push.total),
                       fnma(Faces::across(motion_), push.net, Faces::half_across(g) * push.across)};
        if constexpr (may_have_profile) {
            if (motion_.is_profiled) arm.x = fma(motion_.shift, push.net, arm.x);
        }
        Vec3<Real> force{push.force.x, fma(push.net, n.y, push.force.y), fma(push.net, n.z, push.force.z)};
        w.force = w.force + Faces::arranged(force);
        w.torque = w.torque + Faces::arranged_axial(push.torque + cross(arm, n));
    }

    Motion const& motion_;
    ContactMemory<Real> const& memory_;
    JointParameters<Real> const& p_;
    Conditions<Laws> const& block_;
    ContactReport<Real>* const report_;
    Real clock_rate_ = Real(0.0);
};

}  // namespace slideway::inline SLIDEWAY_ISA
