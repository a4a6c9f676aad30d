#pragma once

#include "kernels/real.hpp"
#include "kernels/rigid/pair_problem.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Energy that impulses make [J]: ½ (γ_before + γ_after) · Λ.
template <class Real>
SLIDEWAY_FN Real energy_made(PairOf<Real> const& before, PairOf<Real> const& after, PairOf<Real> const& impulse) {
    Real sum(0.0);
    for (int i = 0; i < 2; ++i) {
        sum = fma(before.normal[i] + after.normal[i], impulse.normal[i], sum);
        sum = fma(before.along[i] + after.along[i], impulse.along[i], sum);
    }
    return Real(0.5) * sum;
}

/// Size of what they move [J], against which rounding is to be seen.
template <class Real> SLIDEWAY_FN Real energy_moved(PairOf<Real> const& before, PairOf<Real> const& impulse) {
    Real sum(0.0);
    for (int i = 0; i < 2; ++i) {
        sum = fma(abs(before.normal[i]), abs(impulse.normal[i]), sum);
        sum = fma(abs(before.along[i]), abs(impulse.along[i]), sum);
    }
    return sum;
}

/// Takes as much from the impulses Λ as it needs for them to make no energy: the largest κ ≤ 1 of Λ₀ + κ (Λ − Λ₀), Λ₀ being those without
/// restitution, which make none (M13.7).  Both obey Coulomb's cone, which is convex, and so does what lies between.
template <class Real>
SLIDEWAY_HD void limit_energy(Mask<Real> in, ContactPair<Real> const& pair, PairOf<Real> const& before, PairOf<Real> const& dead,
                              PairOf<Real>& impulse) {
    Real const zero(0.0), one(1.0);
    PairOf<Real> more, nothing;
    for (int i = 0; i < 2; ++i) {
        more.normal[i] = impulse.normal[i] - dead.normal[i];
        more.along[i] = impulse.along[i] - dead.along[i];
        nothing.normal[i] = nothing.along[i] = zero;
    }
    // With γ₀ after Λ₀ the energy is a κ² + b κ + c: a = ½ ΔΛ G ΔΛ ≥ 0, b = γ₀ ΔΛ, c ≤ 0.
    auto const after = pair.after(before, dead);
    Real const a = energy_made(nothing, pair.after(nothing, more), more);
    Real const b = energy_made(after, after, more), c = min(energy_made(before, after, dead), zero);
    Real const root = sqrt(max(fnma(Real(4.0) * a, c, b * b), zero));
    auto const curved = a > zero;
    Real const share = select(curved, (root - b) / select(curved, a + a, one), zero);
    Real const kept = min(max(share, zero), one);
    for (int i = 0; i < 2; ++i) {
        impulse.normal[i] = select(in, fma(kept, more.normal[i], dead.normal[i]), impulse.normal[i]);
        impulse.along[i] = select(in, fma(kept, more.along[i], dead.along[i]), impulse.along[i]);
    }
}

}  // namespace slideway::inline SLIDEWAY_ISA
