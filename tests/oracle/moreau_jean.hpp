// The rigid planar slider-crank by time stepping (Moreau's midpoint rule, J. J. Moreau 1988; M. Jean 1999): equal steps that look for no events, first order.
// A third route to the same motion, apart from the kernels and from rigid_block.hpp.
#pragma once

#include <kernels/inputs.hpp>
#include <vector>

#include "planar.hpp"

namespace oracle {

/// States at each of `count` multiples of `every` [s], the start first.  @param step [s], a whole fraction of `every`
std::vector<PlanarState> moreau_jean_run(slideway::Inputs const& completed, slideway::Parts const& parts, long double every, int count, long double step);

}  // namespace oracle
