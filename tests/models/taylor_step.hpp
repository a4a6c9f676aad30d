#pragma once

#include "kernels/lanes/attempt.hpp"
#include "kernels/lanes/pack.hpp"
#include "kernels/lanes/stepper_traits.hpp"
#include "kernels/real.hpp"
#include "tests/models/jet.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Attempts steps of a Taylor series of a given order in the lanes of a pack: x(t + h) = Σ x_k hᵏ, (k + 1) x_{k+1} the k-th coefficient of
/// the derivative, which `Jet` finds.  The error estimate is the last term, that of the series one order lower: half the order's
/// multiplications buy nothing but length of step, which falls with 1/e² of the radius of convergence at the best order
/// −½ ln(tolerance) (Jorba & Zou, Experimental Mathematics 14 (2005) 99).
template <int terms, class Model, class Real> class TaylorStep : public StepperTraits {
public:
    SLIDEWAY_HD static int order(Pack<Model, Real> const&) { return terms; }
    /// Per attempt: its coefficients, and the end.
    SLIDEWAY_HD static int evaluations(Pack<Model, Real> const&) { return terms + 1; }

    SLIDEWAY_HD void attempt(Pack<Model, Real>& pack, StepStart<Model, Real> const& from, Attempt<Model, Real>& to) {
        expand(pack, from);
        at(to.step, to.end);
        last_power_ = power<terms - 1>(to.step);
        to.faults = pack.evaluate(from.t + to.step, to.end, from.memory, to.end_rates, from.needs.ends, to.report);
    }

    /// Error estimates of the components: their last terms, or a part e⁻² of those before where symmetry makes that the larger.
    SLIDEWAY_HD void errors(Attempt<Model, Real> const& to, Real* of_state) const {
        for (int i = 0; i < size; ++i)
            of_state[i] = last_power_ * max(abs(c_[i][terms] * to.step), Real(0.1353352832366127) * abs(c_[i][terms - 1]));
    }

    /// The state inside the step, at fraction θ of it.
    SLIDEWAY_FN void dense(StepStart<Model, Real> const&, Attempt<Model, Real> const& to, Real theta, Real* state) const {
        at(theta * to.step, state);
    }

private:
    static_assert(!Model::has_contacts, "contacts have kinks");
    static_assert(Pack<Model, Real>::Observer::integrals == 0, "there are no stages to add up integrands of");
    static constexpr int size = Model::size;
    static constexpr int length = terms + 1;
    using Rows = JetRows<Real, length>;
    using Parameters = typename Model::template Parameters<Real>;
    static constexpr int parameters = sizeof(Parameters) / sizeof(Real);

    SLIDEWAY_HD void expand(Pack<Model, Real> const& pack, StepStart<Model, Real> const& from) {
        Rows rows;
        Real time[length];
        time[0] = from.t;
        time[1] = Real(1.0);
        for (int k = 2; k < length; ++k) time[k] = Real(0.0);
        for (int i = 0; i < size; ++i) c_[i][0] = from.y[i];
        append<0>(pack, rows, time);
    }

    /// The coefficients k + 1 of the state, and those after them.
    template <int k> SLIDEWAY_FN void append(Pack<Model, Real> const& pack, Rows& rows, Real* time) {
        using Number = Jet<Real, length, k>;
        using SeriesParameters = typename Model::template Parameters<Number>;
        static_assert(sizeof(SeriesParameters) == parameters * sizeof(Number));
        auto const* const numbers = reinterpret_cast<Real const*>(&pack.state.constants.parameters);
        SeriesParameters constants;
        for (int i = 0; i < parameters; ++i) reinterpret_cast<Number*>(&constants)[i] = Number(numbers[i]);
        Number y[size], rates[size];
        for (int i = 0; i < size; ++i) y[i] = Number(c_[i], &rows);
        typename Model::template Memory<Number> const memory{};
        typename Model::template Report<Number> report;
        rows.used = 0;
        pack.model.template derivative<false>(Number(time, &rows), y, constants, memory, rates, &report);
        for (int i = 0; i < size; ++i) c_[i][k + 1] = Real(1.0 / (k + 1)) * rates[i].last();
        if constexpr (k + 1 < terms) append<k + 1>(pack, rows, time);
    }

    /// The state after a time, by Horner's scheme of the even and of the odd terms.
    SLIDEWAY_FN void at(Real time, Real* state) const {
        Real const square = time * time;
        for (int i = 0; i < size; ++i) {
            constexpr int last_even = terms - terms % 2, last_odd = terms - 1 + terms % 2;
            Real even = c_[i][last_even], odd = c_[i][last_odd];
            for (int k = last_even - 2; k >= 0; k -= 2) even = fma(even, square, c_[i][k]);
            for (int k = last_odd - 2; k > 0; k -= 2) odd = fma(odd, square, c_[i][k]);
            state[i] = fma(odd, time, even);
        }
    }

    template <int n> SLIDEWAY_FN static Real power(Real x) {
        if constexpr (n == 1) {
            return x;
        } else {
            Real const half = power<n / 2>(x);
            return n % 2 == 0 ? Real(half * half) : Real(half * half * x);
        }
    }

    Real c_[size][length];  // of the states
    Real last_power_;
};

/// A model whose derivative is analytic between its events: it decides by nothing that changes within a step, so that it may be called with series.
/// @tparam Base what it is beside
template <class Base> struct Analytic : Base {
    static constexpr bool has_own_stepper = true;
    /// What `auto` steps by: the series whose order suits the tolerance, −½ ln(rtol) or so.  @param work is called with a null pointer to the stepper
    template <class Model, class Real, class Work> SLIDEWAY_HD static void with_stepper(double rtol, Work const& work) {
        if (rtol > 1e-7) work(static_cast<TaylorStep<8, Model, Real>*>(nullptr));
        else if (rtol > 1e-10) work(static_cast<TaylorStep<12, Model, Real>*>(nullptr));
        else if (rtol > 1e-13) work(static_cast<TaylorStep<16, Model, Real>*>(nullptr));
        else work(static_cast<TaylorStep<20, Model, Real>*>(nullptr));
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
