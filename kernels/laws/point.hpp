#pragma once

#include "kernels/math/exponential.hpp"
#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// A point contact: F = K δⁿ + C δ δ'.  Source: Qian et al. 2020 (16)–(18), with the two-body E* in K = 4/3 E* √R_p.
template <class Real> struct PointContact {
    Real stiffness;        // K [N/m^n]
    Real exponent;         // n
    Real damping;          // C = η K [N s/m²]
    Real potential_share;  // 1/(n + 1)
};

/// Elastic force K δⁿ [N] for δ > 0 [m].  Hertz's n = 3/2 needs no logarithm; the general power runs only where a lane has
/// another exponent, and changes no bit of those that do not.
template <class Real> SLIDEWAY_FN Real point_load(Real depth, PointContact<Real> const& point) {
    Real const hertz = depth * sqrt(depth);
    auto const general = point.exponent != Real(1.5);
    Real const raised = any(general) ? select(general, power(depth, point.exponent), hertz) : hertz;
    return point.stiffness * raised;
}

/// Elastic force of a contact [N] and its derivative by the penetration [N/m].
template <class Real> struct ElasticSlope { Real load, slope; };

/// K δⁿ and n K δⁿ⁻¹ for δ > 0 [m]; as in point_load, the general power runs only where a lane's exponent is not 3/2.
template <class Real> SLIDEWAY_FN ElasticSlope<Real> point_slope(Real depth, PointContact<Real> const& point) {
    Real const hertz = sqrt(depth);
    auto const general = point.exponent != Real(1.5);
    Real const raised =
        any(general) ? select(general, power(depth, point.exponent - Real(1.0)), hertz) : hertz;  // δⁿ⁻¹
    Real const stiffness = point.stiffness * raised;
    return {stiffness * depth, point.exponent * stiffness};
}

}  // namespace slideway::inline SLIDEWAY_ISA
