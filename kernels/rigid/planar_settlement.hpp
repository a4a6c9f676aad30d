#pragma once

#include "kernels/math/trigonometry.hpp"
#include "kernels/mechanisms/planar_links.hpp"
#include "kernels/real.hpp"
#include "kernels/rigid/impact_energy.hpp"
#include "kernels/rigid/pair_choice.hpp"
#include "kernels/rigid/planar_stance.hpp"
#include "kernels/rigid/rattle.hpp"
#include "kernels/rigid/rigid_memory.hpp"
#include "kernels/rigid/rigid_planar_report.hpp"
#include "kernels/rigid/rigid_scales.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// What happens where steps of the rigid planar slider-crank end.
///  - A corner comes to its wall: an impact, with Newton's restitution of each contact that approaches and Coulomb's friction, of all
///    contacts at once (M13.3), (M13.4).  Held contacts take part, without restitution.
///  - Bounces that are about to end do so at once (M13.6).
///  - What lasts, how it slips and what opens follows from the accelerations (M13.5).
///  - Between events what is held is put back onto its wall, so that it does not drift.
template <class Real> class PlanarSettlement {
public:
    using Parameters = PlanarParameters<Real>;

    SLIDEWAY_HD PlanarSettlement(Parameters const& p, bool friction, DrivePlan const& drive, LoadList const& loads, Real located, Real end)
        : p_(p), friction_(friction), drive_(drive), loads_(loads), located_(located), end_(end) {}

    SLIDEWAY_FN static ContactState<Real> state_of(HeldContact<Real> const& held, Parameters const& p, bool friction) {
        Real const zero(0.0);
        Mask<Real> const closed = held.side != zero;
        if (!friction) return {closed, mask_of<Real>(false), held.slip, zero};
        return {closed, Mask<Real>(closed & (held.slip == zero)), held.slip, held.slip * p.friction.kinetic_coefficient};
    }

    /// @return lanes where anything has changed
    SLIDEWAY_HD Mask<Real> run(Mask<Real> in, Real t, Real* s, RigidMemory<Real>& memory, RigidPlanarContact<Real> const& contact) {
        Real const zero(0.0);
        memory.clear_books(in);
        auto const event = find_events(in, memory, contact);
        Mask<Real> const changed = event | (in & ((memory.held[0].side != zero) | (memory.held[1].side != zero)));
        if (none(changed)) return changed;
        PlanarLinks<Real> links(t, s, p_, drive_, loads_);
        links_ = &links;
        PlanarStance<Real> const stance(links, sincos(s[2]), side_[0], side_[1], p_);
        stance_ = &stance;
        spin_ = s[5];
        books_ = ImpactBooks<Real>::none();
        ContactState<Real> state[2] = {state_of(memory.held[0], p_, friction_), state_of(memory.held[1], p_, friction_)};
        if (any(event)) {
            // Where both corners are at their walls an impact of one may throw the other against its own.
            for (int i = 0; i < impacts_at_once && any(approaching(event)); ++i) collide(approaching(event));
            capture(event, state);
        }
        hold(changed, state);
        put_back(changed, s, event, state);
        if (any(event)) last(event, t, state, memory);
        if (links.turns_freely) s[3] = select(changed, links.w1, s[3]);
        s[4] = select(changed, links.w2, s[4]);
        s[5] = select(changed, spin_, s[5]);
        books_.met = met_corners();
        memory.books.take(changed, books_);
        return changed;
    }

private:
    /// Which corners touch, in lanes with an event, and where there is one.
    SLIDEWAY_HD Mask<Real> find_events(Mask<Real> in, RigidMemory<Real>& memory, RigidPlanarContact<Real> const& contact) {
        Real const zero(0.0), one(1.0), minus(-1.0);
        auto const& d = contact.penetration[0];
        auto const& w = contact.watched[0];
        auto const& v = contact.rate[0];
        Real const above[2] = {d.a, d.d}, below[2] = {d.b, d.c};
        Mask<Real> const fresh = in & (memory.begun == zero);
        memory.begun = select(in, one, memory.begun);
        auto const meets = [&](Real depth, Real rate) { return (depth > negated(located_)) & ((rate > zero) | fresh); };
        auto const touches = meets(w.a, v.a) | meets(w.b, v.b) | meets(w.c, v.c) | meets(w.d, v.d);
        auto const opens = min(min(contact.pressure[0], contact.pressure[1]), min(contact.grip[0], contact.grip[1])) < zero;
        // What is not finite has no events: it fails as what it is, and its books stay as they are.
        Real const speeds = v.a + v.c;
        Mask<Real> const event = in & (touches | opens) & (speeds - speeds == zero);
        for (int i = 0; i < 2; ++i) {
            auto const up = above[i] >= below[i];
            was_held_[i] = memory.held[i].side != zero;
            met_[i] = mask_of<Real>(false);
            side_[i] = select(was_held_[i], memory.held[i].side, select(up, one, minus));
            depth_[i] = select(side_[i] == one, above[i], below[i]);
            near_[i] = event & (was_held_[i] | (depth_[i] > negated(located_)));
            auto const inside = (!was_held_[i]) & (!fresh) & (depth_[i] > Real(most_overshoot) * p_.clearance);
            jammed_ = jammed_ | (event & inside);
        }
        return event;
    }

    /// The impact: (M13.3) and (M13.4).  Where friction would make energy of restitution only as much of that is left as takes none (M13.7).
    SLIDEWAY_HD void collide(Mask<Real> event) {
        Real const zero(0.0);
        auto const before = stance_->motion(links_->vx, links_->vy, spin_);
        PairQuestion<Real> question = question_of(before, event);
        for (int i = 0; i < 2; ++i) {
            question.present[i] = question.present[i] & (was_held_[i] | (before.normal[i] < zero));
            Real const e = select(was_held_[i], zero, p_.restitution);
            question.target[i] = negated(e) * min(before.normal[i], zero);
        }
        auto answer = PairChoice<Real>(stance_->pair, question).answer(friction_);
        jammed_ = jammed_ | (event & !answer.fits(before.size()));
        if (friction_) {
            Real const gain = energy_made(before, stance_->pair.after(before, answer.force), answer.force);
            auto const gains = event & (gain > Real(1e-12) * energy_moved(before, answer.force));
            if (any(gains)) {
                question.target[0] = question.target[1] = zero;
                auto const dead = PairChoice<Real>(stance_->pair, question).answer(friction_);
                limit_energy(gains, stance_->pair, before, dead.force, answer.force);
                books_.capped = max(books_.capped, count<Real>(gains));
            }
        }
        for (int i = 0; i < 2; ++i) {
            auto const met = event & answer.state[i].closed & !was_held_[i] & (before.normal[i] < zero);
            books_.count = books_.count + count<Real>(met);
            met_[i] = met_[i] | met;
        }
        push(event, before, answer.force);
    }

    /// Lanes where a corner at its wall moves against it.
    SLIDEWAY_HD Mask<Real> approaching(Mask<Real> event) const {
        auto const motion = stance_->motion(links_->vx, links_->vy, spin_);
        // What is held only drifts.
        auto const of = [&](int i) { return near_[i] & !was_held_[i] & (motion.normal[i] < Real(0.0)); };
        return event & (of(0) | of(1));
    }

    /// Lanes where both corners hit their walls in turn, ever sooner and without end.
    SLIDEWAY_HD Mask<Real> rattles(Mask<Real> event, PairOf<Real> const& motion) const {
        auto const both_free = (!was_held_[0]) & (!was_held_[1]) & (near_[0] | near_[1]);
        Real const drag[2] = {drag_of(motion, 0), drag_of(motion, 1)};
        return rattles_without_end(event & both_free, stance_->pair, motion, drag, depth_, p_.restitution, rattle_time(end_));
    }

    /// Friction over the normal force of a contact that slips as it does now.
    SLIDEWAY_FN Real drag_of(PairOf<Real> const& motion, int i) const {
        if (!friction_) return Real(0.0);
        Real const kinetic = p_.friction.kinetic_coefficient;
        return select(motion.along[i] < Real(0.0), negated(kinetic), kinetic);
    }

    /// Ends bounces that would be over in no time: those contacts are closed from now on.
    SLIDEWAY_HD void capture(Mask<Real> event, ContactState<Real> (&state)[2]) {
        Real const zero(0.0), one(1.0);
        auto const motion = stance_->motion(links_->vx, links_->vy, spin_);
        auto const rattling = rattles(event, motion);
        // Between bounces a contact has the acceleration that those which last leave it; from speed γ against the acceleration a they are
        // over after 2 γ/(a (1 − e)).
        auto const free = free_acceleration();
        auto const bouncing = stance_->pair.after(free, stance_->pair.solve(free, {zero, zero}, state));
        Mask<Real> may_last[2];
        Real time[2];
        for (int i = 0; i < 2; ++i) {
            Real const pressing = negated(bouncing.normal[i]), braking = pressing * (one - p_.restitution);
            Real const speed = max(motion.normal[i], zero), twice = speed + speed;
            // Also those that are lower than heights are known, and would go on as rounding has it.
            auto const soon = (twice <= Real(chatter_time) * braking) | (speed * speed <= Real(8.0) * located_ * pressing);
            auto const ends = (braking > zero) & soon;
            time[i] = twice / select(ends, braking, one);
            may_last[i] = event & near_[i] & (was_held_[i] | ends);
        }
        PairAnswer<Real> answer{};
        if (any(may_last[0] | may_last[1])) answer = lasting(event, motion, {near_[0], near_[1]});
        for (int i = 0; i < 2; ++i) {
            // One that lasted goes on only where the impact has not thrown it off.
            Real const bearing = answer.force.normal[i] * stance_->pair.nn[i][i];
            auto const stays = (!was_held_[i]) | (motion.normal[i] + motion.normal[i] <= Real(chatter_time) * bearing);
            Mask<Real> const ends = answer.state[i].closed & (answer.force.normal[i] > zero) & may_last[i] & stays;
            auto const bounces = ends & !was_held_[i];
            books_.flight = max(books_.flight, select(bounces, time[i], zero));
            auto const& found = answer.state[i];
            ContactState<Real> const kept{ends, Mask<Real>(ends & found.sticks), select(ends, found.way, zero), select(ends, found.drag, zero)};
            state[i] = select(event, kept, state[i]);
        }
        if (any(rattling)) come_to_rest(rattling, motion, state);
    }

    /// What impacts at both corners in turn come to: neither approaches, as after one impact without restitution.
    SLIDEWAY_HD void come_to_rest(Mask<Real> rattling, PairOf<Real> const& motion, ContactState<Real> (&state)[2]) {
        for (auto& near : near_) near = near | rattling;
        PairQuestion<Real> const question = question_of(motion, rattling);
        auto const answer = PairChoice<Real>(stance_->pair, question).answer(friction_);
        jammed_ = jammed_ | (rattling & !answer.fits(motion.size()));
        push(rattling, motion, answer.force);
        for (int i = 0; i < 2; ++i) state[i] = select(rattling, answer.state[i], state[i]);
    }

    /// Takes from closed contacts what is left of their normal velocity, and of their slip where they stick.  With the friction of the slip that
    /// they have; but a nearly wedged state makes much of next to nothing, and goes without.
    SLIDEWAY_HD void hold(Mask<Real> in, ContactState<Real> const (&state)[2]) {
        Real const zero(0.0);
        ContactState<Real> smooth[2] = {state[0], state[1]};
        for (auto& each : smooth) each.way = each.drag = zero;
        auto const before = stance_->motion(links_->vx, links_->vy, spin_);
        auto const impulse = stance_->pair.solve(before, {zero, zero}, state);
        auto const plain = stance_->pair.solve(before, {zero, zero}, smooth);
        Real const most = Real(4.0) * (abs(plain.normal[0]) + abs(plain.normal[1]));
        auto const tame = (abs(impulse.normal[0]) <= most) & (abs(impulse.normal[1]) <= most);
        push(in, before, select(tame, impulse, plain));
    }

    /// Puts corners that touch onto their walls.
    SLIDEWAY_HD void put_back(Mask<Real> in, Real* s, Mask<Real> event, ContactState<Real> const (&state)[2]) {
        Real const zero(0.0);
        PairOf<Real> gap;
        ContactState<Real> touching[2];
        for (int i = 0; i < 2; ++i) {
            gap.normal[i] = negated(depth_[i]);
            gap.along[i] = zero;
            touching[i] = {Mask<Real>(state[i].closed | (event & near_[i])), mask_of<Real>(false), zero, zero};
        }
        auto const load = stance_->load(stance_->pair.solve(gap, {zero, zero}, touching));
        auto const moved = links_->response(load.x, load.y, p_);
        if (links_->turns_freely) s[0] = select(in, s[0] + moved.a1, s[0]);
        s[1] = select(in, s[1] + moved.a2, s[1]);
        s[2] = select(in, s[2] + load.torque / p_.slider_inertia, s[2]);
    }

    /// Which contacts last, and how they slip: (M13.5).
    SLIDEWAY_HD void last(Mask<Real> event, Real t, ContactState<Real> const (&state)[2], RigidMemory<Real>& memory) {
        Real const zero(0.0), one(1.0);
        for (auto& held : memory.held) held = {select(event, zero, held.side), select(event, zero, held.slip)};
        if (any(event & (state[0].closed | state[1].closed))) {
            auto const answer = lasting(event, stance_->motion(links_->vx, links_->vy, spin_), {state[0].closed, state[1].closed});
            jammed_ = jammed_ | (event & !answer.fits(acceleration_));
            for (int i = 0; i < 2; ++i) {
                auto& held = memory.held[i];
                held.side = select(event, select(answer.state[i].closed, side_[i], zero), held.side);
                held.slip = select(event, answer.state[i].way, held.slip);
            }
        }
        memory.count_event(event, t, end_);
        memory.jammed = select(jammed_, one, memory.jammed);
    }

    /// The forces of contacts that are at rest along their normals.
    struct Closed { Mask<Real> is[2]; };
    SLIDEWAY_HD PairAnswer<Real> lasting(Mask<Real> event, PairOf<Real> const& motion, Closed const& closed) {
        Real const zero(0.0);
        auto const before = free_acceleration();
        PairQuestion<Real> question = question_of(before, event);
        question.holding = holding_coefficient(p_.friction);
        for (int i = 0; i < 2; ++i) {
            question.present[i] = question.present[i] & closed.is[i];
            question.slips[i] = abs(motion.along[i]) > Real(slip_at_rest) * slip_scale(p_);
            question.way[i] = select(motion.along[i] < zero, Real(-1.0), Real(1.0));
        }
        acceleration_ = before.size() + force_scale(p_) / p_.slider_mass;
        return PairChoice<Real>(stance_->pair, question).answer(friction_);
    }

    /// Of the contacts without forces in them.
    SLIDEWAY_HD PairOf<Real> free_acceleration() const {
        Real const zero(0.0);
        auto centre = links_->centre_acceleration(links_->accelerations(zero, zero, p_));
        return stance_->acceleration(centre.x, centre.y, spin_, links_->loads.torque / p_.slider_inertia);
    }

    SLIDEWAY_FN PairQuestion<Real> question_of(PairOf<Real> const& before, Mask<Real> event) const {
        return PairQuestion<Real>::of(before, event & near_[0], event & near_[1], friction_ ? p_.friction.kinetic_coefficient : Real(0.0));
    }

    /// Impulses in the contacts: new rates, and the books of them.
    SLIDEWAY_HD void push(Mask<Real> in, PairOf<Real> const& before, PairOf<Real> const& impulse) {
        Real const half(0.5);
        auto const load = stance_->load(impulse);
        auto const change = links_->response(load.x, load.y, p_);
        auto const after = stance_->pair.after(before, impulse);
        auto const add = [in](Real& sum, Real amount) { sum = select(in, sum + amount, sum); };
        if (!links_->turns_freely) add(books_.work, links_->w1 * fms(change.m12, change.a2, change.r1));
        for (int i = 0; i < 2; ++i) {
            add(books_.friction, negated(half * (before.along[i] + after.along[i])) * impulse.along[i]);
            add(books_.damping, negated(half * (before.normal[i] + after.normal[i])) * impulse.normal[i]);
            add(books_.impulse, impulse.normal[i]);
        }
        links_->turn_at(select(in, links_->w1 + change.a1, links_->w1), select(in, links_->w2 + change.a2, links_->w2));
        spin_ = select(in, spin_ + load.torque / p_.slider_inertia, spin_);
    }

    /// A bit for each corner that met its wall, a to d (PlanarCorners).
    SLIDEWAY_FN Real met_corners() const {
        auto const bit = [&](int i, double above, double below) {
            return select(met_[i], select(side_[i] > Real(0.0), Real(above), Real(below)), Real(0.0));
        };
        return bit(0, 1, 2) + bit(1, 8, 4);
    }

    Parameters const& p_;
    bool friction_;
    DrivePlan const& drive_;
    LoadList const& loads_;
    Real located_, end_;
    PlanarLinks<Real>* links_ = nullptr;
    PlanarStance<Real> const* stance_ = nullptr;
    Real side_[2], depth_[2], spin_, acceleration_;
    Mask<Real> near_[2], was_held_[2], met_[2], jammed_ = mask_of<Real>(false);
    ImpactBooks<Real> books_;
};

}  // namespace slideway::inline SLIDEWAY_ISA
