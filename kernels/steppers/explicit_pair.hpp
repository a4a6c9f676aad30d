#pragma once

#include <type_traits>
#include <utility>

#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// What explicit Runge–Kutta pairs share that lanes are compiled for, those that go by clocks or end steps inside; all others are PairNumbers.
/// @tparam Tableau with one row of d  @tparam count the number of stages, of which the last is the first of the next step.
template <class Tableau_, int count> struct ExplicitPair {
    using Tableau = Tableau_;
    static constexpr int stages = count;

    /// Calls a function with the number of each stage but the first, which the last step has left; a constant, for the tableau.
    template <class Stage> SLIDEWAY_FN static void each_stage(Stage const& stage) {
        [&]<int... s>(std::integer_sequence<int, s...>) { (stage(std::integral_constant<int, s + 1>{}), ...); }(std::make_integer_sequence<int, count - 1>{});
    }

    /// State at which stage `s` evaluates the derivative: y + h Σ_j a_sj k_j.
    /// @param n components there are
    template <int s, int room, class Real>
    SLIDEWAY_FN static void stage_state(Real const* y, Real const (*k)[room], Real h, Real* at, int n = room) {
        for (int i = 0; i < n; ++i) at[i] = stage_value<s>(y, k, h, i);
    }
    /// One component of it.
    template <int s, int size, class Real> SLIDEWAY_FN static Real stage_value(Real const* y, Real const (*k)[size], Real h, int i) {
        return fma(h, weighted<s>(k, i), y[i]);
    }

    /// Σ_j e_j k_j of one component: the error estimate is h times this.
    template <int size, class Real> SLIDEWAY_FN static Real error_slope(Real const (*k)[size], int i) {
        return combined<&Tableau::e>(k, i);
    }

    /// One component inside the step, at fraction θ of it: the cubic through both ends, and what Σ_j d_j k_j adds with θ²(1 − θ)².
    /// @param y0, y1 the component at both ends of the step.
    template <int size, class Real>
    SLIDEWAY_FN static Real dense(Real const (*k)[size], int i, Real y0, Real y1, Real h, Real theta) {
        Real const rest = Real(1.0) - theta;
        Real const change = y1 - y0;
        Real const start = fms(h, k[0][i], change);
        Real const end = fnma(h, k[stages - 1][i], change) - start;
        Real const bend = h * combined<&Tableau::d>(k, i);
        return fma(theta, fma(rest, fma(theta, fma(rest, bend, end), start), change), y0);
    }

private:
    template <int s, int size, class Real> SLIDEWAY_FN static Real weighted(Real const (*k)[size], int i) {
        constexpr int first = Tableau{}.a[s][0] != 0 ? 0 : 1;
        return weighted<s, first + 1>(k, i, Real(Tableau{}.a[s][first]) * k[first][i]);
    }

    // The newest slope comes last, for the sum waits for it alone.
    template <int s, int j, int size, class Real>
    SLIDEWAY_FN static Real weighted(Real const (*k)[size], int i, Real sum) {
        if constexpr (j == s) {
            return sum;
        } else {
            constexpr double a = Tableau{}.a[s][j];
            if constexpr (a != 0) sum = fma(Real(a), k[j][i], sum);
            return weighted<s, j + 1>(k, i, sum);
        }
    }

    /// Σ_j w_j k_j of all stages.
    template <auto weights, int size, class Real> SLIDEWAY_FN static Real combined(Real const (*k)[size], int i) {
        return combined<weights, 1>(k, i, Real((Tableau{}.*weights)[0]) * k[0][i]);
    }
    template <auto weights, int j, int size, class Real>
    SLIDEWAY_FN static Real combined(Real const (*k)[size], int i, Real sum) {
        if constexpr (j == stages) {
            return sum;
        } else {
            constexpr double w = (Tableau{}.*weights)[j];
            if constexpr (w != 0) sum = fma(Real(w), k[j][i], sum);
            return combined<weights, j + 1>(k, i, sum);
        }
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
