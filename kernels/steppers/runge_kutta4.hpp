#pragma once

#include "kernels/real.hpp"
#include "kernels/steppers/hermite.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Coefficients of the method below; the fifth stage is the step's end.
struct RungeKutta4Tableau {
    double c[5] = {0, 0.5, 0.5, 1, 1};
    double a[5][4] = {{}, {0.5}, {0, 0.5}, {0, 0, 1}, {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6}};
    double b[5] = {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6, 0};
    double e[5] = {};  // no estimate of the error
};

/// The classical Runge–Kutta method of order 4, for fixed steps: it has no error estimate.  A stage more than the textbook has, at
/// the end of the step, is the first of the next one: four derivatives a step, and a cubic inside it (error h⁴).
/// Source: Hairer, Nørsett & Wanner, Solving Ordinary Differential Equations I (1993), II.1, table 1.2.
struct RungeKutta4 {
    static constexpr int stages = 5;
    static constexpr int order = 4;
    static constexpr bool adaptive = false;
    static constexpr int dense_stages = 0;
    static constexpr bool has_two_estimates = false;

    using Tableau = RungeKutta4Tableau;

    /// State at which stage `s` evaluates the derivative; s = 4 is the end of the step, with the bits that `accumulate` gives.
    template <int s, int size, class Real>
    SLIDEWAY_FN static void stage_state(Real const* y, Real const (*k)[size], Real h, Real* at) {
        for (int i = 0; i < size; ++i) {
            if constexpr (s < 4) {
                constexpr double reach = Tableau{}.a[s][s - 1];
                at[i] = fma(h * Real(reach), k[s - 1][i], y[i]);
            } else {
                Real sum = k[0][i];
                sum = accumulate<1>(sum, k[1][i]);
                sum = accumulate<2>(sum, k[2][i]);
                sum = accumulate<3>(sum, k[3][i]);
                at[i] = fma(h * Real(1.0 / 6), sum, y[i]);
            }
        }
    }

    /// The running sum k₁ + 2k₂ + 2k₃ + k₄ from slope `s` = 1, 2, 3 on: one number per component in place of four slopes, and a single
    /// rounding at the size of the state.
    template <int s, class Real> SLIDEWAY_FN static Real accumulate(Real sum, Real slope) {
        if constexpr (s < 3) {
            return fma(Real(2.0), slope, sum);
        } else {
            return sum + slope;
        }
    }

    /// One component inside the step, at fraction θ of it: the cubic through values and slopes at both ends.
    template <int size, class Real>
    SLIDEWAY_FN static Real dense(Real const (*k)[size], int i, Real y0, Real y1, Real h, Real theta) {
        return hermite(y0, h * k[0][i], y1, h * k[4][i], theta);
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
