// Elastic forces of single contacts together with their stiffness: point.hpp and line.hpp, differentiated.
#pragma once

#include "kernels/laws/line.hpp"
#include "kernels/laws/point.hpp"
#include "kernels/math/exponential.hpp"
#include "kernels/math/lambert_w.hpp"
#include "kernels/math/logarithm.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Elastic force of a contact [N] and its derivative by the penetration [N/m].
template <class Real> struct ElasticSlope { Real load, slope; };

/// K δⁿ and n K δⁿ⁻¹ for δ > 0 [m]; as in point_load, the general power runs only where a lane's exponent is not 3/2.
template <class Real> SLIDEWAY_FN ElasticSlope<Real> point_stiffness(Real depth, PointContact<Real> const& point) {
    Real const hertz = sqrt(depth);
    auto const general = point.exponent != Real(1.5);
    Real const raised =
        any(general) ? select(general, power(depth, point.exponent - Real(1.0)), hertz) : hertz;  // δⁿ⁻¹
    Real const stiffness = point.stiffness * raised;
    return {stiffness * depth, point.exponent * stiffness};
}

/// Load of a line contact and its stiffness.  δ = x w with w = −W₋₁ = 1 − ln(x R/l²) gives dδ/dx = w − 1, hence
/// dP/dδ = π E* l/(w − 1).  Source: Qian et al. 2020 (9)–(14), as in line_load.
/// @param approach δ [m], 0 < δ ≤ l²/R; NaN beyond.  At its end w = 1 and the stiffness is infinite: w − 1 is held at 1e-6.
template <class Real> SLIDEWAY_FN ElasticSlope<Real> line_stiffness(Real approach, LineContact<Real> const& line) {
    Real const u = approach * line.radius_rate;
    Real const scale = select(u <= Real(1.0), line.scale, Real(not_a_number));
    Real const inside = min(max(u, Real(1e-32)), Real(1.0));
    auto const w = minus_lambert_wm1_exp(negated(log_positive(inside)));
    // 1/w and 1/(w − 1) by one division.
    Real const excess = max(w.numerator - w.denominator, Real(1e-6) * w.denominator);
    Real const common = scale * w.denominator / (w.numerator * excess);
    return {approach * common * excess, common * w.numerator};
}

}  // namespace slideway::inline SLIDEWAY_ISA
