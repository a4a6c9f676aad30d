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
template <class Real> class JointSettlement {
public:
    using Pairs = JointPairs<Real>;
    using Memory = RigidJointMemory<Real>;

    /// @param pairs where the step has ended  @param friction nullptr without
    SLIDEWAY_HD JointSettlement(Pairs const& pairs, RigidSliderParameters<Real> const& p, FrictionParameters<Real> const* friction, Real located, Real end,
                                Real slip_unit)
        : pairs_(pairs), p_(p), friction_(friction), located_(located), end_(end), slip_unit_(slip_unit) {}

    /// Which pairs meet, which are let go, and which change between slipping and sticking.  @return lanes with any of it
    SLIDEWAY_HD static Mask<Real> find(Mask<Real> in, Memory& memory, RigidJointContact<Real> const& contact, Real located,
                                       Real least_speed, bool friction, Mask<Real>& event) {
        Real const zero(0.0), one(1.0), half(0.5);
        auto const fresh = in & (memory.begun == zero);
        memory.begun = select(in, one, memory.begun);
        auto touches = mask_of<Real>(false), changed = mask_of<Real>(false);
        Real speeds = zero;
        for (int i = 0; i < pair_count; ++i) {
            Real const depth = number_of(contact.watched, i), rate = number_of(contact.rate, i);
            touches = touches | ((depth > negated(located)) & ((rate > zero) | fresh));
            Real& held = number_of(memory.held, i);
            auto const goes = in & (held > half) & (number_of(contact.normal_force, i) <= zero) & (rate < negated(least_speed));
            held = select(goes, zero, held);
            changed = changed | goes;
            if (friction) {
                Real const first = number_of(contact.slip[0], i), second = number_of(contact.slip[1], i);
                Real const square = fma(first, first, second * second);
                Real& sticks = number_of(memory.sticks, i);
                touches = touches | ((held > half) & (sticks <= half) & (square <= Real(slip_stops * slip_stops)));
                auto const slips = in & (held > half) & (sticks > half) & (square >= Real(slip_again * slip_again));
                sticks = select(slips, zero, sticks);
                changed = changed | slips;
            }
            speeds = speeds + rate;
        }
        // What is not finite has no events: it fails as what it is, and its books stay as they are.
        event = in & touches & (speeds - speeds == zero);
        return event | changed;
    }

    /// The event.  @param velocity of the slider, before and after
    SLIDEWAY_HD void run(Mask<Real> event, Real t, Twist<Real>& velocity, Memory& memory, RigidJointContact<Real> const& contact,
                         Real least_speed) {
        Real const zero(0.0), one(1.0);
        auto const* const coefficient = friction_ != nullptr ? &friction_->kinetic_coefficient : nullptr;
        auto const last = LastingPairs<Real>::of(event, memory);
        auto const& held = last.held;
        Mask<Real> near[pair_count];
        for (int i = 0; i < pair_count; ++i) near[i] = held[i] | (event & (number_of(contact.penetration, i) > Real(-4.0) * located_));
        memory.quick = select(event, select(t - memory.last <= Real(quick_time), memory.quick + one, zero), memory.quick);
        memory.count_event(event, t, end_);
        Mask<Real> const endless = memory.quick >= Real(most_quick_events), at_once = endless | (memory.at_once >= Real(most_with_restitution));
        Real restitution[pair_count];
        for (int i = 0; i < pair_count; ++i) restitution[i] = select(held[i] | at_once, zero, p_.restitution);
        JointImpact<Real> impact(pairs_, velocity, near, coefficient, least_speed);
        impact.solve(event, restitution);
        auto& pairs = impact.pairs;
        memory.jammed = select(event & pairs.failed, one, memory.jammed);
        Mask<Real> rests[pair_count];
        for (auto& rest : rests) rest = mask_of<Real>(false);
        auto met = mask_of<Real>(false);
        Real pattern = zero, speed[face_count] = {zero, zero, zero, zero};
        for (int k = 0; k < pairs.count(); ++k) {
            auto const& row = pairs.row(k);
            int const i = row.number;
            rests[i] = near[i] & (dot(row.pair.normal, pairs.after) <= least_speed);
            auto const meets = near[i] & (!held[i]) & (dot(row.pair.normal, pairs.before) < zero);
            met = met | meets;
            pattern = pattern + select(meets, Real(static_cast<double>(1u << i)), zero);
            int const face = i / 4;
            Mask<Real> const lasted = held[4 * face] | held[4 * face + 1] | held[4 * face + 2] | held[4 * face + 3];
            speed[face] = select(meets & !lasted, max(speed[face], negated(dot(row.pair.normal, pairs.before))), speed[face]);
        }
        Real const flight = end_bounces(pairs.after, contact, near, select(endless, Real(quick_time), Real(chatter_time)), rests);
        complete_faces(event, contact, rests);
        Mask<Real> still[pair_count];
        find_still(pairs, rests, met, still);
        pairs.rest(event, rests, still, coefficient);
        auto books = impact.books();
        books.count = count<Real>(met), books.met = pattern, books.flight = flight;
        for (int face = 0; face < face_count; ++face) books.speed[face] = speed[face];
        memory.books.take(event, books);
        keep(event, rests, still, memory);
        velocity = select(event, pairs.after, velocity);
    }

private:
    /// Which of the pairs that rest along their normals do so along their faces too.  In an impact the end of a slip sets others in motion, which is to be
    /// far below what bounces: there it has the least slip unit.
    SLIDEWAY_HD void find_still(PairSolver<Real> const& pairs, Mask<Real> const (&rests)[pair_count], Mask<Real> met,
                                Mask<Real> (&still)[pair_count]) const {
        Real const slow = Real(slip_stops) * select(met, p_.slip_scale, slip_unit_);
        for (auto& each : still) each = mask_of<Real>(false);
        if (friction_ == nullptr) return;
        for (int k = 0; k < pairs.count(); ++k) {
            auto const& row = pairs.row(k);
            Real const first = dot(row.pair.slip[0], pairs.after), second = dot(row.pair.slip[1], pairs.after);
            still[row.number] = row.here & rests[row.number] & (fma(first, first, second * second) <= slow * slow);
        }
    }

    /// What has come to rest along its normal lasts, until nothing presses it any longer; what has along its face too sticks.
    SLIDEWAY_HD static void keep(Mask<Real> event, Mask<Real> const (&rests)[pair_count], Mask<Real> const (&still)[pair_count], Memory& memory) {
        for (int i = 0; i < pair_count; ++i) {
            Real &held = number_of(memory.held, i), &sticks = number_of(memory.sticks, i);
            held = select(event, count<Real>(rests[i]), held);
            sticks = select(event, count<Real>(still[i]), sticks);
        }
    }

    /// Bounces that would be over in no time, or are lower than heights are known, have come to rest.  From speed γ against the acceleration a
    /// that those which rest leave it they are over after 2 γ/(a (1 − e)) (M13.6); those that end so change what the others feel.
    /// @return the longest such time [s]
    SLIDEWAY_HD Real end_bounces(Twist<Real> const& velocity, RigidJointContact<Real> const& contact, Mask<Real> const (&near)[pair_count],
                                 Real no_flight, Mask<Real> (&rests)[pair_count]) const {
        Real const zero(0.0), one(1.0);
        Real flight = zero;
        auto go_on = mask_of<Real>(true);
        for (int turn = 0; turn < most_turns && any(go_on); ++turn) {
            LastingPairs<Real> last;
            for (int i = 0; i < pair_count; ++i) last.held[i] = rests[i], last.sticks[i] = mask_of<Real>(false);
            LastingForces<Real> lasting;
            lasting.solve(pairs_, velocity, contact.penetration, zero, near, last, contact.loads, friction_);
            // Where none of the forces exist nothing is pressed.
            go_on = go_on & !lasting.failed;
            auto ended = mask_of<Real>(false), flies = ended;
            for (int i = 0; i < pair_count; ++i) {
                Real const speed = max(lasting.gap_rate[i], zero), twice = speed + speed;
                Real const pressing = negated(lasting.acceleration[i]), braking = pressing * (one - p_.restitution);
                auto const soon = (twice <= no_flight * braking) | (speed * speed <= Real(8.0) * located_ * pressing);
                auto const ends = go_on & near[i] & (!rests[i]) & (braking > zero) & soon;
                flight = max(flight, select(ends, twice / select(ends, braking, one), zero));
                rests[i] = rests[i] | ends;
                ended = ended | ends;
                flies = flies | (near[i] & !rests[i]);
            }
            go_on = ended & flies;
        }
        return flight;
    }
    static constexpr int most_turns = 4;

    /// The apices of a face lie in a plane: where three of them rest the fourth does.
    SLIDEWAY_HD void complete_faces(Mask<Real> event, RigidJointContact<Real> const& contact, Mask<Real> (&rests)[pair_count]) const {
        Real const close = Real(-1e-6) * min(p_.length_scale_y, p_.length_scale_z);
        for (int face = 0; face < face_count; ++face) {
            auto* const r = rests + 4 * face;
            auto const front = r[0] & r[1], rear = r[2] & r[3];
            auto const three = (front & (r[2] | r[3])) | (rear & (r[0] | r[1]));
            for (int i = 0; i < 4; ++i) r[i] = r[i] | (event & three & (number_of(contact.penetration, 4 * face + i) > close));
        }
    }

    /// Events at one time that still have restitution; those after them come to what one impact without it comes to.
    static constexpr double most_with_restitution = 4;

    Pairs const& pairs_;
    RigidSliderParameters<Real> const& p_;
    FrictionParameters<Real> const* friction_;
    Real located_, end_, slip_unit_;
};

}  // namespace slideway::inline SLIDEWAY_ISA
