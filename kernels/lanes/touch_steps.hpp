#pragma once

#include "kernels/lanes/free_steps.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// How contacts with forces limit steps that go by time.  A touch, or a change of mode, must end its step where it sets the impact speed of what
/// follows, or the law that holds (Watching).
template <class Stepper, class Model, class Real> class TouchSteps : public FreeSteps<Stepper, Model, Real> {
    using Base = FreeSteps<Stepper, Model, Real>;

public:
    using typename Base::Report, typename Base::Step;

    /// Starts the watch; where steps hold contacts, evaluates again with those held.
    SLIDEWAY_HD static Faults<Real> start(Pack<Model, Real>& pack, Results<Model>&, Neighbours<Model, Real>&, IntegratorSettings const&, Real* rates,
                                          Report& report) {
        auto const& c = pack.state.course;
        auto& [memory, watch] = pack.state.contacts;
        if (pack.needs.cuts()) watch.begin(pack.busy, report.contact, memory, pack.needs.watching);
        if (holds_contacts(pack.needs.watching)) {
            // Rates are reported only once contacts are held, and the first step is searched too.
            pack.evaluate(c.t, c.y, memory, rates, true, report);
            pack.count_evaluations(pack.busy, 1);
            watch.begin(pack.busy, report.contact, memory, pack.needs.watching);
        }
        auto faults = Faults<Real>::none();
        if constexpr (requires { pack.model.remembers(); }) {
            if (!pack.needs.cuts() || !pack.model.remembers()) return faults;
            auto const touching = watch.take_start(pack.busy, report.contact, memory);
            if (none(touching)) return faults;
            faults = pack.restart(touching, rates, report).within(touching);
            pack.start_observing(touching, report);
        }
        return faults;
    }

    SLIDEWAY_HD Mask<Real> cut(Step& step, Allowance<Real>& allowed) {
        if (!Base::may_cut(step)) return mask_of<Real>(false);
        double const tolerance = step.neighbours.located(Model::template Watch<Real>::tolerance(step.pack.needs.watching));
        auto const& p = step.pack.state.constants.parameters;
        Real const located = max(Real(tolerance) * Model::touch_scale(p), Model::touch_rounding(p));
        auto const candidates = Base::are_long(step, allowed.accepted);
        Real const fraction = step.neighbours.first_event(step.pack, candidates, located, Base::first_event(step, candidates, located));
        return Base::try_again(step, fraction < Real(1.0), fraction, allowed);
    }

    SLIDEWAY_HD void advance(Step& step, Mask<Real> accepted, Real& next) {
        if (step.pack.needs.watch()) {
            auto& [memory, watch] = step.pack.state.contacts;
            bool const may_shorten = !Stepper::stiff && step.adapts();
            // Where steps end at events a watch moves with its member, and knows where each has begun.
            Real const known_step = step.pack.needs.cuts() ? step.attempt.step : select(known_, step.attempt.step, Real(0.0));
            auto const touched = watch.update(accepted, step.attempt.report.contact, memory, step.pack.state.course.y, step.pack.needs.watching,
                                              known_step, may_shorten ? &next : nullptr);
            known_ = known_ | accepted;
            if (any(touched)) step.restart(touched);
        }
        step.neighbours.advance(step.pack, accepted);
    }

private:
    Mask<Real> known_ = mask_of<Real>(false);  // lanes whose watch knows their last step
};

}  // namespace slideway::inline SLIDEWAY_ISA
