#pragma once

#include "kernels/lanes/event_end.hpp"
#include "kernels/lanes/free_steps.hpp"
#include "kernels/lanes/impact_rows.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// How contacts limit steps where impacts have no duration: these end where a pair meets, parts, or changes between slipping and sticking, and there
/// `settle` says what follows.
template <class Stepper, class Model, class Real> class SettledSteps : public FreeSteps<Stepper, Model, Real> {
    using Base = FreeSteps<Stepper, Model, Real>;

public:
    using typename Base::Report, typename Base::Step;

    /// Impacts and lasting contacts are settled.
    SLIDEWAY_HD static Faults<Real> start(Pack<Model, Real>& pack, Results<Model>& results, Neighbours<Model, Real>& neighbours,
                                          IntegratorSettings const& settings, Real* rates, Report& report) {
        auto& c = pack.state.course;
        auto& [memory, watch] = pack.state.contacts;
        if (HasTimeStepping<Model> && settings.method == Method::moreau_jean) {
            memory.begun = select(pack.busy, Real(1.0), memory.begun);
            return Faults<Real>::none();
        }
        auto const& constants = pack.state.constants;
        auto const before = memory;
        Real start[Model::size];
        for (int i = 0, n = pack.states(); i < n; ++i) start[i] = c.y[i];
        auto const changed = pack.model.settle(pack.busy, c.t, constants.end, c.y, constants.parameters, memory, report.contact);
        ImpactRows<Model, Real>::take(pack, results, changed, start);
        if (any(changed)) neighbours.settle(pack, start, rates, report.contact, before, changed, true);
        auto const faults = pack.restart(pack.busy, rates, report);
        if (any(changed)) neighbours.depart(pack, changed);
        watch.keep(pack.busy, report.contact);
        return faults;
    }

    SLIDEWAY_HD Mask<Real> cut(Step& step, Allowance<Real>& allowed) {
        if (!Base::may_cut(step)) return mask_of<Real>(false);
        auto const& constants = step.pack.state.constants;
        Real const located = Model::located(constants.parameters, constants.end);
        Real fraction = Base::first_event(step, Base::are_long(step, allowed.accepted), located);
        auto cut = fraction < Real(1.0);
        if constexpr (Stepper::ends_early) {
            ended_early_ = cut & knows_inside(step, fraction) & (step.attempt.step * fraction > step.least_cut());
            if (any(ended_early_)) {
                ended_early_ = EventEnd<Stepper, Model, Real>(step.pack, step.stepper, step.attempt, located).run(ended_early_, fraction);
                cut = cut & !ended_early_;
            }
            // A shorter attempt knows its inside better, near its end above all.
            fraction = select(fraction < Real(0.6), Real(1.02) * fraction, fraction);
        }
        return Base::try_again(step, cut, fraction, allowed);
    }
    SLIDEWAY_HD Mask<Real> ended_early() const { return ended_early_; }

    /// Impacts at the end of an accepted step, and contacts that begin or end there.
    SLIDEWAY_HD void advance(Step& step, Mask<Real> accepted, Real& /*next*/) {
        auto& pack = step.pack;
        step.neighbours.advance(pack, accepted);
        auto& c = pack.state.course;
        auto& [memory, watch] = pack.state.contacts;
        auto const& constants = pack.state.constants;
        auto const before = memory;
        auto& attempt = step.attempt;
        auto const changed = pack.model.settle(accepted, c.t, constants.end, c.y, constants.parameters, memory, attempt.report.contact);
        if (any(changed)) {
            ImpactRows<Model, Real>::take(pack, step.results, changed, attempt.end);
            step.neighbours.settle(pack, attempt.end, attempt.end_rates, attempt.report.contact, before, changed, false);
            auto const faults = step.restart(changed);
            // No step leads out of where contacts have no forces.
            auto const jams = changed & faults.contact_domain & !is_finite(c.y, attempt.end_rates, pack.states());
            memory.jammed = select(jams, Real(1.0), memory.jammed);
            step.neighbours.depart(pack, changed);
        }
        watch.keep(accepted, attempt.report.contact);
    }

private:
    static constexpr double inside_within = 1e-3;  // of the tolerance

    /// Whether the attempt is as exact there as at its end.  The continuous extension errs as θ²(1 − θ)², by about the error of the step at most; a
    /// bounce that ends early feels it relative to its own time θ.
    SLIDEWAY_HD static Mask<Real> knows_inside(Step const& step, Real theta) {
        Real const rest = Real(1.0) - theta, part = Real(6.75) * theta * (rest * rest);
        return part * part * step.squared_norm <= Real(inside_within * inside_within);
    }

    Mask<Real> ended_early_ = mask_of<Real>(false);
};

}  // namespace slideway::inline SLIDEWAY_ISA
