#pragma once

#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Σ (a/b)² over pairs with one division for two of them: (a/b)² + (c/d)² = (a²d² + c²b²)/(bd)².  Divisions are what a norm costs.
template <class Real> class SquaredRatios {
public:
    /// @param b > 0, with b⁴ within the range of the number type.
    SLIDEWAY_FN void add(Real a, Real b) {
        if (!pending_) {
            a_ = a, b_ = b;
        } else {
            Real const product = b_ * b, left = a_ * b, right = a * b_;
            sum_ = sum_ + fma(left, left, right * right) / (product * product);
        }
        pending_ = !pending_;
    }

    SLIDEWAY_FN Real total() const {
        if (!pending_) return sum_;
        Real const ratio = a_ / b_;
        return fma(ratio, ratio, sum_);
    }

private:
    Real sum_ = Real(0.0), a_ = Real(0.0), b_ = Real(1.0);
    bool pending_ = false;
};

}  // namespace slideway::inline SLIDEWAY_ISA
