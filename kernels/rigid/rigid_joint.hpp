#pragma once

#include "kernels/joint/face_pair.hpp"
#include "kernels/real.hpp"
#include "kernels/rigid/joint_pairs.hpp"
#include "kernels/rigid/joint_settlement.hpp"
#include "kernels/rigid/joint_step_impulse.hpp"
#include "kernels/rigid/lasting_forces.hpp"
#include "kernels/rigid/rigid_memory.hpp"
#include "kernels/rigid/rigid_scales.hpp"
#include "kernels/rigid/rigid_slider_report.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// The contacts of a slider with a rigid joint in one state, whatever guides it along the way: none of this is a template of a mechanism, so that it is
/// compiled once per instruction set (host/backend/cpu_rigid_joint.cpp).
template <class Real> class RigidJoint {
public:
    using Pairs = JointPairs<Real>;
    using Memory = RigidJointMemory<Real>;
    using Contact = RigidJointContact<Real>;

    /// @param slip_unit [m/s]
    SLIDEWAY_FN RigidJoint(Pairs const& at, RigidSliderParameters<Real> const& p, bool friction, Real slip_unit)
        : at_(at), p_(p), friction_(friction ? &p.joint.friction : nullptr), slip_unit_(slip_unit) {}

    /// Of the pairs that last, on the slider, in the frames of the way and the joint.
    struct Forces {
        Vec3<Real> force, torque;
        Mask<Real> jammed;
        Real deepest;  // depth of all pairs [m]
    };
    /// @param contact what touches is told, if it is not nullptr  @param integrands_alone of it, what is integrated
    SLIDEWAY_NOINLINE Forces forces(Memory const& memory, Contact* contact, bool integrands_alone) const;

    /// What the watch sees of a state, without its forces.  @param contact its depths, rates and slips are filled in
    SLIDEWAY_NOINLINE void see(Memory const& memory, Contact& contact) const;

    /// The impacts where a step has ended, and which pairs last from there on.  @param located depth up to which an apex is located [m]
    /// @param contact of the report there  @param velocity before and after
    SLIDEWAY_NOINLINE void settle(Mask<Real> event, Real t, Real end, Real located, Memory& memory, Contact const& contact, Twist<Real>& velocity) const;
    /// Lanes with pairs that meet, are let go, or change between slipping and sticking.  @param event those with an impact among them
    SLIDEWAY_NOINLINE static Mask<Real> find(Mask<Real> in, Memory& memory, Contact const& contact, Real located, Real least_speed, bool friction,
                                             Mask<Real>& event);

    /// Impulses of a step of time stepping on what touches in its middle, where this joint is, with the velocity that the step has without them (M13.16).
    /// @param h of the step, 0 without one [s]  @param change of the rates in it without impulses [m/s]  @param start velocity at its start
    /// @param contact of the report in the middle, then with the impulses' books and modes
    /// @param velocity at its end, changed in `touching` lanes  @return lanes where there are no such impulses
    SLIDEWAY_NOINLINE Mask<Real> push(Real h, Real change, Twist<Real> const& start, Contact& contact, Twist<Real>& velocity,
                                      Mask<Real>& touching) const;

    /// Speed [m/s] below which a pair is at rest.
    SLIDEWAY_FN static Real least_speed(SliderParameters<Real> const& p) {
        return Real(slip_at_rest) * max(p.length_scale_y, p.length_scale_z) * p.rate_scale;
    }

private:
    /// β of (M13.10) [1/s]: what drifts is back within a part of the drive's period, or of the time that a free slider falls its length in.
    SLIDEWAY_FN Real drift_rate() const { return Real(10.0) * p_.pace; }

    /// Of all pairs [m].
    struct Depths {
        Quad<Real> of[face_count];
        Real deepest;

        SLIDEWAY_FN explicit Depths(Pairs const& at) {
            Real const one(1.0), minus(-1.0);
            auto const y = FacePair<Axis::y>::depths(at.motion, at.geometry()), z = FacePair<Axis::z>::depths(at.motion, at.geometry());
            of[0] = y.on(one), of[1] = y.on(minus), of[2] = z.on(one), of[3] = z.on(minus);
            deepest = max(max(y.largest(one), y.largest(minus)), max(z.largest(one), z.largest(minus)));
        }
    };

    SLIDEWAY_HD void see(Depths const& depths, Memory const& memory, Contact& contact) const {
        put_rates_of<Axis::y>(contact), put_rates_of<Axis::z>(contact);
        Real const far(-1.0), half(0.5), zero(0.0);
        auto const watched = [&](Real held, Real d) { return select(held > half, far, d); };
        Quad<Real> const none{zero, zero, zero, zero};
        for (int face = 0; face < face_count; ++face) {
            auto const& d = depths.of[face];
            auto const& held = memory.held[face];
            contact.penetration[face] = d;
            contact.slides[face] = contact.slip[0][face] = contact.slip[1][face] = none;
            contact.watched[face] = {watched(held.a, d.a), watched(held.b, d.b), watched(held.c, d.c), watched(held.d, d.d)};
        }
    }
    template <Axis axis> SLIDEWAY_HD void put_rates_of(Contact& contact) const {
        using Faces = FacePair<axis>;
        auto v = Faces::arranged(at_.motion.velocity);
        auto spin = Faces::arranged_axial(at_.motion.spin);
        auto const rates = Faces::rates(cross(spin, Faces::normal(at_.motion)), v, at_.motion, at_.geometry());
        contact.rate[Faces::first_face] = rates.on(Real(1.0));
        contact.rate[Faces::first_face + 1] = rates.on(Real(-1.0));
    }
    /// Of one pair.  @param slip [m/s]
    SLIDEWAY_FN void tell_slip(int pair, LastingPairs<Real> const& last, Real const (&slip)[2], Real per_unit, Contact& contact) const {
        Real const zero(0.0), one(1.0), minus(-1.0);
        number_of(contact.slides, pair) = select(last.held[pair], select(last.sticks[pair], minus, one), zero);
        for (int j = 0; j < 2; ++j) number_of(contact.slip[j], pair) = select(last.held[pair], slip[j] * per_unit, zero);
    }
    SLIDEWAY_HD void tell_loads(LastingForces<Real> const& lasting, Contact& contact) const {
        for (int face = 0; face < face_count; ++face) {
            auto const* const force = &lasting.normal[4 * face];
            contact.normal_force[face] = {force[0], force[1], force[2], force[3]};
        }
        contact.friction_power = lasting.friction_power;
        contact.damping_power = negated(lasting.normal_power);
    }
    /// What no integral asks for: slips, loads, and in which way the slider touches.
    SLIDEWAY_HD void tell_modes(LastingForces<Real> const& lasting, LastingPairs<Real> const& last, Contact& contact) const {
        Real const per_unit = Real(1.0) / slip_unit_;
        for (int i = 0; i < pair_count; ++i) {
            tell_slip(i, last, {lasting.slip[0][i], lasting.slip[1][i]}, per_unit, contact);
            number_of(contact.loads.normal, i) = lasting.normal[i];
            for (int j = 0; j < 2; ++j) number_of(contact.loads.along[j], i) = lasting.along[j][i];
        }
        for (int face = 0; face < face_count; ++face) {
            auto const* const touch = &last.held[4 * face];
            contact.count_modes(Quad<Mask<Real>>{touch[0], touch[1], touch[2], touch[3]});
        }
    }

    Pairs const& at_;
    RigidSliderParameters<Real> const& p_;
    FrictionParameters<Real> const* friction_;  // nullptr without
    Real slip_unit_;
};

template <class Real>
SLIDEWAY_HD auto RigidJoint<Real>::forces(Memory const& memory, Contact* contact, bool integrands_alone) const -> Forces {
    // NaN in a lane whose pose is, whatever its neighbours touch.
    Real const whole = (at_.motion.y + at_.motion.z) + (at_.motion.axes.x.x + at_.motion.axes.y.z), nothing = whole - whole;
    Forces on{{nothing, nothing, nothing}, {nothing, nothing, nothing}, memory.jammed > Real(0.0), {}};
    auto const last = LastingPairs<Real>::of(mask_of<Real>(true), memory);
    auto const holding = last.any();
    Depths const depths(at_);
    on.deepest = depths.deepest;
    if (contact != nullptr) {
        contact->clear(false);
        contact->loads.clear();
        contact->books = memory.books;
        if (!integrands_alone) see(depths, memory, *contact);
    }
    if (none(holding)) return on;
    LastingForces<Real> lasting;
    lasting.solve(at_, at_.velocity, depths.of, drift_rate(), last.held, last, memory.loads, friction_);
    on.force = select(holding, lasting.force.linear, on.force);
    on.torque = select(holding, from_slider(at_.motion.axes, lasting.force.angular), on.torque);
    on.jammed = on.jammed | (holding & lasting.failed);
    if (contact == nullptr) return on;
    tell_loads(lasting, *contact);
    if (!integrands_alone) tell_modes(lasting, last, *contact);
    return on;
}

template <class Real> SLIDEWAY_HD void RigidJoint<Real>::see(Memory const& memory, Contact& contact) const {
    see(Depths(at_), memory, contact);
    auto const last = LastingPairs<Real>::of(mask_of<Real>(true), memory);
    if (friction_ == nullptr || none(last.any())) return;
    Real const per_unit = Real(1.0) / slip_unit_;
    for (int i = 0; i < pair_count; ++i) {
        if (none(last.held[i])) continue;
        JointPair<Real> pair;
        at_.put_pair(i, pair);
        tell_slip(i, last, {dot(pair.slip[0], at_.velocity), dot(pair.slip[1], at_.velocity)}, per_unit, contact);
    }
}

template <class Real>
SLIDEWAY_HD Mask<Real> RigidJoint<Real>::find(Mask<Real> in, Memory& memory, Contact const& contact, Real located, Real least_speed, bool friction,
                                              Mask<Real>& event) {
    return JointSettlement<Real>::find(in, memory, contact, located, least_speed, friction, event);
}

template <class Real>
SLIDEWAY_HD void RigidJoint<Real>::settle(Mask<Real> event, Real t, Real end, Real located, Memory& memory, Contact const& contact,
                                          Twist<Real>& velocity) const {
    JointSettlement<Real> settlement(at_, p_, friction_, located, end, slip_unit_);
    settlement.run(event, t, velocity, memory, contact, least_speed(p_));
}

template <class Real>
SLIDEWAY_HD Mask<Real> RigidJoint<Real>::push(Real h, Real change, Twist<Real> const& start, Contact& contact, Twist<Real>& velocity,
                                              Mask<Real>& touching) const {
    JointStepImpulse<Real> impulse(h, change, contact, p_);
    if (any(impulse.touching())) {
        put_rates_of<Axis::y>(contact), put_rates_of<Axis::z>(contact);
        impulse.keep_meeting(contact);
    }
    touching = impulse.touching();
    if (any(touching)) velocity = impulse.solve(at_, start, p_.restitution, friction_ != nullptr ? &friction_->kinetic_coefficient : nullptr, least_speed(p_));
    return impulse.tell(contact);
}

}  // namespace slideway::inline SLIDEWAY_ISA
