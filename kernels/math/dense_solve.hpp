#pragma once

#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// LU factors of a small matrix without pivoting (Doolittle): for matrices whose leading minors keep away from zero, as those of
/// a mass matrix with stiffness and damping added do.  A vanishing pivot gives infinities or NaN and a small one costs digits:
/// check the residual.
template <int n, class Real> struct LuFactors {
    Real a[n][n];  // unit lower triangle below the diagonal, upper above it, reciprocals of the pivots on it

    SLIDEWAY_HD void factor(Real const (&matrix)[n][n]) {
        for (int i = 0; i < n; ++i) {
            for (int j = 0; j < n; ++j) a[i][j] = matrix[i][j];
        }
        eliminate<0>();
    }

    /// x ← matrix⁻¹ x.
    SLIDEWAY_HD void solve(Real* x) const {
        forward<1>(x);
        backward<n - 1>(x);
    }

private:
    // Steps are template arguments: every index is then a constant, and g++ unrolls what it would else keep as a loop.
    template <int k> SLIDEWAY_FN void eliminate() {
        Real const inverse = Real(1.0) / a[k][k];
        a[k][k] = inverse;
        if constexpr (k + 1 < n) {
            for (int i = k + 1; i < n; ++i) {
                Real const factor = a[i][k] * inverse;
                a[i][k] = factor;
                for (int j = k + 1; j < n; ++j) a[i][j] = fnma(factor, a[k][j], a[i][j]);
            }
            eliminate<k + 1>();
        }
    }

    template <int i> SLIDEWAY_FN void forward(Real* x) const {
        if constexpr (i < n) {
            for (int j = 0; j < i; ++j) x[i] = fnma(a[i][j], x[j], x[i]);
            forward<i + 1>(x);
        }
    }

    template <int i> SLIDEWAY_FN void backward(Real* x) const {
        for (int j = i + 1; j < n; ++j) x[i] = fnma(a[i][j], x[j], x[i]);
        x[i] = x[i] * a[i][i];
        if constexpr (i > 0) backward<i - 1>(x);
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
