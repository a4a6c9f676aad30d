#pragma once

#include "kernels/real.hpp"
#include "kernels/rigid/pair_problem.hpp"
#include "kernels/rigid/rigid_scales.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Lanes where two contacts hit their walls in turn, ever sooner and without end, the next time at once: each impact throws the other contact against its
/// wall before the first has gone far.  With x the speed of the one that leaves over that of the one that comes, an impact makes of it
///   x ← e/((1 + e) ρ − x),   ρ = −G_ij/G_ii of the contact i that is hit,                                                  (M13.8)
/// and the turns end where the denominator is not positive.  Without end the speeds fall to nothing, but in no time.
/// @param drag friction over the normal force as both slip now  @param depth of both, below 0 apart [m]  @param soon what counts as at once [s]
template <class Real>
SLIDEWAY_HD Mask<Real> rattles_without_end(Mask<Real> in, ContactPair<Real> const& pair, PairOf<Real> const& motion, Real const (&drag)[2],
                                           Real const (&depth)[2], Real e, Real soon) {
    Real const zero(0.0), one(1.0);
    Real thrown[2];  // (1 + e) ρ of an impact at each
    for (int i = 0; i < 2; ++i) {
        Real const other = fnma(drag[i], pair.nt[1 - i][i], pair.nn[1 - i][i]), own = fnma(drag[i], pair.nt[i][i], pair.nn[i][i]);
        thrown[i] = negated(other) / own * (one + e);
    }
    auto const first_comes = motion.normal[0] < motion.normal[1];
    auto const of_coming = [&](Real first, Real second) { return select(first_comes, first, second); };
    Real const comes = negated(of_coming(motion.normal[0], motion.normal[1])), leaves = of_coming(motion.normal[1], motion.normal[0]);
    Real const gap = max(negated(of_coming(depth[0], depth[1])), zero);
    auto const at_once = (comes > zero) & (leaves >= zero) & (gap <= soon * comes);
    // The product of two impacts has two real factors by which speeds change, or its turns end.
    Mask<Real> goes_on = in & at_once & (e < one) & (thrown[0] * thrown[1] > Real(4.0) * e);
    Real x = leaves / select(goes_on, comes, one);
    for (int i = 0; i < rattles_tried && any(goes_on); ++i) {
        bool const even = i % 2 == 0;
        Real const left = of_coming(thrown[even ? 0 : 1], thrown[even ? 1 : 0]) - x;
        goes_on = goes_on & (left > zero);
        x = e / select(goes_on, left, one);
    }
    return goes_on;
}

}  // namespace slideway::inline SLIDEWAY_ISA
