#pragma once

#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// The classical Runge–Kutta method of order 4, for fixed steps: it has no error estimate.  A stage more than the textbook has, at
/// the end of the step, is the first of the next one: four derivatives a step, and a cubic inside it (error h⁴).
/// Source: Hairer, Nørsett & Wanner, Solving Ordinary Differential Equations I (1993), II.1, table 1.2.
struct RungeKutta4 {
    static constexpr int order = 4;
    static constexpr double whole = 6;  // what the weights are parts of
    double c[5] = {0, 0.5, 0.5, 1, 1};
    double a[5][4] = {{}, {0.5}, {0, 0.5}, {0, 0, 1}, {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6}};
    double b[5] = {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6, 0};
    double e[5] = {};
};

}  // namespace slideway::inline SLIDEWAY_ISA
