// Whether numbers of members differ by more than the error that each of them has.
#pragma once

#include <span>
#include <string>

#include "host/config/scene.hpp"
#include "host/store/result_layout.hpp"

namespace slideway {

/// Energy below which a number is taken as none [J]: a millionth (the default tolerance) of what a fall through the clearance gives
/// (fall_energy).  Energies are differences of ones of that size: where the true number is 0 (no friction, nothing that damps) what is
/// left is their rounding, and has no size of its own to be compared with.
double least_energy(Scene const& scene);

/// Error of a column's numbers, in its unit: 1e-6, the default tolerance, of the largest magnitude.  Of energies at least that share of a fall
/// through the clearance.
double error_of_column(QuantityColumn const& column, std::span<double const> values, Scene const& scene);

/// Why sensitivities of a column would be those of rounding: its standard deviation is no more than its numbers' error, or it is that
/// error (the energy residual of a law that makes no energy).  "" where it varies by more, or is not finite.
/// @param values of members; NaN are left out
std::string why_no_sensitivity(QuantityColumn const& column, std::span<double const> values, Scene const& scene);

}  // namespace slideway
