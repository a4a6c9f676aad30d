#pragma once

#include "kernels/lanes/pack.hpp"
#include "kernels/lanes/step_integrals.hpp"
#include "kernels/lanes/stepped_numbers.hpp"
#include "kernels/lanes/stepper_traits.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Attempts steps of an explicit pair that may end early, at any place inside, by the pair's continuous extension: its stages are kept, those of
/// the integrals too.
template <class Pair, class Model, class Real> class EndingStep : public StepperTraits {
public:
    static constexpr bool ends_early = true;
    SLIDEWAY_HD static int order(Pack<Model, Real> const&) { return Pair::order; }
    SLIDEWAY_HD static int evaluations(Pack<Model, Real> const&) { return Pair::stages - 1; }  // per attempt

    /// Idle lanes step in place.
    SLIDEWAY_HD void attempt(Pack<Model, Real>& pack, StepStart<Model, Real> const& from, Attempt<Model, Real>& to) {
        whole_ = to.step;
        share_ = Real(1.0);
        states_ = pack.states();
        for (int i = 0; i < states_; ++i) {
            numbers_.start[i] = from.y[i];
            numbers_.k[0][i] = from.rates[i];
        }
        numbers_.forget_middle();
        to.faults = Faults<Real>::none();
        if (from.needs.stages) integrals_.begin(pack, Real(1.0));
        Pair::each_stage([&](auto s) { stage<s>(pack, from, to); });
        for (int i = 0; i < states_; ++i) {
            numbers_.end[i] = to.end[i];
            to.end_rates[i] = numbers_.k[Pair::stages - 1][i];
        }
        if (from.needs.stages) integrals_.finish(pack, whole_, whole_);
    }

    /// Ends steps early in the lanes of the mask, whose others stay as they are.  @param share of the whole step
    SLIDEWAY_NOINLINE void end_early(Pack<Model, Real>& pack, StepStart<Model, Real> const& from, Attempt<Model, Real>& to, Mask<Real> lanes,
                                     Real share) {
        share_ = select(lanes, share, share_);
        auto const early = share_ < Real(1.0);
        place(share_, to.end);
        to.step = whole_ * share_;
        auto const faults = pack.evaluate(from.t + to.step, to.end, from.memory, to.end_rates, true, to.report);
        to.faults = to.faults.or_else(faults.within(lanes));
        pack.count_evaluations(lanes, 1);
        if (from.needs.stages) integrals_.end_early(pack, early, to.step, whole_, share_);
    }

    /// The state at a share of the whole step.
    SLIDEWAY_FN void place(Real share, Real* state) const {
        auto const inside = share < Real(1.0);
        for (int i = 0; i < states_; ++i) state[i] = select(inside, numbers_.at(i, whole_, share), numbers_.end[i]);
    }

    /// Error estimates of the components over the whole step.
    SLIDEWAY_HD void errors(Attempt<Model, Real> const&, Real* of_state) const {
        for (int i = 0; i < states_; ++i) of_state[i] = whole_ * Pair::error_slope(numbers_.k, i);
    }

    /// The state inside the step, at fraction θ of what is left of it.
    SLIDEWAY_FN void dense(StepStart<Model, Real> const&, Attempt<Model, Real> const&, Real theta, Real* state) const {
        place(theta * share_, state);
    }

private:
    static constexpr int size = Model::size;

    template <int s>
    SLIDEWAY_HD void stage(Pack<Model, Real>& pack, StepStart<Model, Real> const& from, Attempt<Model, Real>& to) {
        constexpr typename Pair::Tableau w{};
        constexpr bool last = s + 1 == Pair::stages;
        Real* const at = last ? to.end : at_;
        Pair::template stage_state<s>(from.y, numbers_.k, to.step, at, states_);
        Real const t = fma(to.step, Real(w.c[s]), from.t);
        pack.tell_stages(!last);
        // A fault of one stage is NaN in those after it, whose own faults say nothing.
        to.faults = to.faults.or_else(pack.evaluate(t, at, from.memory, numbers_.k[s], last ? from.needs.ends : from.needs.stages, to.report));
        if (from.needs.stages) integrals_.template stage<s>(pack, to.report, Real(1.0));
    }

    SteppedNumbers<Pair, size, Real> numbers_;
    StepIntegrals<Pair, Model, Real> integrals_;  // if needs.stages
    Real whole_, share_;                          // the step as it was tried [s], and what is left of it
    Real at_[size];                               // where a stage evaluates the derivative
    StateCount<Model> states_;
};

}  // namespace slideway::inline SLIDEWAY_ISA
