#pragma once

#include "kernels/block.hpp"
#include "kernels/lanes/attempt.hpp"
#include "kernels/lanes/member_state.hpp"
#include "kernels/lanes/report_needs.hpp"
#include "kernels/mechanisms/faults.hpp"
#include "kernels/real.hpp"
#include "kernels/steppers/pair_numbers.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Of a stage in an integral over a step, and in the estimates of its error.
struct StageWeights { double value, error, coarse_error = 0; };

/// The lanes at work: their members' states, and the integrals of the step that they attempt (which itself is PackStep).
template <class Model, class Real> struct Pack {
    static constexpr int size = Model::size;
    using Report = typename Model::template Report<Real>;
    using Observer = typename Model::template Observer<Real>;
    using Accelerations = typename AccelerationsOf<Model, Real>::Type;
    using Forces = typename ForcesOf<Model, Real>::Type;

    explicit SLIDEWAY_HD Pack(Model const& of_block) : model(of_block) {
        for (auto& mean : integral) mean = Real(0.0);
    }

    [[no_unique_address]] Model model;
    PairNumbers const* pair = nullptr;  // of the block's explicit method (ExplicitStep)
    ReportNeeds needs;
    MemberState<Model, Real> state;
    Mask<Real> busy;  // lanes with a member at work

    // Of the members' own attempt, if needs.stages.
    Real integral[room(Observer::integrals)];           // Σ b_s · integrand of the stages
    Real audit_error[room(Observer::audit_integrals)];  // Σ e_s · integrand
    Real coarse_audit_error[room(Observer::audit_integrals)];  // of the second estimate, of a method that has two

    /// How many components the state has, of room for `size`.
    SLIDEWAY_FN StateCount<Model> states() const { return StateCount<Model>(model); }

    /// Where the members' next step starts.
    SLIDEWAY_FN StepStart<Model, Real> start() const {
        return {state.course.t, state.course.y, state.course.rates, state.contacts.memory, needs};
    }

    SLIDEWAY_FN Faults<Real> evaluate(Real t, Real const* at, typename Model::template Memory<Real> const& memory,
                                      Real* rates, bool report_wanted, Report& report) const {
        auto const& p = state.constants.parameters;
        return report_wanted ? model.template derivative<true>(t, at, p, memory, rates, &report)
                             : model.template derivative<false>(t, at, p, memory, rates, &report);
    }

    /// Has the function see a record that a model may lack, where it is at work.
    template <class Record, class Function> SLIDEWAY_HD static void with_record(Record& record, bool at_work, Function const& function) {
        if (at_work) function(record);
    }
    template <Keeper keeper, class Function> SLIDEWAY_HD static void with_record(NoRecord<keeper> const&, bool, Function const&) {}
    template <Keeper keeper, class Function> SLIDEWAY_HD static void with_record(NoRecord<keeper>&, bool, Function const&) {}
    /// Has it see those that are at work, and where their integrals and peaks begin.
    template <class Function> SLIDEWAY_HD void with_records(Function const& function) { with_records_of(*this, function); }
    template <class Function> SLIDEWAY_HD void with_records(Function const& function) const { with_records_of(*this, function); }

    /// Says whether reports, from here on, are of stages inside a step: they tell of a state what is integrated and nothing else, which may be what
    /// the energy audit integrates.
    SLIDEWAY_HD void tell_stages(bool inside) {
        model.tell_stages(inside, inside && needs.powers_alone);
    }

    /// How many integrals a step may have: the observer's, then those of the records.
    static constexpr int integrals = Observer::integrals + Accelerations::integrals + Forces::integrals;

    /// Those of them that the block asks for: the first ones.
    SLIDEWAY_HD int integrals_in_use() const {
        return observed() + (needs.accelerations ? Accelerations::integrals : 0) + (needs.forces ? Forces::integrals : 0);
    }

    /// The integrands where a step starts, and at a report.
    SLIDEWAY_HD void integrands_at_start(Real* values) const {
        each_observed([&](int i) { values[i] = state.observation.integrand[i]; });
        with_records([&](auto const& record, int place, auto...) { record.integrands_at_start(values + place); });
    }
    SLIDEWAY_HD void integrands(Report const& report, Real* values) const {
        observe(report, values);
        with_records([&](auto const& record, int place, auto...) { record.integrands(report, values + place); });
    }
    /// Sets the means of the integrands over a step, in the lanes of the mask.
    SLIDEWAY_HD void set_means(Mask<Real> in, Real const* means) {
        each_observed([&](int i) { integral[i] = select(in, means[i], integral[i]); });
        with_records([&](auto& record, int place, auto...) { record.set_means(in, means + place); });
    }

    /// Begins the integrals over a step with the stage at its start.
    SLIDEWAY_HD void begin_integrals(StageWeights const& w) {
        each_observed([&](int i) { integral[i] = Real(w.value) * state.observation.integrand[i]; });
        with_records([&](auto& record, auto...) { record.begin_step(w.value); });
        each_audited([&](int i, int place) {
            Real const value = state.observation.integrand[place];
            audit_error[i] = Real(w.error) * value;
            if (w.coarse_error != 0) coarse_audit_error[i] = Real(w.coarse_error) * value;
        });
    }

    /// Adds a stage.
    SLIDEWAY_HD void add_integrands(StageWeights const& w, Report const& report) {
        if (w.value == 0 && w.error == 0) return;
        Real values[room(Observer::integrals)];
        observe(report, values);
        each_observed([&](int i) { integral[i] = fma(Real(w.value), values[i], integral[i]); });
        with_records([&](auto& record, auto...) { record.add_stage(w.value, report); });
        each_audited([&](int i, int place) {
            audit_error[i] = fma(Real(w.error), values[place], audit_error[i]);
            if (w.coarse_error != 0) coarse_audit_error[i] = fma(Real(w.coarse_error), values[place], coarse_audit_error[i]);
        });
    }

    /// Has a function see the number of each integral of the energy audit, and its place among all.
    template <class Function> SLIDEWAY_FN void each_audited(Function const& see) const {
        for (int i = 0; i < audited_without_loads; ++i) see(i, Observer::first_audited + i);
        if (!needs.loads) return;
        for (int i = audited_without_loads; i < Observer::audit_integrals; ++i) see(i, Observer::first_audited + i);
    }

    /// What the next step starts from, in the lanes of the mask.
    SLIDEWAY_HD void begin_next(Mask<Real> in, Real const* rates, Report const& report) {
        auto& c = state.course;
        for (int i = 0, n = states(); i < n; ++i) c.rates[i] = select(in, rates[i], c.rates[i]);
        if (!needs.stages) return;
        Real values[room(Observer::integrals)];
        observe(report, values);
        each_observed([&](int i) {
            state.observation.integrand[i] = select(in, values[i], state.observation.integrand[i]);
        });
        with_records([&](auto& record, auto...) { record.begin_next(in, report); });
    }

    /// Begins what is observed of members, in the lanes of the mask.
    SLIDEWAY_HD void start_observing(Mask<Real> in, Report const& report) {
        if (needs.quantities) state.observation.observer.start(in, report, state.course.y, needs.switches);
        with_records([&](auto& record, auto...) { record.start(in, report); });
    }

    /// Evaluates derivative and report again where members are, in lanes whose impact speeds or contacts have changed.
    SLIDEWAY_HD Faults<Real> restart(Mask<Real> in, Real* rates, Report& report) {
        auto const faults = evaluate(state.course.t, state.course.y, state.contacts.memory, rates, true, report);
        count_evaluations(in, 1);
        if (needs.quantities) state.observation.observer.switch_over(in, report, needs.switches);
        begin_next(in, rates, report);
        return faults;
    }

    /// Values of which the largest is kept: the observer's, then those of the records.
    struct Peaks { Real of[Observer::peaks + Accelerations::peaks + Forces::peaks]; };
    SLIDEWAY_HD int peaks_in_use() const {
        return Observer::peaks + (needs.accelerations ? Accelerations::peaks : 0) + (needs.forces ? Forces::peaks : 0);
    }
    SLIDEWAY_HD void tell_peaks(Report const& report, Real const* at, Peaks& values) const {
        Observer::tell_peaks(report, at, values.of);
        with_records([&](auto const& record, int, int place) { record.tell_peaks(report, values.of + place); });
    }
    SLIDEWAY_HD void raise_peaks(Mask<Real> in, Peaks const& values) {
        state.observation.observer.raise_peaks(in, values.of);
        with_records([&](auto& record, int, int place) { record.raise_peaks(in, values.of + place); });
    }

    /// Counts what an attempt costs in the lanes of the mask.
    template <class Stepper> SLIDEWAY_HD void count_attempt(Mask<Real> in) {
        count_evaluations(in, Stepper::evaluations(*this));
        if (Stepper::jacobians > 0) state.course.jacobians = state.course.jacobians + count<Real>(in);
    }

    /// Counts evaluations of the right-hand side in the lanes of the mask.
    SLIDEWAY_HD void count_evaluations(Mask<Real> in, double evaluations) {
        auto& c = state.course;
        c.evaluations = c.evaluations + select(in, Real(evaluations), Real(0.0));
    }

private:
    template <class Self, class Function> SLIDEWAY_HD static void with_records_of(Self& self, Function const& function) {
        auto const& needs = self.needs;
        with_record(self.state.accelerations, needs.accelerations, [&](auto& record) { function(record, Observer::integrals, Observer::peaks); });
        with_record(self.state.forces, needs.forces, [&](auto& record) {
            function(record, Observer::integrals + (needs.accelerations ? Accelerations::integrals : 0),
                     Observer::peaks + (needs.accelerations ? Accelerations::peaks : 0));
        });
    }
    /// How many of the observer's integrals are asked for, and their integrands at a report.
    SLIDEWAY_HD int observed() const {
        return !needs.powers_alone ? Observer::integrals : needs.loads ? Observer::powers : powers_without_loads;
    }
    /// Has a function see the number of each, in loops of constant length.
    template <class Function> SLIDEWAY_FN void each_observed(Function const& see) const {
        for (int i = 0; i < powers_without_loads; ++i) see(i);
        if (needs.loads) {
            for (int i = powers_without_loads; i < Observer::powers; ++i) see(i);
        }
        if (needs.powers_alone) return;
        for (int i = Observer::powers; i < Observer::integrals; ++i) see(i);
    }
    // Of all powers those of loads are the last.
    static constexpr int audited_without_loads = Observer::audit_integrals > 0 ? Observer::audit_integrals - Observer::of_loads : 0;
    static constexpr int powers_without_loads = Observer::powers > 0 ? Observer::powers - Observer::of_loads : 0;
    SLIDEWAY_HD void observe(Report const& report, Real* values) const {
        needs.powers_alone ? Observer::powers_of(report, values) : Observer::integrands(report, values);
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
