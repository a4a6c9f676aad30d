#pragma once

#include "kernels/lanes/pack.hpp"
#include "kernels/real.hpp"
#include "kernels/steppers/ros34pw2.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Attempts steps of the linearly implicit method in the lanes of a pack.  The model's linearisation stands for the Jacobian; it
/// leaves out what is not stiff, which a W-method forgives.
template <class Model, class Real> class StiffStep {
public:
    static constexpr int order = 3;
    static constexpr bool adaptive = true;
    static constexpr bool stiff = true;
    static constexpr int evaluations = Ros34pw2Tableau::stages;  // per attempt, the end's included
    /// Largest sum of the relative residuals of the linear solves; without pivoting a bad matrix shows here.
    static constexpr double largest_residual = 1e-8;

    SLIDEWAY_HD void attempt(Pack<Model, Real>& pack) {
        constexpr Ros34pw2Tableau w{};
        auto& c = pack.state.course;
        pack.model.linearise(c.t, c.y, pack.state.constants.parameters, pack.state.contacts.memory, matrix_);
        c.jacobians = c.jacobians + count<Real>(pack.busy);
        hg_ = pack.step * Real(w.gamma);
        matrix_.factor(hg_);
        residual_ = Real(0.0);
        pack.faults = Faults<Real>::none();
        pack.begin_integrals(w.b[0], w.e[0]);
        for (int i = 0; i < size; ++i) right_[i] = hg_ * c.rates[i];
        solve(0);
        stage<1>(pack);
        stage<2>(pack);
        stage<3>(pack);
        for (int i = 0; i < size; ++i) {
            pack.end[i] = combined(c.y[i], w.m, i);
            error_[i] = combined(Real(0.0), w.error, i);
        }
        auto const faults = pack.evaluate(c.t + pack.step, pack.end, pack.end_rates, pack.needs.ends, pack.end_report);
        pack.faults = pack.faults.or_else(faults);
        // The estimate does not know the derivative at the end, from which the next step starts: an infinite one is no solution.
        for (int i = 0; i < size; ++i) residual_ = fma(pack.end_rates[i], Real(0.0), residual_);
    }

    /// Error estimate of one component; NaN where the linear equations were not solved or the end has no derivative.
    SLIDEWAY_HD Real error(Pack<Model, Real> const&, int i) const {
        auto const solved = residual_ <= Real(largest_residual);
        return select(solved, error_[i], Real(follows));
    }

    /// Reduces the estimate to what of it is left after a time τ: (I − τA)⁻¹ error, an implicit Euler step of the linearised motion.
    /// Slow motion keeps its error; ringing faster than 1/τ, which the method damps whatever it does, loses it.  Shampine's filter
    /// (Hairer & Wanner, Solving Ordinary Differential Equations II (1996), IV.8) with τ in the place of hγ: a step that is short
    /// because of the ringing must be free to grow across it.  The matrix is at the filter's service until the next attempt.
    SLIDEWAY_HD void filter_error(Real const& time) {
        matrix_.factor(time);
        matrix_.solve(error_, lasting_error_);
    }

    /// One component of that, where it is the smaller one: the matrix may be near a singular one.
    SLIDEWAY_HD Real lasting_error(Pack<Model, Real> const& pack, int i) const {
        Real const whole = error(pack, i);
        return select(abs(lasting_error_[i]) < abs(whole), lasting_error_[i], whole);
    }

    /// One component inside the step: the straight line, for the derivatives at its ends belong to fast motions that the method
    /// damps.  Steps end where samples are wanted.
    SLIDEWAY_HD Real dense(Pack<Model, Real> const& pack, int i, Real theta) const {
        auto const& y = pack.state.course.y;
        return fma(theta, pack.end[i] - y[i], y[i]);
    }

    /// Ω² [1/s²] of the stiffest motions and the number of touching pairs, at the start of the step.
    SLIDEWAY_HD Real rate_squared() const { return matrix_.rate_squared(); }
    SLIDEWAY_HD Real touching() const { return matrix_.touching; }

private:
    static constexpr int size = Model::size;

    template <int s> SLIDEWAY_HD void stage(Pack<Model, Real>& pack) {
        constexpr Ros34pw2Tableau w{};
        auto const& c = pack.state.course;
        for (int i = 0; i < size; ++i) {
            Real sum = c.y[i];
            for (int j = 0; j < s; ++j) sum = fma(Real(w.a[s][j]), u_[j][i], sum);
            pack.scratch[i] = sum;
        }
        Real const t = fma(pack.step, Real(w.node[s]), c.t);
        auto const faults = pack.evaluate(t, pack.scratch, right_, pack.needs.stages, pack.end_report);
        pack.faults = pack.faults.or_else(faults);
        pack.add_integrands(w.b[s], w.e[s]);
        for (int i = 0; i < size; ++i) {
            Real sum = hg_ * right_[i];
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
    Real hg_, residual_;
};

}  // namespace slideway::inline SLIDEWAY_ISA
