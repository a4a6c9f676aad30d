#pragma once

#include "kernels/lanes/pack.hpp"
#include "kernels/lanes/stepper_traits.hpp"
#include "kernels/real.hpp"
#include "kernels/simd/expect.hpp"
#include "kernels/steppers/pair_numbers.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Attempts steps of the pack's explicit method in its lanes; what it knows of the last one serves its error and dense output.
template <class Model, class Real> class ExplicitStep : public StepperTraits {
public:
    /// Whether by error control, order, and evaluations of an attempt.
    SLIDEWAY_HD static bool adapts(Pack<Model, Real> const& pack) { return pack.pair->adaptive; }
    SLIDEWAY_HD static int order(Pack<Model, Real> const& pack) { return pack.pair->order; }
    SLIDEWAY_HD static int evaluations(Pack<Model, Real> const& pack) { return pack.pair->stages - 1; }

    /// Idle lanes step in place.
    SLIDEWAY_HD void attempt(Pack<Model, Real>& pack, StepStart<Model, Real> const& from, Attempt<Model, Real>& to) {
        SLIDEWAY_EXPECT(pack.pair != nullptr && pack.pair->stages > 1 && pack.pair->stages + pack.pair->dense_stages <= PairNumbers::most_stages);
        pair_ = pack.pair;
        states_ = pack.states();
        to.faults = Faults<Real>::none();
        if (from.needs.stages) pack.begin_integrals(weights(0));
        prepared_ = mask_of<Real>(false);
        states_.visit([&](auto n) { take_stages(n, pack, from, to); });
    }

    /// Error estimates of the components.
    SLIDEWAY_HD void errors(Attempt<Model, Real> const& to, Real* of_state) const { estimate(pair_->e, to, of_state); }

    /// The second ones, of a pair that has two.
    SLIDEWAY_HD bool has_two_estimates() const { return pair_->has_two_estimates; }
    SLIDEWAY_HD void coarse_errors(Attempt<Model, Real> const& to, Real* of_state) const { estimate(pair_->coarse, to, of_state); }

    /// Evaluates what the continuous extension needs beyond the step; to be called before `dense` with the lanes that ask for it.
    SLIDEWAY_HD void prepare_dense(Pack<Model, Real>& pack, Attempt<Model, Real> const& to, Mask<Real> wanted) {
        if (pair_->dense_stages == 0) return;
        Mask<Real> const missing = wanted & !prepared_;
        if (none(missing)) return;
        extend(pack, to);
        pack.count_evaluations(missing, pair_->dense_stages);
        prepared_ = prepared_ | missing;
    }

    /// The state inside the step, at fraction θ of it.
    SLIDEWAY_HD void dense(StepStart<Model, Real> const& from, Attempt<Model, Real> const& to, Real theta, Real* state) const {
        pair_->dense(k_, from.y, to.end, to.step, theta, state, states_);
    }

private:
    static constexpr int size = Model::size;

    /// @param n components of the state
    template <class Count> SLIDEWAY_FN void take_stages(Count n, Pack<Model, Real>& pack, StepStart<Model, Real> const& from, Attempt<Model, Real>& to) {
        for (int i = 0; i < n; ++i) k_[0][i] = from.rates[i];
        int const last = pair_->stages - 1;
        for (int s = 1; s < last; ++s) stage(n, pack, from, to, s, at_, from.needs.stages);
        stage(n, pack, from, to, last, to.end, from.needs.ends);
        for (int i = 0; i < n; ++i) to.end_rates[i] = k_[last][i];
    }

    template <class Count>
    SLIDEWAY_FN void stage(Count n, Pack<Model, Real>& pack, StepStart<Model, Real> const& from, Attempt<Model, Real>& to, int s, Real* at,
                           bool report_wanted) {
        pair_->stage_state(s, from.y, k_, to.step, at, n);
        pack.tell_stages(s + 1 < pair_->stages);
        Real const t = fma(to.step, Real(pair_->c[s]), from.t);
        // A fault of one stage is NaN in those after it, whose own faults say nothing.
        to.faults = to.faults.or_else(pack.evaluate(t, at, from.memory, k_[s], report_wanted, to.report));
        if (from.needs.stages) pack.add_integrands(weights(s), to.report);
    }

    SLIDEWAY_HD void estimate(double const* weights, Attempt<Model, Real> const& to, Real* of_state) const {
        states_.visit([&](auto n) {
            PairNumbers::combine(weights, pair_->stages, k_, of_state, n);
            for (int i = 0; i < n; ++i) of_state[i] = to.step * of_state[i];
        });
    }

    /// Of a stage in the integrals over the step.
    SLIDEWAY_HD StageWeights weights(int s) const { return {pair_->b[s], pair_->e[s], pair_->coarse[s]}; }

    SLIDEWAY_NOINLINE void extend(Pack<Model, Real> const& pack, Attempt<Model, Real> const& to) {
        auto const from = pack.start();
        typename Model::template Report<Real> report;
        for (int s = pair_->stages; s < pair_->stages + pair_->dense_stages; ++s) {
            pair_->stage_state(s, from.y, k_, to.step, at_, states_);
            pack.evaluate(fma(to.step, Real(pair_->c[s]), from.t), at_, from.memory, k_[s], false, report);
        }
    }

    PairNumbers const* pair_ = nullptr;
    StateCount<Model> states_;
    Real k_[PairNumbers::most_stages][size];
    Real at_[size];        // where a stage evaluates the derivative
    Mask<Real> prepared_;  // lanes whose continuous extension is complete
};

}  // namespace slideway::inline SLIDEWAY_ISA
