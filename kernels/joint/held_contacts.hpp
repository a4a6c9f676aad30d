#pragma once

#include "kernels/conditions.hpp"
#include "kernels/joint/contact_memory.hpp"
#include "kernels/joint/contact_report.hpp"
#include "kernels/joint/face_pair.hpp"
#include "kernels/joint/held_face.hpp"
#include "kernels/joint/way.hpp"
#include "kernels/joint/wrench.hpp"
#include "kernels/laws/contact.hpp"
#include "kernels/laws/face.hpp"
#include "kernels/laws/friction.hpp"
#include "kernels/math/vec3.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// The contacts that a step within an impact holds.  A slider that rattles nearly always touches one face alone, with one or two apices: one
/// pass takes of each lane a face that it touches, whichever of the four, with its apices in the order of what touches (ApexOrder).
/// A pack of eight so works on two apices and an edge, where the passes of the Joint work on eight and eight.
/// @tparam Full also fill the report  @tparam Motion a JointMotion, or a ProfiledMotion
template <class Real, class Laws, bool Full, class Motion> class HeldContacts {
public:
    struct Result {
        Wrench<Real> wrench;
        Mask<Real> outside;  // a line contact is beyond its domain
        Real clock_rate;     // δ' of the pair whose depth is the clock's [m/s]
    };
    /// What they push.
    SLIDEWAY_NOINLINE static Result wrench(Motion const& motion, ContactMemory<Real> const& memory, JointParameters<Real> const& p,
                                           Conditions<Laws> const& block, ContactReport<Real>* report) {
        HeldContacts contacts(motion, memory, p, block, report);
        contacts.add();
        return contacts.result_;
    }

private:
    SLIDEWAY_FN HeldContacts(Motion const& motion, ContactMemory<Real> const& memory, JointParameters<Real> const& p,
                             Conditions<Laws> const& block, ContactReport<Real>* report)
        : motion_(motion), memory_(memory), p_(p), block_(block), report_(report) {
        Real const zero(0.0);
        result_ = {{{zero, zero, zero}, {zero, zero, zero}}, mask_of<Real>(false), zero};
    }

    SLIDEWAY_FN void add() {
        if constexpr (Full) {
            if (!block_.powers_alone) tell_depths<Axis::y>(), tell_depths<Axis::z>();
        }
        auto face = Face::unpacked(memory_.touched);
        if (none(face.touching.a)) return;
        if (block_.law.of_touching_alone() && none(face.touching.c | face.touching.d)) [[likely]] add_face<false>(face);
        else add_face_of_four(face);
        if (any(face.more)) [[unlikely]] add_further();
    }

    using Face = HeldFace<Real>;
    static constexpr bool may_have_profile = requires(Motion const& motion) { motion.profile; };

    SLIDEWAY_NOINLINE void add_face_of_four(Face const& face) { add_face<true>(face); }

    /// Faces that lanes touch beside the first.
    SLIDEWAY_NOINLINE void add_further() {
        auto left = Face::after_first(Face::faces_of(memory_));
        while (any(left.b | left.c | left.d)) {
            add_face_of_four(Face::first_of(left, memory_));
            left = Face::after_first(left);
        }
    }

    template <Axis axis> SLIDEWAY_FN void tell_depths() {
        using Faces = FacePair<axis>;
        auto depths = Faces::depths(motion_, p_.geometry);
        auto rates = Faces::rates(cross(Faces::arranged_axial(motion_.spin), Faces::normal(motion_)), Faces::arranged(motion_.velocity),
                                  motion_, p_.geometry);
        report_->penetration[Faces::first_face] = depths.on(Real(1.0));
        report_->penetration[Faces::first_face + 1] = depths.on(Real(-1.0));
        report_->rate[Faces::first_face] = rates.on(Real(1.0));
        report_->rate[Faces::first_face + 1] = rates.on(Real(-1.0));
    }

    /// The frame of a face, its place and its measures.
    SLIDEWAY_FN FaceFrame<Real> frame_of(Face const& face) const {
        auto const& g = p_.geometry;
        return {face.arranged(select(face.is_z, motion_.axes.z, motion_.axes.y)),
                face.choose(motion_.axes.y_shortfall, motion_.axes.z_shortfall),
                face.choose(motion_.y, motion_.z),
                face.choose(motion_.z, motion_.y),
                face.choose(g.half_width, g.half_depth),
                face.choose(g.half_depth, g.half_width),
                segment_half(motion_, g.half_length),
                face.choose(g.clearance_y, g.clearance_z)};
    }

    /// δ of the apices of a face, or δ', from those of a straight way.
    SLIDEWAY_FN auto seen([[maybe_unused]] Face const& face, ApexNumbers<Real> const& n, [[maybe_unused]] EndNumbers<Real> (WayProfile<Real>::*less)[2]) const {
        if constexpr (may_have_profile) {
            return motion_.is_profiled ? TaperedNumbers<Real>::less(n, chosen(face, motion_.profile.*less)) : TaperedNumbers<Real>::straight(n);
        } else {
            return n;
        }
    }
    SLIDEWAY_FN static EndNumbers<Real> chosen(Face const& face, EndNumbers<Real> const (&of)[2]) {
        return {face.choose(of[0].base, of[1].base), face.choose(of[0].middle, of[1].middle), face.choose(of[0].along, of[1].along),
                face.choose(of[0].skew, of[1].skew)};
    }
    /// Normal forces along a way whose gap opens, and the arm of their middle.
    template <bool all> SLIDEWAY_FN void add_along_way(Face const& face, Real side, Vec3<Real> const& n, Quad<Real> const& normal, Wrench<Real>& push) const {
        if (!motion_.is_profiled) return;
        auto const sums = face.order.template sums<all>(normal);
        Real const half(0.5);
        push.force.x = chosen(face, motion_.profile.push).applied(side, half * (sums.all + sums.along), half * (sums.all - sums.along));
        push.torque = push.torque + cross((side * sums.all) * motion_.middle(), n);
    }

    /// @tparam all or none of its apices touches beside the first two
    template <bool all> SLIDEWAY_FN void add_face(Face const& face) {
        auto frame = frame_of(face);
        auto v = face.arranged(motion_.velocity), spin = face.arranged_axial(motion_.spin);
        Real const side = face.side();
        auto depths = seen(face, frame.depths(), &WayProfile<Real>::depth), rates = seen(face, frame.rates(cross(spin, frame.normal), v), &WayProfile<Real>::rate);
        auto const& order = face.order;
        auto depth = depths.template on<all>(side, order), rate = rates.template on<all>(side, order);
        FaceMotion<Real> m;
        m.touching = face.touching;
        set(m.apex.a, depth.a, rate.a);
        set(m.apex.b, depth.b, rate.b);
        set(m.apex.c, depth.c, rate.c);
        set(m.apex.d, depth.d, rate.d);
        if (block_.remembers) [[unlikely]] set_impact_speeds(face, m);
        set_clock<all>(face, depths, rates, m);
        // Before the law: neither waits for the other.
        SlidingFace<Real> const sliding{frame.normal,
                                        fms(side, frame.half_main, frame.main),
                                        negated(frame.across),
                                        frame.half_length,
                                        frame.half_across,
                                        velocity_of_middle(motion_, v, spin),
                                        spin};
        Quad<Slip<Real>> slips;
        if (block_.friction) [[likely]] slips = StickSlipFriction::slips<all>(sliding, order, pressed(m.touching), p_.friction);
        auto f = loads(face, m);
        result_.outside = result_.outside | f.outside;
        if constexpr (Full) {
            report_->add_powers(m, f);
            if (!block_.powers_alone) report_->add_one_face(face.number(), order.to_face(f.normal), m, f);
        }
        auto push = pushed<all>(frame, side, order, f.normal);
        if constexpr (may_have_profile) add_along_way<all>(face, side, frame.normal, f.normal, push);
        if (block_.friction) [[likely]] {
            auto const friction = StickSlipFriction::load<all>(sliding, order, slips, f.normal);
            push.force = push.force + friction.force;
            push.torque = push.torque + friction.torque;
            add_torque_of_middle(motion_, friction.force, push.torque);
            if constexpr (Full) report_->friction_power = report_->friction_power + friction.power;
        }
        auto& w = result_.wrench;
        w.force = w.force + face.arranged(push.force);
        w.torque = w.torque + face.arranged_axial(push.torque);
    }

    /// Apices that may have forces.
    SLIDEWAY_FN Quad<Mask<Real>> pressed(Quad<Mask<Real>> const& touching) const {
        if (block_.law.of_touching_alone()) [[likely]] return touching;
        return {touching.a, touching.a, touching.a, touching.a};
    }

    SLIDEWAY_FN static void set(ApexMotion<Real>& apex, Real depth, Real rate) { apex.depth = depth, apex.rate = rate; }

    SLIDEWAY_FN void set_impact_speeds(Face const& face, FaceMotion<Real>& m) const {
        auto const speed = face.order.from_face(face.choose(memory_.impact_speed));
        m.apex.a.impact_speed = speed.a;
        m.apex.b.impact_speed = speed.b;
        m.apex.c.impact_speed = speed.c;
        m.apex.d.impact_speed = speed.d;
    }

    /// The pair of the clock has its depth from there; its rate is what the clock goes by.  Pairs of its face that are as deep, to the last
    /// bit, move as one with it: a slider that lands flat stays flat.
    template <bool all>
    SLIDEWAY_FN void set_clock(Face const& face, auto const& depths, auto const& rates, FaceMotion<Real>& m) {
        Real const side = face.side();
        Real const place = fnma(Real(4.0), face.number(), memory_.clock), plus(1.0), minus(-1.0);
        Mask<Real> const here = face.touching.a & (place > Real(-0.5)) & (place < Real(3.5));
        Mask<Real> const outer = (place < Real(0.5)) | (place > Real(2.5));
        Real const along = select(place < Real(1.5), plus, minus), across = select(outer, plus, minus);
        Real const depth = depths.at(side, along, across);
        result_.clock_rate = select(here, rates.at(side, along, across), result_.clock_rate);
        auto const set_depth = [&](ApexMotion<Real>& apex, Mask<Real> touches) {
            apex.depth = select(here & touches & (apex.depth == depth), memory_.clock_depth, apex.depth);
        };
        set_depth(m.apex.a, m.touching.a);
        set_depth(m.apex.b, m.touching.b);
        if constexpr (all) set_depth(m.apex.c, m.touching.c), set_depth(m.apex.d, m.touching.d);
    }

    /// What the law says of the face, its edges being those of the order.
    SLIDEWAY_FN auto loads(Face const& face, FaceMotion<Real> const& m) const {
        auto const& of = p_.contact;
        auto const line = [](Mask<Real> is, LineContact<Real> const& yes, LineContact<Real> const& no) {
            return LineContact<Real>{select(is, yes.scale, no.scale), select(is, yes.radius_rate, no.radius_rate)};
        };
        auto const across = line(face.is_z, of.across_z_face, of.across_y_face);
        auto const first = line(face.order.turned, of.along, across), second = line(face.order.turned, across, of.along);
        Real const stiffness = face.choose(of.surface_stiffness_y, of.surface_stiffness_z), area = face.choose(of.area_y, of.area_z);
        FaceContact<Real> const contact{stiffness, first, second, area};
        if constexpr (Full) {
            return block_.law.forces(m, contact, of);
        } else {
            return block_.law.normals(m, contact, of);
        }
    }

    /// What the normal forces come to, in the frame of the face.
    template <bool all>
    SLIDEWAY_FN static Wrench<Real> pushed(FaceFrame<Real> const& frame, Real side, ApexOrder<Real> const& order, Quad<Real> const& normal) {
        auto sums = order.template sums<all>(normal);
        Real const net = side * sums.all, along = side * sums.along, across = side * sums.across;
        auto n = frame.normal;
        Vec3<Real> arm{frame.half_length * along, fnma(frame.main, net, frame.half_main * sums.all),
                       fnma(frame.across, net, frame.half_across * across)};
        return {{Real(0.0), net * n.y, net * n.z}, cross(arm, n)};
    }

    Motion const& motion_;
    ContactMemory<Real> const& memory_;
    JointParameters<Real> const& p_;
    Conditions<Laws> const& block_;
    ContactReport<Real>* const report_;
    Result result_;
};

}  // namespace slideway::inline SLIDEWAY_ISA
