#pragma once

#include "kernels/real.hpp"
#include "kernels/steppers/explicit_pair.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Coefficients of the method below; its fifth stage is the derivative at the end, the first of the next step.
struct RungeKutta4Tableau {
    double c[5] = {0, 1.0 / 2, 1.0 / 2, 1, 1};
    double a[5][4] = {{}, {1.0 / 2}, {0, 1.0 / 2}, {0, 0, 1}, {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6}};
    double b[5] = {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6, 0};
    double e[5] = {};  // no estimate of the error
};

/// The classical Runge–Kutta method of order 4 with a fixed step; between the ends the cubic through both states and derivatives.
/// Source: Kutta, Z. Math. Phys. 46 (1901) 435–453.
struct RungeKutta4 : ExplicitPair<RungeKutta4Tableau, 5> {
    static constexpr int order = 4;
    static constexpr bool adaptive = false;

    /// One component inside the step, at fraction θ of it.  @param y0, y1 the component at both ends of the step.
    template <int size, class Real>
    SLIDEWAY_FN static Real dense(Real const (*k)[size], int i, Real y0, Real y1, Real h, Real theta) {
        return hermite(y0, h * k[0][i], y1, h * k[4][i], theta);
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
