#pragma once

#include "kernels/lanes/pack_step.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// How contacts limit steps, where they do not: of a model without contacts, and of time stepping, which looks for them in each step anew.  Derived classes
/// replace functions by ones of the same name: how long steps are, where contacts end them, and what an accepted one leaves of these.
template <class Stepper, class Model, class Real> class FreeSteps {
public:
    using Step = PackStep<Stepper, Model, Real>;
    using Report = typename Model::template Report<Real>;
    static constexpr int control_percent = 20;  // of the exponent of step control that the former error has

    /// What the first evaluation of new members leaves of their contacts.
    /// @param rates of that evaluation, changed where contacts change them; so is its report
    SLIDEWAY_HD static Faults<Real> start(Pack<Model, Real>&, Results<Model>&, Neighbours<Model, Real>&, IntegratorSettings const&, Real* /*rates*/,
                                          Report& /*report*/) {
        return Faults<Real>::none();
    }

    /// Chooses how far to go.  @param remaining time until the lanes must land [s]  @return lanes that land
    SLIDEWAY_HD Mask<Real> choose(Step& step, Real remaining) {
        Real const h = step.adapts() ? step.pack.state.course.h : Real(step.settings.fixed_step);
        // A last step a hair short of the end would leave a crumb below the resolution of time.
        Mask<Real> const lands = remaining <= h * Real(hair);
        step.attempt.step = select(step.pack.busy, select(lands, remaining, h), Real(0.0));
        return lands;
    }

    /// The next step, if the one that was attempted is to grow by a factor.
    SLIDEWAY_HD Real next(Step const& step, Mask<Real> /*accepted*/, Real factor) const { return step.attempt.step * factor; }
    /// What that takes of time [s].
    SLIDEWAY_HD Real time_of(Step const&, Real next) const { return next; }

    /// Lets events of the contacts end what the error allows.  @return lanes that are to try again for that reason
    SLIDEWAY_HD Mask<Real> cut(Step&, Allowance<Real>& /*allowed*/) { return mask_of<Real>(false); }
    /// Lanes whose accepted step ends before where it was to land.
    SLIDEWAY_HD Mask<Real> ended_early() const { return mask_of<Real>(false); }
    /// Lanes that were not to land where they tried to.
    SLIDEWAY_HD Mask<Real> failed_landings(Step const&) const { return mask_of<Real>(false); }

    /// What an accepted step leaves of its contacts.  @param next step, which may become shorter
    SLIDEWAY_HD void advance(Step& step, Mask<Real> accepted, Real& /*next*/) { step.neighbours.advance(step.pack, accepted); }

    /// Stores the next step of lanes at work.  @param wish what error control and events allow  @param next what else there is left of that
    SLIDEWAY_HD void store_next(Step& step, Real /*wish*/, Real next) {
        auto& c = step.pack.state.course;
        c.h = select(step.pack.busy, next, c.h);
    }

protected:
    static constexpr double hair = 1.000001;  // how much longer than it may be a step gets to land

    /// Whether events of the contacts end steps that have been made.
    SLIDEWAY_HD static bool may_cut(Step const& step) { return step.pack.needs.cuts() && step.adapts(); }

    /// Lanes whose step is long enough to be cut.
    SLIDEWAY_HD static Mask<Real> are_long(Step const& step, Mask<Real> accepted) { return accepted & (step.attempt.step > step.least_cut()); }
    /// Fraction of the step at which the first of a member's events is; 1 where none must end it.  @param located depth of one that is found [m]
    SLIDEWAY_HD static Real first_event(Step const& step, Mask<Real> long_enough, Real located) {
        auto const& attempt = step.attempt;
        return step.pack.state.contacts.watch.earliest(long_enough, attempt.report.contact, attempt.step, located, step.pack.needs.watching);
    }

    /// Has lanes, of those that are accepted so far, try again with a fraction of their step.
    SLIDEWAY_HD static Mask<Real> try_again(Step& step, Mask<Real> cut, Real fraction, Allowance<Real>& allowed) {
        Real const whole = step.attempt.step;
        reject(step, cut, max(whole * fraction, step.resolution() * Real(32.0)), allowed);
        step.neighbours.go_on(step.pack, whole, cut, allowed);
        // An event a hair before the landing: the step would land again and be cut again, without end.
        auto const again = cut & step.lands & (whole <= allowed.next * Real(hair));
        allowed.next = select(again, whole * Real(1 - 2 * (hair - 1)), allowed.next);
        return cut;
    }
    SLIDEWAY_HD static void reject(Step& step, Mask<Real> cut, Real next, Allowance<Real>& allowed) {
        allowed.accepted = allowed.accepted & !cut;
        allowed.next = select(cut, next, allowed.next);
        // A step that an event cuts short says nothing of its error.
        Real& memory = step.pack.state.course.error_memory;
        memory = select(cut, step.former_memory, memory);
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
