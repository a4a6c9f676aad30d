#pragma once

#include "kernels/block.hpp"
#include "kernels/lanes/member_state.hpp"
#include "kernels/mechanisms/faults.hpp"
#include "kernels/real.hpp"
#include "kernels/steppers/contact_watch.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Which of a model's reports a block needs.
struct ReportNeeds {
    bool quantities = false;     // the observer is at work
    bool stages = false;         // at every stage, for integrals
    bool accelerations = false;  // their record is at work
    bool audit = false;          // the audit's integrals meet the tolerance too
    bool switches = false;       // the law does: the audit keeps books of it
    Watching watching = Watching::nothing;
    bool ends = false;  // at the accepted steps

    SLIDEWAY_HD bool watch() const { return watching != Watching::nothing; }

    template <class Model, class Real>
    SLIDEWAY_HD static ReportNeeds of(Model const& model, Selection quantities, bool locate_modes) {
        using Observer = typename Model::template Observer<Real>;
        ReportNeeds needs;
        needs.quantities = quantities != 0;
        needs.stages = Observer::needs_stages(quantities);
        if constexpr (has_accelerations<Model>) {
            using Accelerations = typename Model::template Accelerations<Real>;
            needs.accelerations = (quantities & Accelerations::quantities) != 0;
            needs.stages = needs.stages || Accelerations::needs_stages(quantities);
        }
        needs.audit = Observer::audits(quantities);
        if constexpr (Model::has_contacts) {
            needs.watching = model.watching(locate_modes, Model::has_shadows);
            needs.switches = model.switches();
        }
        needs.ends = needs.stages || Observer::needs_reports(quantities) || needs.watch();
        return needs;
    }

    /// Nobody observes a shadow.
    SLIDEWAY_HD ReportNeeds of_shadows() const {
        ReportNeeds needs;
        needs.watching = watching;
        needs.ends = watch();
        return needs;
    }
};

/// Lanes whose numbers are all finite.
template <int size, class Real> SLIDEWAY_HD Mask<Real> is_finite(Real const (&a)[size], Real const (&b)[size]) {
    Real sum(0.0);
    for (int i = 0; i < size; ++i) sum = fma(a[i], Real(0.0), fma(b[i], Real(0.0), sum));
    return sum == Real(0.0);
}

/// The lanes at work: their members' states, and the step that they attempt.
template <class Model, class Real> struct Pack {
    static constexpr int size = Model::size;
    static constexpr int width = lanes<Real>;
    using Parameters = typename Model::template Parameters<Real>;
    using Report = typename Model::template Report<Real>;
    using Observer = typename Model::template Observer<Real>;

    [[no_unique_address]] Model model;
    ReportNeeds needs;
    MemberState<Model, Real> state;
    Mask<Real> busy;  // lanes with a member at work

    // The attempt, from (t, y) to (t + step, end).
    Real step;
    Real end[size], end_rates[size];
    Report end_report;  // if needs.ends
    Faults<Real> faults;
    Real integral[room(Observer::integrals)];           // Σ b_s · integrand of the stages, if needs.stages
    Real audit_error[room(Observer::audit_integrals)];  // Σ e_s · integrand
    Real scratch[size];

    SLIDEWAY_FN Faults<Real> evaluate(Real t, Real const* at, Real* rates, bool report_wanted, Report& report) const {
        return evaluate(t, at, state.contacts.memory, rates, report_wanted, report);
    }

    SLIDEWAY_FN Faults<Real> evaluate(Real t, Real const* at, typename Model::template Memory<Real> const& memory,
                                      Real* rates, bool report_wanted, Report& report) const {
        auto const& p = state.constants.parameters;
        return report_wanted ? model.template derivative<true>(t, at, p, memory, rates, &report)
                             : model.template derivative<false>(t, at, p, memory, rates, &report);
    }

    /// Has the function see the accelerations' record, where it is at work.
    template <class Function> SLIDEWAY_HD void with_accelerations(Function const& function) {
        if constexpr (has_accelerations<Model>) {
            if (needs.accelerations) function(state.accelerations);
        }
    }
    template <class Function> SLIDEWAY_HD void with_accelerations(Function const& function) const {
        if constexpr (has_accelerations<Model>) {
            if (needs.accelerations) function(state.accelerations);
        }
    }

    /// Begins the integrals over the step with the stage at its start.
    SLIDEWAY_HD void begin_integrals(double b, double e) {
        if (!needs.stages) return;
        for (int i = 0; i < Observer::integrals; ++i) integral[i] = Real(b) * state.observation.integrand[i];
        with_accelerations([&](auto& record) { record.begin_step(b); });
        for (int i = 0; i < Observer::audit_integrals; ++i) audit_error[i] = Real(e) * state.observation.integrand[i];
    }

    /// Adds the stage whose report is at hand.
    SLIDEWAY_HD void add_integrands(double b, double e) {
        if (!needs.stages || (b == 0 && e == 0)) return;
        Real values[room(Observer::integrals)];
        Observer::integrands(end_report, values);
        for (int i = 0; i < Observer::integrals; ++i) integral[i] = fma(Real(b), values[i], integral[i]);
        with_accelerations([&](auto& record) { record.add_stage(b, end_report); });
        for (int i = 0; i < Observer::audit_integrals; ++i) audit_error[i] = fma(Real(e), values[i], audit_error[i]);
    }

    /// What the next step starts from, in the lanes of the mask.
    SLIDEWAY_HD void begin_next(Mask<Real> in, Real const* rates) {
        auto& c = state.course;
        for (int i = 0; i < size; ++i) c.rates[i] = select(in, rates[i], c.rates[i]);
        if (!needs.stages) return;
        Real values[room(Observer::integrals)];
        Observer::integrands(end_report, values);
        for (int i = 0; i < Observer::integrals; ++i) {
            state.observation.integrand[i] = select(in, values[i], state.observation.integrand[i]);
        }
        with_accelerations([&](auto& record) { record.begin_next(in, end_report); });
    }

    /// Counts evaluations of the right-hand side in the lanes of the mask.
    SLIDEWAY_HD void count_evaluations(Mask<Real> in, double evaluations) {
        auto& c = state.course;
        c.evaluations = c.evaluations + select(in, Real(evaluations), Real(0.0));
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
