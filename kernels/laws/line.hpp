#pragma once

#include "kernels/laws/face.hpp"
#include "kernels/laws/point.hpp"
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

namespace detail {

/// t = −ln u of u = δ R/l², held in [1e-32, 1]: below, the load is nil in double precision, and the logarithm needs a normal number.
template <class Real> SLIDEWAY_FN Real line_exponent(Mask<Real> line, Real approach, LineContact<Real> const& contact) {
    if (none(line)) return Real(1.0);
    return negated(log_positive(min(max(approach * contact.radius_rate, Real(1e-32)), Real(1.0))));
}

template <class Real> SLIDEWAY_FN Ratio<Real> line_ratio(Mask<Real> line, Real exponent) {
    Real const one(1.0);
    if (none(line)) return {one, one};
    auto w = minus_lambert_wm1_exp(exponent);
    return {select(line, w.numerator, one), w.denominator};
}

template <class Real>
SLIDEWAY_FN LineLoad<Real> line_load(Mask<Real> line, Real approach, Real x, LineContact<Real> const& contact) {
    if (none(line)) return {Real(0.0), Real(0.0), mask_of<Real>(false)};
    auto const outside = !(approach * contact.radius_rate <= Real(1.0));
    Real const load = select(outside, Real(not_a_number), contact.scale * x);
    // P x (2w − 1)/4 with x w = δ.
    return {load, load * Real(0.25) * (approach + approach - x), outside};
}

}  // namespace detail

/// Loads of a face's four edges, in the order a–b, b–c, c–d, d–a.  A line of length l at approach δ: δ = x (1 − ln(x R/l²)),
/// x = P/(π E* l), hence P = −π E* l δ / W₋₁(−δ R/(exp(1) l²)).  Source: Qian et al. 2020 (9)–(14); the print does not name the
/// branch, W₋₁ is the one whose load vanishes with δ.  With w = −W₋₁ the stored energy is V = ∫P dδ = π E* l x² (1 − 2 ln(x R/l²))/4
/// = P x (2w − 1)/4, since ln(x R/l²) = 1 − w.
/// All four go through each stage together, for the chain of one is long; one division serves them all.
/// @param line where there is a line; elsewhere the load means nothing.
/// @param approach δ [m], 0 < δ ≤ l²/R; any finite number where there is no line.  @return NaN load and `outside` beyond.
template <class Real>
SLIDEWAY_FN Quad<LineLoad<Real>> line_loads(Quad<Mask<Real>> const& line, Quad<Real> const& approach,
                                            LineContact<Real> const& across, LineContact<Real> const& along) {
    Quad<Real> t{detail::line_exponent(line.a, approach.a, across), detail::line_exponent(line.b, approach.b, along),
                 detail::line_exponent(line.c, approach.c, across), detail::line_exponent(line.d, approach.d, along)};
    Quad<Ratio<Real>> w{detail::line_ratio(line.a, t.a), detail::line_ratio(line.b, t.b),
                        detail::line_ratio(line.c, t.c), detail::line_ratio(line.d, t.d)};
    auto inverse = reciprocals(Quad<Real>{w.a.numerator, w.b.numerator, w.c.numerator, w.d.numerator});
    return {detail::line_load(line.a, approach.a, approach.a * w.a.denominator * inverse.a, across),
            detail::line_load(line.b, approach.b, approach.b * w.b.denominator * inverse.b, along),
            detail::line_load(line.c, approach.c, approach.c * w.c.denominator * inverse.c, across),
            detail::line_load(line.d, approach.d, approach.d * w.d.denominator * inverse.d, along)};
}

/// The same of one edge, with the same bits as beside three without a line.
template <class Real>
SLIDEWAY_FN LineLoad<Real> line_load(Mask<Real> line, Real approach, LineContact<Real> const& contact) {
    auto w = detail::line_ratio(line, detail::line_exponent(line, approach, contact));
    return detail::line_load(line, approach, approach * w.denominator * (Real(1.0) / w.numerator), contact);
}

/// Load of a line contact and its stiffness.  δ = x w with w = −W₋₁ = 1 − ln(x R/l²) gives dδ/dx = w − 1, hence
/// dP/dδ = π E* l/(w − 1).  Source: Qian et al. 2020 (9)–(14), as in line_load.
/// @param approach δ [m], 0 < δ ≤ l²/R; NaN beyond.  At its end w = 1 and the stiffness is infinite: w − 1 is held at 1e-6.
template <class Real> SLIDEWAY_FN ElasticSlope<Real> line_slope(Real approach, LineContact<Real> const& line) {
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
