#include "laws.hpp"

#include <algorithm>
#include <boost/math/special_functions/lambert_w.hpp>
#include <cmath>

namespace oracle::detail {
namespace {

/// x = P/(π E* l), solved from δ̄ = x (1 - ln(x R_e/l²)) by the branch that vanishes with δ̄.
Real line_strain(Inputs const& in, Real length, Real approach) {
    Real const reduced = approach * in.edge_radius / (length * length);
    if (!(reduced <= 1)) return nan;
    if (reduced == 1) return approach;  // W₋₁(-1/e) = -1, where rounding could leave the domain
    return -approach / lower_lambert_w(-reduced / std::exp(Real(1)));
}

/// a(1+e) - ln[(1+a)/(1-ea)] with q = -ln(1-ea), which keeps digits where a comes close to 1/e.
Real restitution_excess(Real e, Real q) {
    Real const a = -std::expm1(-q) / e;
    if (a > 0.01L) return a * (1 + e) - std::log1p(a) - q;
    // The logarithms' leading terms cancel: a²(1-e²)/2 - a³(1+e³)/3 + a⁴(1-e⁴)/4 - ...
    Real total = 0;
    for (int k = 12; k >= 2; --k) {
        Real const sign = k % 2 == 0 ? 1 : -1;
        Real const even = k % 2 == 0 ? -std::expm1(k * std::log(e)) : 1 + std::pow(e, k);
        total += sign * std::pow(a, k) * even / k;
    }
    return total;
}

}  // namespace

Real lower_lambert_w(Real x) { return boost::math::lambert_wm1(x); }

Real contact_modulus(Inputs const& in) {
    Real const nu1 = in.slider_poisson_ratio, nu2 = in.way_poisson_ratio;
    return 1 / ((1 - nu1 * nu1) / in.slider_young_modulus + (1 - nu2 * nu2) / in.way_young_modulus);
}

Real point_stiffness(Inputs const& in) {
    if (!std::isnan(in.point_stiffness)) return in.point_stiffness;
    return Real(4) / 3 * contact_modulus(in) * std::sqrt(Real(in.apex_radius));
}

Real line_force(Inputs const& in, Real length, Real approach) {
    return pi * contact_modulus(in) * length * line_strain(in, length, approach);
}

Real line_energy(Inputs const& in, Real length, Real approach) {
    Real const x = line_strain(in, length, approach);
    return pi * contact_modulus(in) * length * x * x * (1 - 2 * std::log(x * in.edge_radius / (length * length))) / 4;
}

Real friction_value(Inputs const& in, Real speed) {
    Real const s = in.friction_static, d = in.friction_kinetic;
    Real const stick = in.friction_stick_speed, slip = in.friction_slip_speed;
    if (speed < stick) return s * std::sin(pi * speed / (2 * stick));
    if (speed > slip) return d;
    return (s + d) / 2 + (s - d) / 2 * std::cos(pi * (speed - stick) / (slip - stick));
}

Real slope_of_restitution(Real e) {
    if (e >= 1) return 0;
    Real const near_one = 3 * (1 - e * e) / (2 * (1 + e * e * e));  // root of the first two terms above
    Real low = -std::log1p(-e * std::min(near_one / 8, 1 / (2 * e))), high = (1 + e) / e;
    for (int i = 0; i < 120; ++i) {
        Real const middle = (low + high) / 2;
        (restitution_excess(e, middle) > 0 ? low : high) = middle;
    }
    return -std::expm1(-(low + high) / 2) / e;
}

}  // namespace oracle::detail
