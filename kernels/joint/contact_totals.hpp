#pragma once

#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// What the contacts of a state come to.
template <class Real> struct ContactTotals {
    Real surfaces, lines, points;  // how many
    Real potential;                // U of the contacts [J]
    Real friction_power;           // Σ μ F V [W]
    Real damping_power;            // Σ (F − F_elastic) δ' [W]
    Real elastic_power;            // Σ F_elastic δ' [W], what the springs take up: U' unless a mode switches

    SLIDEWAY_FN void clear_totals() {
        surfaces = lines = points = potential = friction_power = damping_power = elastic_power = Real(0.0);
    }
};

}  // namespace slideway::inline SLIDEWAY_ISA
