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

/// What a run of `time` gives a residual to be measured against.
template <class Real> struct EnergyScales {
    Real smallest;      // M (c ω)², of the audit's absolute tolerance [J]
    Real crossing;      // M a c, energy of a slider that falls through the clearance under a = g + r ω² [J]
    Real crossing_time; // √(c/a) [s], infinite at a = 0
};

/// Members whose residual no method leaves that is in its stable range; NaN counts among them.  How the bounds were found, and which runs
/// came how close: docs/stability.md.
/// A conserving law leaves ε to the method alone.  A tenth of what friction, damping and contact turned over is four times what an
/// adaptive method left at a tolerance of 1e-3, and a thousandth of the crank's turnover is where free flight ends up.
/// A law that switches modes makes energy at every crossing of the clearance, up to half of this bound: as much as the crank
/// moved, plus the largest contact's, plus M a c for each crossing.
template <bool conserving, class Real>
SLIDEWAY_FN Mask<Real> left_stable_range(EnergyAudit<Real> const& audit, EnergyScales<Real> const& scale, Real time) {
    Real bound;
    if constexpr (conserving) {
        Real const lateral = (audit.friction_loss + abs(audit.damping_loss)) + (audit.stored + scale.smallest);
        bound = fma(Real(0.1), lateral, Real(0.001) * audit.crank_turnover);
    } else {
        Real const crossings = Real(1.0) + time / scale.crossing_time;
        bound = fma(scale.crossing, crossings, (audit.crank_turnover + audit.stored) + scale.smallest);
    }
    return !(abs(audit.residual()) <= bound);
}

}  // namespace slideway::inline SLIDEWAY_ISA
