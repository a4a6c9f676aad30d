#pragma once

#include "kernels/real.hpp"
#include "kernels/simd/expect.hpp"

namespace slideway::inline SLIDEWAY_ISA {

template <class Real> SLIDEWAY_FN Real inner_product(Real const* a, Real const* b, int n) {
    Real sum(0.0);
    for (int i = 0; i < n; ++i) sum = fma(a[i], b[i], sum);
    return sum;
}

namespace detail {

/// In the lanes of the mask, the axis that the unit vectors before `w` span least, less what they span of it, as a unit vector.
/// @param barred axes that do not count, a bit each
template <int room, class Real>
SLIDEWAY_HD void place_least_spanned(Mask<Real> in, Real const (*unit)[room], int units, int n, unsigned barred, Real* w) {
    Real most(-1.0), which(0.0);
    for (int axis = 0; axis < n; ++axis) {
        if ((barred >> axis & 1u) != 0) continue;
        Real left(1.0);
        for (int j = 0; j < units; ++j) left = fnma(unit[j][axis], unit[j][axis], left);
        auto const more = left > most;
        most = select(more, left, most);
        which = select(more, Real(static_cast<double>(axis)), which);
    }
    Real axis[room];
    for (int i = 0; i < n; ++i) axis[i] = count<Real>(which == Real(static_cast<double>(i)));
    for (int j = 0; j < units; ++j) {
        Real const along = inner_product(unit[j], axis, n);
        for (int i = 0; i < n; ++i) axis[i] = fnma(along, unit[j][i], axis[i]);
    }
    Real const length = sqrt(inner_product(axis, axis, n));
    for (int i = 0; i < n; ++i) w[i] = select(in, axis[i] / length, w[i]);
}

}  // namespace detail

/// Modified Gram–Schmidt: makes `vectors` vectors of n numbers orthonormal in their order.  One that the earlier ones leave no more than `least` of
/// gives way to an axis.
/// @param barred axes that it may not be, a bit each
/// @param length [vectors] what the earlier ones left of each, R_jj of the QR decomposition
template <int room, class Real>
SLIDEWAY_HD void orthonormalise(Real (*w)[room], int vectors, int n, Real least, unsigned barred, Real* length) {
    SLIDEWAY_EXPECT(vectors <= n && n <= room && n < 32);
    for (int j = 0; j < vectors; ++j) {
        for (int k = 0; k < j; ++k) {
            Real const along = inner_product(w[k], w[j], n);
            for (int i = 0; i < n; ++i) w[j][i] = fnma(along, w[k][i], w[j][i]);
        }
        length[j] = sqrt(inner_product(w[j], w[j], n));
        auto const lost = !(length[j] > least);  // NaN too
        Real const inverse = Real(1.0) / select(lost, Real(1.0), length[j]);
        for (int i = 0; i < n; ++i) w[j][i] = inverse * w[j][i];
        if (any(lost)) detail::place_least_spanned(lost, w, j, n, barred, w[j]);
    }
}

}  // namespace slideway::inline SLIDEWAY_ISA
