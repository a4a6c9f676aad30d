#pragma once

#include "kernels/real.hpp"
#include "kernels/rigid/joint_impact.hpp"
#include "kernels/rigid/lasting_forces.hpp"
#include "kernels/rigid/rigid_memory.hpp"
#include "kernels/rigid/rigid_scales.hpp"
#include "kernels/rigid/rigid_slider_report.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// What happens where steps of a slider with a rigid joint end.
///  - A pair meets: an impact, with Newton's restitution of each pair that comes nearer and Coulomb's friction, of all that are near at once
///    (M13.11).  Pairs that last take part, without restitution.
///  - Bounces that are about to end do so at once (M13.6), and so do impacts that follow one another in no time.
///  - Pairs that an impact leaves without a normal velocity last; those that nothing presses any longer and that part are let go.
template <class Guide, class Real> class JointSettlement {
public:
    using Pairs = JointPairs<Guide, Real>;
    using Memory = RigidJointMemory<Real>;

    /// @param pairs where the step has ended  @param friction nullptr without
    SLIDEWAY_HD JointSettlement(Pairs const& pairs, typename Guide::template At<Real> const& guide, SliderParameters<Real> const& p,
                                Real restitution, FrictionParameters<Real> const* friction, Real located, Real end)
        : pairs_(pairs), guide_(guide), p_(p), restitution_(restitution), friction_(friction), located_(located), end_(end) {}

    /// Which pairs meet, and which are let go.  @return lanes with either
    SLIDEWAY_HD static Mask<Real> find(Mask<Real> in, Memory& memory, RigidJointContact<Real> const& contact, Real located,
                                       Real least_speed, Mask<Real>& event) {
        Real const zero(0.0), one(1.0), half(0.5);
        auto const fresh = in & (memory.begun == zero);
        memory.begun = select(in, one, memory.begun);
        auto touches = mask_of<Real>(false), parts = mask_of<Real>(false);
        Real speeds = zero;
        for (int i = 0; i < pair_count; ++i) {
            Real const depth = number_of(contact.watched, i), rate = number_of(contact.rate, i);
            touches = touches | ((depth > negated(located)) & ((rate > zero) | fresh));
            Real& held = number_of(memory.held, i);
            auto const goes = in & (held > half) & (number_of(contact.normal_force, i) <= zero) & (rate < negated(least_speed));
            held = select(goes, zero, held);
            parts = parts | goes;
            speeds = speeds + rate;
        }
        // What is not finite has no events: it fails as what it is, and its books stay as they are.
        event = in & touches & (speeds - speeds == zero);
        return event | parts;
    }

    /// The event.  @param velocity of the slider, before and after
    SLIDEWAY_HD void run(Mask<Real> event, Real t, Twist<Real>& velocity, Memory& memory, RigidJointContact<Real> const& contact,
                         Real least_speed) {
        Real const zero(0.0), one(1.0), half(0.5);
        Mask<Real> near[pair_count], held[pair_count];
        for (int i = 0; i < pair_count; ++i) {
            held[i] = event & (number_of(memory.held, i) > half);
            near[i] = held[i] | (event & (number_of(contact.penetration, i) > Real(-4.0) * located_));
        }
        count_events(event, t, memory);
        auto const at_once = memory.at_once >= Real(most_with_restitution);
        Real restitution[pair_count];
        for (int i = 0; i < pair_count; ++i) restitution[i] = select(held[i] | at_once, zero, restitution_);
        JointImpact<Guide, Real> impact(pairs_, velocity, near);
        Real const* const coefficient = friction_ != nullptr ? &friction_->kinetic_coefficient : nullptr;
        Real const made = impact.solve(event, restitution, coefficient);
        auto const makes_energy = event & (made > Real(1e-12) * impact.energy_moved());
        if (coefficient != nullptr && any(makes_energy)) impact.limit_energy(pairs_, makes_energy, coefficient);
        memory.jammed = select(event & impact.failed, one, memory.jammed);
        Mask<Real> rests[pair_count];
        for (auto& rest : rests) rest = mask_of<Real>(false);
        auto met = mask_of<Real>(false);
        impact.each([&](int i, Real before, Real after) {
            rests[i] = near[i] & (after <= least_speed);
            met = met | (near[i] & (!held[i]) & (before < zero));
        });
        end_bounces(impact, contact, near, rests);
        impact.rest(event, rests);
        auto const force = impact.impulse();
        auto const taken = impact.taken();
        auto const change = impact.after - velocity;
        auto& books = memory.books;
        auto const book = [&](Real& account, Real amount) { account = select(event, amount, account); };
        book(books.work, guide_.impulse_work(force.linear, change.linear, p_));
        book(books.friction, taken.friction);
        book(books.damping, taken.damping);
        book(books.impulse, taken.impulse);
        book(books.count, count<Real>(met));
        // What has come to rest along its normal lasts, until nothing presses it any longer.
        for (int i = 0; i < pair_count; ++i) {
            Real& kept = number_of(memory.held, i);
            kept = select(event, count<Real>(rests[i]), kept);
        }
        velocity = select(event, impact.after, velocity);
    }

private:
    /// Bounces that would be over in no time, or are lower than heights are known, have come to rest.  From speed γ against the acceleration a
    /// that those which rest leave it they are over after 2 γ/(a (1 − e)).
    SLIDEWAY_HD void end_bounces(JointImpact<Guide, Real> const& impact, RigidJointContact<Real> const& contact,
                                 Mask<Real> const (&near)[pair_count], Mask<Real> (&rests)[pair_count]) const {
        Real const zero(0.0), one(1.0);
        LastingForces<Guide, Real> lasting;
        lasting.solve(pairs_, impact.after, contact.penetration, zero, near, rests, friction_);
        for (int i = 0; i < pair_count; ++i) {
            Real const speed = lasting.gap_rate[i], twice = speed + speed;
            Real const pressing = negated(lasting.acceleration[i]), braking = pressing * (one - restitution_);
            auto const ends = (twice <= Real(chatter_time) * braking) | (speed * speed <= Real(8.0) * located_ * pressing);
            rests[i] = rests[i] | (near[i] & (braking > zero) & ends);
        }
    }

    /// Events at one time that still have restitution; those after them come to what one impact without it comes to.
    static constexpr double most_with_restitution = 4;

    SLIDEWAY_HD void count_events(Mask<Real> event, Real t, Memory& memory) const {
        Real const zero(0.0), one(1.0);
        auto const again = t - memory.last <= no_time(end_);
        memory.at_once = select(event, select(again, memory.at_once + one, zero), memory.at_once);
        memory.last = select(event, t, memory.last);
        memory.jammed = select(event & (memory.at_once >= Real(most_events_at_once)), one, memory.jammed);
    }

    Pairs const& pairs_;
    typename Guide::template At<Real> const& guide_;
    SliderParameters<Real> const& p_;
    Real restitution_;
    FrictionParameters<Real> const* friction_;
    Real located_, end_;
};

}  // namespace slideway::inline SLIDEWAY_ISA
