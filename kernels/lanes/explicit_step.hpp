#pragma once

#include "kernels/lanes/pack.hpp"
#include "kernels/lanes/pair_stages.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Attempts steps of an explicit pair in the lanes of a pack; what it knows of the last one serves its error and dense output.
template <class Pair, class Model, class Real> class ExplicitStep {
public:
    static constexpr int order = Pair::order;
    static constexpr bool adaptive = Pair::adaptive;
    static constexpr bool stiff = false;
    static constexpr bool by_clock = false;
    static constexpr bool ends_early = false;
    static constexpr int evaluations = Pair::stages - 1;  // per attempt
    static constexpr bool has_two_estimates = Pair::has_two_estimates;
    static constexpr int jacobians = 0;

    /// Idle lanes step in place.
    SLIDEWAY_HD void attempt(Pack<Model, Real>& pack, StepStart<Model, Real> const& from, Attempt<Model, Real>& to) {
        for (int i = 0; i < size; ++i) k_[0][i] = from.rates[i];
        to.faults = Faults<Real>::none();
        if (from.needs.stages) pack.begin_integrals(Stages::template weights<0>());
        prepared_ = mask_of<Real>(false);
        Stages::run([&](auto s) { stage<s>(pack, from, to); });
        for (int i = 0; i < size; ++i) to.end_rates[i] = k_[Pair::stages - 1][i];
    }

    /// Error estimate of one component.
    SLIDEWAY_HD Real error(Attempt<Model, Real> const& to, int i) const { return to.step * Pair::error_slope(k_, i); }

    /// The second estimate, of a pair that has two.
    SLIDEWAY_HD Real coarse_error(Attempt<Model, Real> const& to, int i) const {
        return to.step * Pair::coarse_error_slope(k_, i);
    }

    /// Evaluates what the continuous extension needs beyond the step; to be called before `dense` with the lanes that ask for it.
    SLIDEWAY_HD void prepare_dense(Pack<Model, Real>& pack, Attempt<Model, Real> const& to, Mask<Real> wanted) {
        if constexpr (Pair::dense_stages > 0) {
            Mask<Real> const missing = wanted & !prepared_;
            if (none(missing)) return;
            extension(pack, to);
            pack.count_evaluations(missing, Pair::dense_stages);
            prepared_ = prepared_ | missing;
        }
    }

    /// The state inside the step, at fraction θ of it.
    SLIDEWAY_FN void dense(StepStart<Model, Real> const& from, Attempt<Model, Real> const& to, Real theta, Real* state) const {
        for (int i = 0; i < size; ++i) state[i] = Pair::dense(k_, i, from.y[i], to.end[i], to.step, theta);
    }

private:
    static constexpr int size = Model::size;
    using Stages = PairStages<Pair>;

    template <int s>
    SLIDEWAY_HD void stage(Pack<Model, Real>& pack, StepStart<Model, Real> const& from, Attempt<Model, Real>& to) {
        Stages::template evaluate<s>(pack, from, to, k_, at_);
        if (from.needs.stages) pack.add_integrands(Stages::template weights<s>(), to.report);
    }

    SLIDEWAY_NOINLINE void extension(Pack<Model, Real> const& pack, Attempt<Model, Real> const& to) {
        auto const from = pack.start();
        typename Model::template Report<Real> report;
        Stages::extend([&](auto s) {
            constexpr typename Pair::Tableau w{};
            Pair::template stage_state<s>(from.y, k_, to.step, at_);
            pack.evaluate(fma(to.step, Real(w.c[s]), from.t), at_, from.memory, k_[s], false, report);
        });
    }

    Real k_[Pair::stages + Pair::dense_stages][size];
    Real at_[size];        // where a stage evaluates the derivative
    Mask<Real> prepared_;  // lanes whose continuous extension is complete
};

}  // namespace slideway::inline SLIDEWAY_ISA
