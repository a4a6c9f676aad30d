#pragma once

#include <utility>

#include "kernels/lanes/pack.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Attempts steps of an explicit pair in the lanes of a pack.
template <class Pair, class Model, class Real> class ExplicitStep {
public:
    static constexpr int order = Pair::order;
    static constexpr bool adaptive = Pair::adaptive;
    static constexpr bool stiff = false;
    static constexpr int evaluations = Pair::stages - 1;  // per attempt

    /// Fills what the pack knows of the attempt.  Idle lanes step in place.
    SLIDEWAY_HD void attempt(Pack<Model, Real>& pack) {
        for (int i = 0; i < size; ++i) k_[0][i] = pack.state.course.rates[i];
        pack.faults = Faults<Real>::none();
        constexpr typename Pair::Tableau w{};  // not Pair's own: device code has no constants of the host
        pack.begin_integrals(w.b[0], w.e[0]);
        stages(pack, std::make_integer_sequence<int, Pair::stages - 1>{});
        for (int i = 0; i < size; ++i) pack.end_rates[i] = k_[Pair::stages - 1][i];
    }

    /// Error estimate of one component.
    SLIDEWAY_HD Real error(Pack<Model, Real> const& pack, int i) const { return pack.step * Pair::error_slope(k_, i); }

    /// One component inside the step, at fraction θ of it.
    SLIDEWAY_HD Real dense(Pack<Model, Real> const& pack, int i, Real theta) const {
        return Pair::dense(k_, i, pack.state.course.y[i], pack.end[i], pack.step, theta);
    }

private:
    static constexpr int size = Model::size;

    template <int... s> SLIDEWAY_HD void stages(Pack<Model, Real>& pack, std::integer_sequence<int, s...>) {
        (stage<s + 1>(pack), ...);
    }

    template <int s> SLIDEWAY_HD void stage(Pack<Model, Real>& pack) {
        constexpr typename Pair::Tableau w{};
        constexpr bool last = s + 1 == Pair::stages;
        Real* const at = last ? pack.end : pack.scratch;
        Pair::template stage_state<s>(pack.state.course.y, k_, pack.step, at);
        Real const t = fma(pack.step, Real(w.c[s]), pack.state.course.t);
        auto const faults = pack.evaluate(t, at, k_[s], last ? pack.needs.ends : pack.needs.stages, pack.end_report);
        // A fault of one stage is NaN in those after it, whose own faults say nothing.
        pack.faults = pack.faults.or_else(faults);
        pack.add_integrands(w.b[s], w.e[s]);
    }

    Real k_[Pair::stages][size];
};

}  // namespace slideway::inline SLIDEWAY_ISA
