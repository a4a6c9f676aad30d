#pragma once

#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

namespace detail {

// Coefficients [first, first + count) by Estrin's scheme: halves joined by a power of x, a chain of log2(count) steps
// instead of Horner's count.  xp is x^p.
template <int first, int count, class Real>
SLIDEWAY_FN Real estrin(double const* c, Real x1, Real x2, Real x4, Real x8, Real x16) {
    static_assert(count <= 32);
    if constexpr (count == 1) {
        return Real(c[first]);
    } else {
        constexpr int low = count > 16 ? 16 : count > 8 ? 8 : count > 4 ? 4 : count > 2 ? 2 : 1;
        Real const power = low == 16 ? x16 : low == 8 ? x8 : low == 4 ? x4 : low == 2 ? x2 : x1;
        return fma(power, estrin<first + low, count - low>(c, x1, x2, x4, x8, x16),
                   estrin<first, low>(c, x1, x2, x4, x8, x16));
    }
}

}  // namespace detail

/// c0 + c1 x + c2 x² + …, at most 32 coefficients.
template <class Real, class... Coefficients> SLIDEWAY_FN Real polynomial(Real x, Coefficients... coefficients) {
    constexpr int count = static_cast<int>(sizeof...(coefficients));
    double const c[] = {coefficients...};
    Real x2 = x, x4 = x, x8 = x, x16 = x;  // powers that no term needs stay x
    if constexpr (count > 2) x2 = x * x;
    if constexpr (count > 4) x4 = x2 * x2;
    if constexpr (count > 8) x8 = x4 * x4;
    if constexpr (count > 16) x16 = x8 * x8;
    return detail::estrin<0, count>(c, x, x2, x4, x8, x16);
}

}  // namespace slideway::inline SLIDEWAY_ISA
