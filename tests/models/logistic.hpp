#pragma once

#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// The logistic map x ← r x (1 − x).  Source: May, Nature 261 (1976) 459–467, equation 3.  Dimensionless; every x has an image.
struct Logistic {
    struct Inputs {
        double r = 4;
        double x = 0.3;  // at the start
    };
    static constexpr int size = 1;  // x
    template <class Real> struct Parameters { Real r; };

    template <class Real> SLIDEWAY_FN static void step(Real const* s, Parameters<Real> const& p, Real* next) {
        next[0] = p.r * (s[0] * (Real(1.0) - s[0]));
    }

    SLIDEWAY_HD static Parameters<double> parameters(Inputs const& in) { return {in.r}; }
    SLIDEWAY_HD static void initial_state(Inputs const& in, double* s) { s[0] = in.x; }
};

}  // namespace slideway::inline SLIDEWAY_ISA
