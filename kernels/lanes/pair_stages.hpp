#pragma once

#include <type_traits>
#include <utility>

#include "kernels/lanes/pack.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// What attempts of an explicit method share, whatever clock they go by: its stages in turn, and how they count.
template <class Pair> struct PairStages {
    /// Calls a function with the number of each stage but the first, which the last step has left; a constant, for the tableau.
    template <class Stage> SLIDEWAY_FN static void run(Stage const& stage) {
        in_turn<1>(stage, std::make_integer_sequence<int, Pair::stages - 1>{});
    }

    /// Likewise with those that the continuous extension needs beyond the step.
    template <class Stage> SLIDEWAY_FN static void extend(Stage const& stage) {
        in_turn<Pair::stages>(stage, std::make_integer_sequence<int, Pair::dense_stages>{});
    }

    /// Evaluates the derivative of a stage of a step by time, the last one at its end.
    /// @param k slopes of all stages  @param inside room for the state of the others
    template <int s, class Model, class Real>
    SLIDEWAY_FN static void evaluate(Pack<Model, Real>& pack, StepStart<Model, Real> const& from, Attempt<Model, Real>& to,
                                     Real (*k)[Model::size], Real* inside) {
        constexpr typename Pair::Tableau w{};
        constexpr bool last = s + 1 == Pair::stages;
        Real* const at = last ? to.end : inside;
        Pair::template stage_state<s>(from.y, k, to.step, at);
        Real const t = fma(to.step, Real(w.c[s]), from.t);
        pack.tell_stages(!last);
        // A fault of one stage is NaN in those after it, whose own faults say nothing.
        to.faults = to.faults.or_else(pack.evaluate(t, at, from.memory, k[s], last ? from.needs.ends : from.needs.stages, to.report));
    }

    /// Of a stage in the integrals over the step.
    template <int s> SLIDEWAY_FN static constexpr StageWeights weights() {
        constexpr typename Pair::Tableau w{};  // not Pair's own: device code has no constants of the host
        if constexpr (Pair::has_two_estimates) return {w.b[s], w.e[s], w.coarse[s]};
        else return {w.b[s], w.e[s]};
    }

private:
    template <int first, class Stage, int... i>
    SLIDEWAY_FN static void in_turn(Stage const& stage, std::integer_sequence<int, i...>) {
        (stage(std::integral_constant<int, first + i>{}), ...);
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
