#pragma once

#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// The energies of a member over its run [J], docs/model.md 8.
template <class Real> struct EnergyAudit {
    Real change;          // E(t) − E(0)
    Real crank_work;      // W
    Real friction_loss;   // D_f
    Real damping_loss;    // D_d
    Real crank_turnover;  // ∫|F_A · v_A| dt
    Real stored;          // largest contact potential

    /// ε, what the contact law or the method made (or lost, if negative).
    SLIDEWAY_FN Real residual() const { return change - crank_work + friction_loss + damping_loss; }
};

/// What a residual is measured against beside the audit itself.
template <class Real> struct EnergyScales {
    Real smallest;       // M (c ω)², the audit's absolute tolerance is relative to it [J]
    Real crossing;       // M a c, what a slider gains on its way across the clearance under a = g + r ω² [J]
    Real crossing_time;  // √(c/a) [s], infinite at a = 0
};

/// Members whose residual tells that their method left its stable range; NaN tells it too.
/// A conserving law leaves ε to the method alone, and a stable one keeps it below a fifth of what friction, damping and contact
/// turned over, plus a thousandth of what the crank moved (the error in free flight).
/// A law that switches modes makes energy itself, some at every crossing of the clearance: below M a c for each crossing, plus what the
/// crank moved, plus the largest contact's.
/// How close runs came to these bounds, and how far beyond unstable ones lie: docs/stability.md.
/// @tparam conserving of the law.  @param time [s] of the run.
template <bool conserving, class Real>
SLIDEWAY_FN Mask<Real> left_stable_range(EnergyAudit<Real> const& audit, EnergyScales<Real> const& scale, Real time) {
    Real bound;
    if constexpr (conserving) {
        Real const lateral = (audit.friction_loss + abs(audit.damping_loss)) + (audit.stored + scale.smallest);
        bound = fma(Real(0.2), lateral, Real(0.001) * audit.crank_turnover);
    } else {
        Real const crossings = Real(1.0) + time / scale.crossing_time;
        bound = fma(scale.crossing, crossings, (audit.crank_turnover + audit.stored) + scale.smallest);
    }
    return !(abs(audit.residual()) <= bound);
}

}  // namespace slideway::inline SLIDEWAY_ISA
