#pragma once

#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// A = C Cᵀ of a small symmetric positive definite matrix, whose size is known at run time.
/// @tparam most rows at most
template <int most, class Real> class CholeskyFactors {
public:
    /// The lower triangle, to be filled in before `factor`.
    Real entry[most][most];

    /// @param least pivot over the largest diagonal entry below which a row counts as singular  @param see (row, lanes where it is)
    template <class See> SLIDEWAY_FN void factor(int rows, double least, See const& see) {
        rows_ = rows;
        Real largest(0.0);
        for (int i = 0; i < rows; ++i) largest = max(largest, entry[i][i]);
        for (int i = 0; i < rows; ++i) {
            for (int j = 0; j <= i; ++j) {
                Real sum = entry[i][j];
                for (int k = 0; k < j; ++k) sum = fnma(entry[i][k], entry[j][k], sum);
                if (i > j) {
                    entry[i][j] = sum * entry[j][j];
                } else {
                    see(i, Mask<Real>(!(sum > Real(least) * largest)));
                    entry[i][i] = Real(1.0) / sqrt(sum);  // the reciprocal, by which rows are multiplied
                }
            }
        }
    }

    /// x ← A⁻¹ x.
    SLIDEWAY_FN void solve(Real* x) const {
        for (int i = 0; i < rows_; ++i) {
            for (int j = 0; j < i; ++j) x[i] = fnma(entry[i][j], x[j], x[i]);
            x[i] = x[i] * entry[i][i];
        }
        for (int i = rows_ - 1; i >= 0; --i) {
            for (int j = i + 1; j < rows_; ++j) x[i] = fnma(entry[j][i], x[j], x[i]);
            x[i] = x[i] * entry[i][i];
        }
    }

private:
    int rows_ = 0;
};

}  // namespace slideway::inline SLIDEWAY_ISA
