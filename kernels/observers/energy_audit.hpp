#pragma once

#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// The energies of a member over its run [J], model.md 8.  What the method made is known step by step: see
/// SliderObserver::audit_step.
template <class Real> struct EnergyAudit {
    Real change;          // E(t) − E(0)
    Real drive_work;      // W
    Real friction_loss;   // D_f
    Real damping_loss;    // D_d
    Real load_work;       // W_l + W_g
    Real spring_loss;     // D_s
    Real film_loss;       // D_o
    Real turnover;        // ∫(|F_A · v_A| + |power of loads| + |power of the ground|) dt
    Real stored;          // largest potential of contacts, springs and stops
    Real made;            // by the method, not by the law
    Real astray;          // Σ |made| of the steps
    Real exchanged;       // Σ |work on the contacts' springs| of the steps
    Real energy = Real(0.0);  // |E|, of start and end the larger

    /// ε, what the contact law and the method made (or lost, if negative).
    SLIDEWAY_FN Real residual() const { return change - drive_work + friction_loss + damping_loss - load_work + spring_loss + film_loss; }
};

/// Members whose method left its stable range, by the energy that it made itself; NaN tells it too.  Two signs:
/// - In sum it made more than a fifth of what contacts, springs and stops damped and stored, plus a fiftieth of what friction and the oil film burnt, a
///   thousandth of what crank and loads moved (the error of gliding and of free flight), and 1e-8 of the energy itself (what tolerance and rounding leave of
///   a flywheel's).  Losses of the wrong sign excuse nothing.
/// - It does not resolve its contacts: of what went through their springs more than an eighth went astray in the single steps, gains and
///   losses alike, and that is more than half of the first bound.
/// How close runs came to these bounds, and how far beyond unstable ones lie: stability.md.
/// @param smallest M (c ω)², the audit's absolute tolerance is relative to it [J]
template <class Real> SLIDEWAY_FN Mask<Real> left_stable_range(EnergyAudit<Real> const& audit, Real smallest) {
    Real const zero(0.0);
    Real const contact = (max(zero, audit.damping_loss) + max(zero, audit.spring_loss)) + (audit.stored + smallest);  // in this order NaN stays
    Real const moved = fma(Real(0.001), audit.turnover, Real(1e-8) * audit.energy);
    Real const carried = fma(Real(0.02), max(zero, audit.friction_loss) + max(zero, audit.film_loss), moved);
    Real const bound = fma(Real(0.2), contact, carried);
    auto const balanced = abs(audit.made) <= bound;
    auto const resolved = audit.astray <= max(Real(0.125) * audit.exchanged, Real(0.5) * bound);
    return !(balanced & resolved);
}

}  // namespace slideway::inline SLIDEWAY_ISA
