#pragma once

#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// A = C Cᵀ of a small symmetric positive definite matrix, whose size is known at run time.
/// @tparam most rows at most
template <int most, class Real> class CholeskyFactors {
public:
    /// The lower triangle, to be filled in before `factor`.
    Real entry[most][most];

    /// @param loops whose `up` and `down` have a function see 0 … n − 1 (kernels/linkage/linkage_plans.hpp)
    /// @param least pivot over the largest diagonal entry below which a row counts as singular  @param see (row, lanes where it is)
    template <class Loops, class See> SLIDEWAY_FN void factor(Loops const& loops, int rows, double least, See const& see) {
        rows_ = rows;
        Real largest(0.0);
        loops.up(rows, [&](int i) SLIDEWAY_INLINED { largest = max(largest, entry[i][i]); });
        loops.up(rows, [&](int i) SLIDEWAY_INLINED {
            loops.up(i, [&](int j) SLIDEWAY_INLINED { entry[i][j] = rest(loops, i, j) * entry[j][j]; });
            Real const pivot = rest(loops, i, i);
            see(i, Mask<Real>(!(pivot > Real(least) * largest)));
            entry[i][i] = Real(1.0) / sqrt(pivot);  // the reciprocal, by which rows are multiplied
        });
    }

    /// x ← A⁻¹ x.
    template <class Loops> SLIDEWAY_FN void solve(Loops const& loops, Real* x) const {
        loops.up(rows_, [&](int i) SLIDEWAY_INLINED {
            loops.up(i, [&](int j) SLIDEWAY_INLINED { x[i] = fnma(entry[i][j], x[j], x[i]); });
            x[i] = x[i] * entry[i][i];
        });
        loops.down(rows_, [&](int i) SLIDEWAY_INLINED {
            loops.up(rows_, [&](int j) SLIDEWAY_INLINED {
                if (j > i) x[i] = fnma(entry[j][i], x[j], x[i]);
            });
            x[i] = x[i] * entry[i][i];
        });
    }

private:
    /// What the rows before leave of an entry.
    template <class Loops> SLIDEWAY_FN Real rest(Loops const& loops, int i, int j) const {
        Real sum = entry[i][j];
        loops.up(j, [&](int k) SLIDEWAY_INLINED { sum = fnma(entry[i][k], entry[j][k], sum); });
        return sum;
    }

    int rows_ = 0;
};

}  // namespace slideway::inline SLIDEWAY_ISA
