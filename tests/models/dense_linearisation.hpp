#pragma once

#include "kernels/math/dense_solve.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// A matrix A as the stiff method wants it of a model.
template <int n, class Real> struct DenseLinearisation {
    Real a[n][n];
    Real touching = Real(1.0);
    Real solvable_below;  // hγ up to which the answer counts

    SLIDEWAY_HD void factor(Real hg) {
        hg_ = hg;
        for (int i = 0; i < n; ++i) {
            for (int j = 0; j < n; ++j) {
                matrix_[i][j] = fnma(hg, a[i][j], Real(i == j ? 1.0 : 0.0));
            }
        }
        factors_.factor(matrix_);
    }

    SLIDEWAY_HD void solve(Real const* r, Real* u) const {
        Real x[n];
        for (int i = 0; i < n; ++i) x[i] = r[i];
        factors_.solve(x);
        for (int i = 0; i < n; ++i) u[i] = x[i];
    }

    SLIDEWAY_HD Real residual(Real const* r, Real const* u) const {
        Real worst(0.0);
        for (int i = 0; i < n; ++i) {
            Real rest = negated(r[i]), size = abs(r[i]);
            for (int j = 0; j < n; ++j) {
                rest = fma(matrix_[i][j], u[j], rest);
                size = fma(abs(matrix_[i][j]), abs(u[j]), size);
            }
            worst = worst + abs(rest) / (size + Real(1e-300));
        }
        return select(hg_ <= solvable_below, worst, Real(1.0));
    }

    SLIDEWAY_HD Real rate_squared() const { return a[0][0] * a[0][0] + abs(a[0][1] * a[1][0]); }

    SLIDEWAY_HD Real vibration_energy(Real const*) const { return Real(0.0); }

private:
    Real hg_;
    Real matrix_[n][n];
    LuFactors<n, Real> factors_;
};

}  // namespace slideway::inline SLIDEWAY_ISA
