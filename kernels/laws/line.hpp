#pragma once

#include <limits>

#include "kernels/math/lambert_w.hpp"
#include "kernels/math/logarithm.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// A line contact of one length between two given materials.
template <class Real> struct LineContact {
    Real scale;        // π E* l [N/m]
    Real radius_rate;  // R_e/l² [1/m], the reciprocal of the largest approach
};

template <class Real> struct LineLoad {
    Real load;       // P [N]
    Real potential;  // V [J]
    Mask<Real> outside;
};

/// Load of a line contact of length l at approach δ.  δ = x (1 − ln(x R/l²)), x = P/(π E* l), hence
/// P = −π E* l δ / W₋₁(−δ R/(exp(1) l²)).  Source: Qian et al. 2020 (9)–(14); the print does not name the branch, W₋₁ is the
/// one whose load vanishes with δ.  With w = −W₋₁ the stored energy is V = ∫P dδ = π E* l x² (1 − 2 ln(x R/l²))/4 =
/// P x (2w − 1)/4, since ln(x R/l²) = 1 − w.
/// @param approach δ [m], 0 < δ ≤ l²/R.  @return NaN load and `outside` beyond it.
template <class Real> SLIDEWAY_FN LineLoad<Real> line_load(Real approach, LineContact<Real> const& line) {
    Real const u = approach * line.radius_rate;
    auto const outside = !(u <= Real(1.0));
    // Below 1e-32 of its domain the load is nil in double precision; the logarithm needs a normal number.
    Real const inside = min(max(u, Real(1e-32)), Real(1.0));
    auto w = minus_lambert_wm1_exp(negated(log_positive(inside)));
    Real const x = approach * w.denominator / w.numerator;
    Real const load = select(outside, Real(std::numeric_limits<double>::quiet_NaN()), line.scale * x);
    // P x (2w − 1)/4 with x w = δ.
    return {load, load * Real(0.25) * (approach + approach - x), outside};
}

}  // namespace slideway::inline SLIDEWAY_ISA
