#pragma once

#include "kernels/lanes/free_steps.hpp"
#include "kernels/real.hpp"
#include "kernels/steppers/contact_clock.hpp"
#include "kernels/steppers/contact_watch.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// How contacts with forces limit steps by the clocks of impacts (ClockStep), beside those by time: a member remembers its step in flight while it is
/// in contact, and the first one of an impact until the next.  A touch or a parting ends its step.
template <class Stepper, class Model, class Real> class ClockedSteps : public FreeSteps<Stepper, Model, Real> {
    using Base = FreeSteps<Stepper, Model, Real>;
    using State = MemberState<Model, Real>;

public:
    using typename Base::Step;
    static constexpr int control_percent = 25;  // within an impact errors differ much

    /// A step that lands goes by time; within an impact that may fail, and then, or where it would nearly land, half of the way goes by the clock.
    SLIDEWAY_HD Mask<Real> choose(Step& step, Real remaining) {
        auto const& s = step.pack.state;
        auto clock = s.contacts.watch.clock(s.contacts.memory);
        in_contact_ = clock.runs();
        beside_ = s.contacts.watch.touching(s.contacts.memory) > Real(1.5);
        turned_ = mask_of<Real>(false);
        // Who starts in contact, or is left in one before any impact began, knows of no step by the clock yet.
        Real const known = s.course.clocked.step, by_time = s.course.h;
        Real const by_clock = min(select(known > Real(0.0), known, clock.own_of(by_time)), clock.way_out());
        Real const h = select(in_contact_, Real(1.02) * clock.time_of(by_clock), by_time);
        auto const failed = in_contact_ & (s.course.rejections > Real(0.5));
        Mask<Real> const lands = (remaining <= h * Real(Base::hair)) & !failed;
        auto const halves = in_contact_ & !lands & (remaining < Real(2.0) * h);
        clock.pair = select(step.pack.busy & !lands, clock.pair, Real(-1.0));
        Real const half = clock.own_of(Real(0.5) * remaining);
        Real const own = select(clock.runs(), select(halves, min(half, by_clock), by_clock), select(lands, remaining, h));
        step.stepper.go_by(clock, select(step.pack.busy, own, Real(0.0)), is_deep(clock, own));
        return lands;
    }

    /// By the clock of the last one.
    SLIDEWAY_HD Real next(Step& step, Mask<Real> accepted, Real factor) const {
        auto const& last = step.stepper.step();
        Real const own = last.own * factor;
        auto& clocked = step.pack.state.course.clocked;
        // Not of what an event has left over of a step.
        auto const whole = (own > clocked.flight_step) | (last.own > Real(0.1) * clocked.flight_step);
        clocked.flight_step = select(accepted & !in_contact_ & whole, own, clocked.flight_step);
        auto const begins = last.start.runs() & (last.start.rate > Real(0.0)) & (last.start.root < Real(0.1) * last.end.root);
        Real const first = own * sqrt(max(last.start.rate, Real(0.0)));
        clocked.alone = select(accepted & begins & !beside_, first, clocked.alone);
        clocked.beside = select(accepted & begins & beside_, first, clocked.beside);
        return select(accepted, last.end.ending(own), own);
    }

    /// Least time of it, if it is tried again.
    SLIDEWAY_HD Real time_of(Step const& step, Real next) const { return step.stepper.step().start.time_of(next); }

    /// Ends the step early at its first touch or parting.
    SLIDEWAY_HD Mask<Real> cut(Step& step, Allowance<Real>& allowed) {
        auto& pack = step.pack;
        auto const& last = step.stepper.step();
        Real const own = last.own;
        // A clock has steps of any size; what it does to time may round to nothing.
        Mask<Real> const long_enough = allowed.accepted & (last.start.runs() | (own > step.least_cut()));
        Real const depth = Real(located(step.settings.rtol, pack.needs.switches)) * Model::touch_scale(pack.state.constants.parameters);
        Real share = pack.state.contacts.watch.earliest(long_enough, pack.state.contacts.memory, step.attempt.report.contact, last, depth);
        auto cut = share < Real(1.0);
        if (any(cut)) cut = end_early(pack, step.stepper, step.attempt, cut, depth, share);
        ended_early_ = allowed.accepted & (share < Real(1.0)) & !cut;
        Real const least = select(last.start.runs(), Real(0.0), step.resolution() * Real(32.0));
        Base::reject(step, cut, max(own * share, least), allowed);
        return cut;
    }
    SLIDEWAY_HD Mask<Real> ended_early() const { return ended_early_; }
    /// Those within an impact: their step went past what the clock is for.
    SLIDEWAY_HD Mask<Real> failed_landings(Step const& step) const { return in_contact_ & step.lands; }

    SLIDEWAY_HD void advance(Step& step, Mask<Real> accepted, Real& /*next*/) {
        auto& pack = step.pack;
        auto& [memory, watch] = pack.state.contacts;
        auto const turned = watch.update(accepted, step.attempt.report.contact, memory, step.stepper.step(), pack.model.remembers());
        turned_ = turned.lanes;
        turn_modes(step);
        auto const touched = pack.needs.switches ? turned.lanes : turned.by_depth;
        if (any(touched)) step.restart(touched);
    }

    /// After a touch or a parting that which `turn` chooses.
    SLIDEWAY_HD void store_next(Step& step, Real wish, Real /*next*/) const {
        auto& c = step.pack.state.course;
        auto const busy = step.pack.busy;
        Real const longest = step.longest();
        c.h = select(busy & !in_contact_, min(wish, longest), c.h);
        c.clocked.step = select(busy & step.stepper.step().start.runs(), wish, c.clocked.step);
        if (any(turned_)) turn(step.pack.state, step.stepper, wish, longest);
    }

private:
    /// Ends steps at their first touch or parting.  @param share where the cubics of the depths have it, and where it is found
    /// @return lanes where it is not: they try again, shorter
    SLIDEWAY_NOINLINE Mask<Real> end_early(Pack<Model, Real>& pack, Stepper& stepper, Attempt<Model, Real>& to,
                                           Mask<Real> open, Real depth, Real& share) {
        auto const& [memory, watch] = pack.state.contacts;
        auto const& step = stepper.step();
        Real const whole = step.own;
        stepper.look_inside(pack, pack.start(), to, open);
        for (int tries = 0; tries < 4; ++tries) {
            stepper.end_early(pack, pack.start(), to, open, share);
            Real const again = watch.earliest(open, memory, to.report.contact, step, depth);
            Mask<Real> const beyond = open & (again < Real(1.0));
            Mask<Real> const before = open & !beyond & !watch.turns(memory, to.report.contact, step);
            open = beyond | before;
            if (none(open)) break;
            Real const on = watch.way_to_turn(memory, to.report.contact, step, depth) / whole;
            share = select(beyond, share * again, select(before, min(share + on, Real(0.9999)), share));
        }
        return open;
    }

    /// Where other contacts are held from here on.
    SLIDEWAY_HD void turn_modes(Step& step) const {
        auto& pack = step.pack;
        if (!pack.needs.quantities || none(turned_)) return;
        step.attempt.report.contact.take_modes(pack.state.contacts.memory.held);
        pack.state.observation.observer.turn_mode(turned_, step.attempt.report);
        pack.with_record(pack.state.forces, pack.needs.forces, [&](auto& f) { f.turn(turned_, pack.state.contacts.memory.held, step.attempt.report); });
    }

    /// Depth [clearances] up to which a touch counts as located: it errs by the impulse up to there, which goes with δ^2.5, or by that of
    /// a jump.  @param switches of the law: its forces jump there
    SLIDEWAY_HD static double located(double rtol, bool switches) {
        return switches ? ContactWatch<Real>::tolerance(Watching::modes) : 1e-4 * ::sqrt(rtol);
    }

    /// Steps that are deep within an impact: they neither begin near its touch nor end near its parting.
    SLIDEWAY_HD static Mask<Real> is_deep(ContactClock<Real> const& clock, Real own) {
        Mask<Real> const runs = clock.runs(), from_touch = clock.root > Real(0.5) * own * abs(clock.rate);
        Mask<Real> const from_parting = own < Real(0.4) * clock.way_out();
        return runs & from_touch & from_parting;
    }

    /// The step after a touch or a parting.  The first of an impact is as of the last one of its kind, alone or beside another contact; its
    /// length by the clock falls with the speed roughly as v^-0.6.  A contact that another one interrupted goes on as it was, a flight too.
    SLIDEWAY_HD void turn(State& s, Stepper const& stepper, Real next, Real longest) const {
        auto& clocked = s.course.clocked;
        auto const clock = s.contacts.watch.clock(s.contacts.memory);
        auto const beside = stepper.step().start.runs();
        Mask<Real> const touches = turned_ & clock.runs() & (clock.rate > Real(0.0));
        Mask<Real> const goes_on = turned_ & clock.runs() & !touches, flies = turned_ & !clock.runs();
        Real const root_speed = sqrt(max(clock.rate, Real(1e-12)));
        Real const alone = select(clocked.alone > Real(0.0), clocked.alone, sqrt(Real(1e-3) * clocked.flight_step));
        Real const as_before = select(beside, select(clocked.beside > Real(0.0), clocked.beside, Real(0.2) * alone), alone);
        clocked.outer = select(touches & beside, next, clocked.outer);
        clocked.step = select(touches, as_before / root_speed, select(goes_on, clocked.outer, clocked.step));
        s.course.h = select(flies, min(clocked.flight_step, longest), s.course.h);
    }

    Mask<Real> in_contact_ = mask_of<Real>(false);  // lanes whose step is within an impact, by whatever clock
    Mask<Real> beside_ = mask_of<Real>(false);      // lanes where several pairs touch
    Mask<Real> ended_early_ = mask_of<Real>(false);  // lanes whose step ended where a pair touched or parted inside of it
    Mask<Real> turned_ = mask_of<Real>(false);       // lanes whose step ended at a touch or a parting
};

}  // namespace slideway::inline SLIDEWAY_ISA
