#pragma once

#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// The map x ← 1 − a x² + y, y ← b x, whose determinant is −b everywhere.  Source: Hénon, Commun. Math. Phys. 50 (1976) 69–77,
/// equation 4.  Dimensionless; every state has an image.
struct Henon {
    struct Inputs {
        double a = 1.4, b = 0.3;
        double x = 0, y = 0;  // at the start
    };
    static constexpr int size = 2;  // x y
    template <class Real> struct Parameters { Real a, b; };

    template <class Real> SLIDEWAY_FN static void step(Real const* s, Parameters<Real> const& p, Real* next) {
        Real const x = s[0];
        next[0] = fnma(p.a * x, x, Real(1.0)) + s[1];
        next[1] = p.b * x;
    }

    SLIDEWAY_HD static Parameters<double> parameters(Inputs const& in) { return {in.a, in.b}; }
    SLIDEWAY_HD static void initial_state(Inputs const& in, double* s) { s[0] = in.x, s[1] = in.y; }
};

}  // namespace slideway::inline SLIDEWAY_ISA
