#pragma once

#include "kernels/real.hpp"
#include "kernels/simd/expect.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Σ (a/b)² over pairs with one division for three of them: (a/b)² + (c/d)² = (a²d² + c²b²)/(bd)², and so on.  Divisions are what a
/// norm costs.
template <class Real> class SquaredRatios {
public:
    /// @param b > 0, with b⁶ within the range of the number type.
    SLIDEWAY_FN void add(Real a, Real b) {
        SLIDEWAY_EXPECT(none(b <= Real(0.0)));
        if (held_ == 0) {
            a_ = a, b_ = b;
        } else if (held_ == 1) {
            Real const left = a_ * b, right = a * b_;
            squares_ = fma(left, left, right * right), b_ = b_ * b;
        } else {
            Real const product = b_ * b, right = a * b_;
            sum_ = sum_ + fma(squares_, b * b, right * right) / (product * product);
        }
        held_ = held_ == 2 ? 0 : held_ + 1;
    }

    SLIDEWAY_FN Real total() const {
        if (held_ == 0) return sum_;
        if (held_ == 2) return sum_ + squares_ / (b_ * b_);
        Real const ratio = a_ / b_;
        return fma(ratio, ratio, sum_);
    }

private:
    Real sum_ = Real(0.0), a_ = Real(0.0), b_ = Real(1.0), squares_ = Real(0.0);
    int held_ = 0;  // pairs that wait for a division
};

/// The larger of two squared norms; NaN where either is.
template <class Real> SLIDEWAY_FN Real larger_norm(Real a, Real b) { return max(a, b) + Real(0.0) * (a + b); }

}  // namespace slideway::inline SLIDEWAY_ISA
