#pragma once

#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Slope a of the damping factor 1 + a h'/v0 that returns the coefficient of restitution e: the root in (0, 1/e) of
/// a (1 + e) = ln[(1 + a)/(1 − e a)].  It follows from m v dv/dh = −F(h)(1 + a v/v0): ∫ v dv/(1 + a v/v0) over the impact vanishes
/// between v0 and −e v0, whatever F (model.md 4).
/// @param e in (0, 1].  @return a = 0 for e = 1.  Runs once per member, in double.
SLIDEWAY_FN double restitution_slope(double e) {
    if (!(e < 1.0)) return 0.0;
    // The difference of both sides is negative above the root and positive below it (a = 0 is the trivial root), and steep
    // towards a = 1/e: bisect in b = 1 − e a, whose logarithm is what varies.
    double low = -745.0, high = 0.0;  // ln b
    for (int i = 0; i < 200; ++i) {
        double const middle = 0.5 * (low + high);
        double const a = -::expm1(middle) / e;
        bool const above = a * (1.0 + e) < ::log1p(a) - middle;
        (above ? low : high) = middle;
    }
    return -::expm1(0.5 * (low + high)) / e;
}

}  // namespace slideway::inline SLIDEWAY_ISA
