#pragma once

#include "kernels/lanes/pack.hpp"
#include "kernels/lanes/stepper_traits.hpp"
#include "kernels/real.hpp"
#include "kernels/steppers/ros34pw2.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Attempts steps of the linearly implicit method in the lanes of a pack.  The model's linearisation stands for the Jacobian; it
/// leaves out what is not stiff, which a W-method forgives.
template <class Model, class Real> class StiffStep : public StepperTraits {
public:
    static constexpr bool stiff = true;
    static constexpr int jacobians = 1;
    SLIDEWAY_HD static int order(Pack<Model, Real> const&) { return 3; }
    /// Per attempt, the end's, that of ∂f/∂t and those of a linearisation by differences included.
    SLIDEWAY_HD static int evaluations(Pack<Model, Real> const&) { return Ros34pw2Tableau::stages + 1 + Model::evaluations_of_linearisation; }
    /// Largest sum of the relative residuals of the linear solves; without pivoting a bad matrix shows here.
    static constexpr double largest_residual = 1e-8;
    /// Part of a step over which a difference of f stands for ∂f/∂t.
    static constexpr double drift_part = 1e-3;

    SLIDEWAY_HD void attempt(Pack<Model, Real>& pack, StepStart<Model, Real> const& from, Attempt<Model, Real>& to) {
        constexpr Ros34pw2Tableau w{};
        pack.model.linearise(from.t, from.y, pack.state.constants.parameters, from.memory, matrix_);
        hg_ = to.step * Real(w.gamma);
        matrix_.factor(hg_);
        residual_ = Real(0.0);
        states_ = pack.states();
        to.faults = take_drift(pack, from, to);
        if (from.needs.stages) pack.begin_integrals({w.b[0], w.e[0]});
        for (int i = 0; i < states_; ++i) right_[i] = fma(Real(w.drift[0]), drift_[i], hg_ * from.rates[i]);
        solve(0);
        stage<1>(pack, from, to);
        stage<2>(pack, from, to);
        stage<3>(pack, from, to);
        Real const half_square = Real(0.5) * (to.step * to.step);
        for (int i = 0; i < states_; ++i) {
            to.end[i] = combined(fma(half_square, bend_[i], from.y[i]), w.m, i);
            error_[i] = combined(Real(0.0), w.error, i);
        }
        auto const faults =
            pack.evaluate(from.t + to.step, to.end, from.memory, to.end_rates, from.needs.ends, to.report);
        to.faults = to.faults.or_else(faults);
        // The estimate does not know the derivative at the end, from which the next step starts: an infinite one is no solution.
        for (int i = 0; i < states_; ++i) residual_ = fma(to.end_rates[i], Real(0.0), residual_);
    }

    /// Error estimates of the components; NaN where the linear equations were not solved or the end has no derivative.
    SLIDEWAY_HD void errors(Attempt<Model, Real> const&, Real* of_state) const {
        auto const solved = residual_ <= Real(largest_residual);
        for (int i = 0; i < states_; ++i) of_state[i] = select(solved, error_[i], Real(follows));
    }

    /// Reduces the estimate to what of it is left after a time τ: (I − τA)⁻¹ error, an implicit Euler step of the linearised motion.
    /// Slow motion keeps its error; ringing faster than 1/τ, which the method damps whatever it does, loses it.  Shampine's filter
    /// (Hairer & Wanner, Solving Ordinary Differential Equations II (1996), IV.8) with τ in the place of hγ: a step that is short
    /// because of the ringing must be free to grow across it.  The matrix is at the filter's service until the next attempt.
    SLIDEWAY_HD void filter_error(Real const& time) {
        matrix_.factor(time);
        matrix_.solve(error_, lasting_error_);
    }

    /// That, of components where it is smaller than the whole: the matrix may be near a singular one.
    SLIDEWAY_HD void lasting_errors(Real const* whole, Real* lasting) const {
        for (int i = 0; i < states_; ++i) lasting[i] = select(abs(lasting_error_[i]) < abs(whole[i]), lasting_error_[i], whole[i]);
    }

    /// The state inside the step: the straight line, for the derivatives at its ends belong to fast motions that the method
    /// damps.  Steps end where samples are wanted.
    SLIDEWAY_HD void dense(StepStart<Model, Real> const& from, Attempt<Model, Real> const& to, Real theta, Real* state) const {
        for (int i = 0; i < states_; ++i) state[i] = fma(theta, to.end[i] - from.y[i], from.y[i]);
    }

    /// Ω² [1/s²] of the stiffest motions and the number of touching pairs, at the start of the step.
    SLIDEWAY_HD Real rate_squared() const { return matrix_.rate_squared(); }
    SLIDEWAY_HD Real touching() const { return matrix_.touching; }

private:
    static constexpr int size = Model::size;

    /// h²γ ∂f/∂t: how a drive moves a stiff contact's equilibrium.  It would cancel with the exact Jacobian of a linear problem, which the model's is
    /// not.  Stages know that equilibrium to first order alone.  Where the model knows its acceleration a, they step z = y − ½ a (t − t_n)², whose
    /// equilibrium moves evenly: z' = f − a (t − t_n).
    SLIDEWAY_HD Faults<Real> take_drift(Pack<Model, Real>& pack, StepStart<Model, Real> const& from, Attempt<Model, Real>& to) {
        Real const later = fma(Real(drift_part), to.step, from.t), apart = later - from.t;
        auto const faults = pack.evaluate(later, from.y, from.memory, drift_, false, to.report);
        // Time may be too coarse for so short a part.
        auto const differs = apart > Real(0.0);
        Real const factor = select(differs, hg_ * to.step / select(differs, apart, Real(1.0)), Real(0.0));
        for (auto& of_state : bend_) of_state = Real(0.0);
        pack.model.bend(from.t, to.step, from.y, pack.state.constants.parameters, bend_);
        Real const squared = hg_ * to.step;
        for (int i = 0; i < states_; ++i) drift_[i] = fms(factor, drift_[i] - from.rates[i], squared * bend_[i]);
        return faults;
    }

    template <int s>
    SLIDEWAY_HD void stage(Pack<Model, Real>& pack, StepStart<Model, Real> const& from, Attempt<Model, Real>& to) {
        constexpr Ros34pw2Tableau w{};
        Real const after = to.step * Real(w.node[s]), half_square = Real(0.5) * (after * after);
        for (int i = 0; i < states_; ++i) {
            Real sum = fma(half_square, bend_[i], from.y[i]);
            for (int j = 0; j < s; ++j) sum = fma(Real(w.a[s][j]), u_[j][i], sum);
            at_[i] = sum;
        }
        auto const faults = pack.evaluate(from.t + after, at_, from.memory, right_, from.needs.stages, to.report);
        to.faults = to.faults.or_else(faults);
        if (from.needs.stages) pack.add_integrands({w.b[s], w.e[s]}, to.report);
        for (int i = 0; i < states_; ++i) {
            Real sum = fma(Real(w.drift[s]), drift_[i], hg_ * fnma(after, bend_[i], right_[i]));
            for (int j = 0; j < s; ++j) sum = fma(Real(w.gamma * w.c[s][j]), u_[j][i], sum);
            right_[i] = sum;
        }
        solve(s);
    }

    SLIDEWAY_HD void solve(int s) {
        matrix_.solve(right_, u_[s]);
        residual_ = residual_ + matrix_.residual(right_, u_[s]);  // a sum, for a maximum would lose a NaN
    }

    /// start + Σ weight_j u_j.
    SLIDEWAY_HD Real combined(Real start, double const (&weights)[4], int i) const {
        Real sum = start;
        for (int j = 0; j < 4; ++j) sum = fma(Real(weights[j]), u_[j][i], sum);
        return sum;
    }

    typename Model::template Linearisation<Real> matrix_;
    Real u_[4][size], right_[size], error_[size], lasting_error_[size];
    Real at_[size];  // where a stage evaluates the derivative
    Real drift_[size], bend_[size];  // of an equilibrium that moves
    Real hg_, residual_;
    StateCount<Model> states_;
};

}  // namespace slideway::inline SLIDEWAY_ISA
