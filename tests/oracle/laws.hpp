// The laws of contact, friction and restitution, each of plain numbers.
#pragma once

#include "numbers.hpp"

namespace oracle::detail {

/// W₋₁, the branch below -1, as Boost has it.
Real lower_lambert_w(Real x);

/// E* [Pa]: 1/E* = (1 - ν1²)/E1 + (1 - ν2²)/E2.
Real contact_modulus(Inputs const& in);

/// K [N/mⁿ]: as given, else 4/3 E* √R_p.
Real point_stiffness(Inputs const& in);

/// Total load P [N] of a line of length l [m] at approach δ̄ [m]; NaN beyond l²/R_e.
Real line_force(Inputs const& in, Real length, Real approach);
/// Its potential V [J], ∂V/∂δ̄ = P.
Real line_energy(Inputs const& in, Real length, Real approach);

/// μ at the sliding speed |v_t| [m/s].
Real friction_value(Inputs const& in, Real speed);

/// a in the damping factor 1 + a h'/v0: the root in (0, 1/e) of a(1+e) = ln[(1+a)/(1-ea)]; 0 at e = 1.
Real slope_of_restitution(Real e);

}  // namespace oracle::detail
