// The rigid planar slider-crank by time stepping (Moreau's midpoint rule, J. J. Moreau 1988; M. Jean 1999): equal steps that look for no events, first order.
// A third route to the same motion, apart from the kernels and from rigid_block.hpp.
#pragma once

#include <kernels/inputs.hpp>
#include <vector>

#include "planar.hpp"

namespace oracle {

/// Where the forces that depend on rates have them from: the step's start, or as they would be in its middle without contacts.
enum class MoreauJeanRates { of_start, of_middle };

/// States at each of `count` multiples of `every` [s], the start first.  @param step [s], a whole fraction of `every`
std::vector<PlanarState> moreau_jean_run(slideway::Inputs const& completed, slideway::Parts const& parts, long double every, int count, long double step,
                                         MoreauJeanRates rates = MoreauJeanRates::of_start);

}  // namespace oracle
