#pragma once

#include "kernels/lanes/pack_step.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Steps that no contact ends: of a model without contacts, and of time stepping, which looks for them in each step anew.  What derives from it hides
/// what it does differently: how long steps are, where contacts end them, and what an accepted one leaves of these.
template <class Stepper, class Model, class Real> class FreeSteps {
public:
    using Step = PackStep<Stepper, Model, Real>;
    using Report = typename Model::template Report<Real>;
    static constexpr int control_percent = 20;  // of the exponent of step control that the former error has

    /// What the first evaluation of new members leaves of their contacts.
    /// @param rates of that evaluation, changed where contacts change them; so is its report  @param faults so far  @return faults then
    template <class Neighbours>
    SLIDEWAY_HD static Faults<Real> start(Pack<Model, Real>&, Results<Model>&, Neighbours&, IntegratorSettings const&, Real* /*rates*/, Report& /*report*/,
                                          Faults<Real> const& faults) {
        return faults;
    }

    /// Chooses how far to go.  @param remaining time until the lanes must land [s]  @return lanes that land
    SLIDEWAY_HD Mask<Real> choose(Step& step, Real remaining) {
        Real const h = step.adapts() ? step.pack.state.course.h : Real(step.settings.fixed_step);
        // A last step a hair short of the end would leave a crumb below the resolution of time.
        Mask<Real> const lands = remaining <= h * Real(hair);
        step.attempt.step = select(step.pack.busy, select(lands, remaining, h), Real(0.0));
        return lands;
    }

    /// The step that is to follow if that which was tried is to grow by a factor.
    SLIDEWAY_HD Real next(Step const& step, Mask<Real> /*accepted*/, Real factor) const { return step.attempt.step * factor; }
    /// What that takes of time [s].
    SLIDEWAY_HD Real time_of(Step const&, Real next) const { return next; }

    /// Lets events of the contacts end what the error allows.  @param former_memory of step control, before the attempt
    /// @return lanes that are to try again for that reason
    template <class Neighbours> SLIDEWAY_HD Mask<Real> cut(Step&, Neighbours&, Allowance<Real>& /*allowed*/, Real /*former_memory*/) {
        return mask_of<Real>(false);
    }
    /// Lanes whose accepted step ends before where it was to land.
    SLIDEWAY_HD Mask<Real> ended_early() const { return mask_of<Real>(false); }
    /// Lanes that were not to land where they tried to.
    SLIDEWAY_HD Mask<Real> failed_landings(Step const&) const { return mask_of<Real>(false); }

    /// What an accepted step leaves of its contacts.  @param next step, which may become shorter
    template <class Neighbours> SLIDEWAY_HD void advance(Step& step, Neighbours& neighbours, Mask<Real> accepted, Real& /*next*/) {
        neighbours.advance(step.pack, accepted);
    }

    /// Keeps the step that is to follow.  @param wish what the verdict on the last one had  @param next what is left of that
    SLIDEWAY_HD void keep(Step& step, Mask<Real> busy, Real /*wish*/, Real next, Real /*longest*/) {
        auto& c = step.pack.state.course;
        c.h = select(busy, next, c.h);
    }

protected:
    static constexpr double hair = 1.000001;  // how much longer than it may be a step gets to land

    /// Has lanes try again with a fraction of their step.
    template <class Neighbours>
    SLIDEWAY_HD static Mask<Real> try_again(Step& step, Neighbours& neighbours, Mask<Real> cut, Real fraction, Allowance<Real>& allowed,
                                            Real former_memory) {
        Real const whole = step.attempt.step;
        Allowance<Real> shorter{Mask<Real>(allowed.accepted & !cut), select(cut, max(whole * fraction, step.resolution() * Real(32.0)), allowed.next)};
        neighbours.go_on(step.pack, whole, cut, shorter);
        // An event a hair before the landing: the step would land again and be cut again, without end.
        auto const again = cut & step.lands & (whole <= shorter.next * Real(hair));
        shorter.next = select(again, whole * Real(1 - 2 * (hair - 1)), shorter.next);
        return take(step, shorter, allowed, former_memory);
    }

    /// @return lanes that an event has cut
    SLIDEWAY_HD static Mask<Real> take(Step& step, Allowance<Real> const& by_events, Allowance<Real>& allowed, Real former_memory) {
        Mask<Real> const cut = allowed.accepted & !by_events.accepted;
        // A step that an event cuts short says nothing of its error.
        Real& memory = step.pack.state.course.error_memory;
        memory = select(cut, former_memory, memory);
        allowed = by_events;
        return cut;
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
