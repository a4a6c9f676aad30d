#pragma once

#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// What a spring or a stop does along its line, or about its axis (model.md 14).
template <class Real> struct ElementPull {
    Real force;      // against the stretch of a spring, or the depth in a stop [N], [N m]
    Real potential;  // what it stores [J]
    Real loss;       // power of its damper [W]

    /// T0 + k (ℓ − ℓ0) + c ℓ'.
    SLIDEWAY_FN static ElementPull of_spring(Real stretch, Real rate, Real stiffness, Real damping, Real preload) {
        Real const tension = fma(damping, rate, fma(stiffness, stretch, preload));
        return {tension, stretch * fma(Real(0.5) * stiffness, stretch, preload), damping * (rate * rate)};
    }

    /// k δ (1 + χ δ') + c δ' where it is touched, and never a pull.
    SLIDEWAY_FN static ElementPull of_stop(Real depth, Real rate, Real stiffness, Real damping, Real dissipation) {
        Real const zero(0.0), one(1.0);
        auto const touches = depth > zero;
        Real const elastic = stiffness * depth;
        Real const damped = fma(elastic, fma(dissipation, rate, one), damping * rate);
        Real const push = select(touches, max(damped, zero), zero);
        return {push, select(touches, Real(0.5) * elastic * depth, zero), select(touches, (push - elastic) * rate, zero)};
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
