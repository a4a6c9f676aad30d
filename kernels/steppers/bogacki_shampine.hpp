#pragma once

#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Explicit Runge–Kutta pair of order 3(2) with four stages, the last of which is the first of the next step; between the ends the
/// cubic through both states and derivatives.  Source: Bogacki & Shampine, Appl. Math. Lett. 2 (1989) 321–325.
struct BogackiShampine {
    static constexpr int order = 3;
    double c[4] = {0, 1.0 / 2, 3.0 / 4, 1};
    double a[4][3] = {{}, {1.0 / 2}, {0, 3.0 / 4}, {2.0 / 9, 1.0 / 3, 4.0 / 9}};
    double b[4] = {2.0 / 9, 1.0 / 3, 4.0 / 9, 0};
    // b minus the weights of the second order.
    double e[4] = {-5.0 / 72, 1.0 / 12, 1.0 / 9, -1.0 / 8};
};

}  // namespace slideway::inline SLIDEWAY_ISA
