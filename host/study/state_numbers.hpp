// The numbers of a mechanism's state, and the inputs with which a member starts in it.
#pragma once

#include <array>

#include "host/scene/descriptors.hpp"

namespace slideway {

using StateNumbers = std::array<double, most_states>;  // the first `info(mechanism).states` count

/// The state in which a member starts.  Of the planar mechanism the rod's angle θ2 and its rate follow from the slider's:
/// y = r sin θ1 + L sin θ2.  @param inputs complete
StateNumbers start_of(Mechanism mechanism, Inputs const& inputs);

/// Makes a member start in a state.  The planar rod is to point along the way: |θ2| < π/2.
void set_start(Mechanism mechanism, StateNumbers const& state, Inputs& inputs);

}  // namespace slideway
