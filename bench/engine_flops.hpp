// What the engine's evaluations cost, counted by running each on a number that counts.
#pragma once

#include "kernels/block.hpp"

namespace slideway {

/// Integrates a block (friction on, as with an aligned way; not restitution), one member at a time and slowly.
/// @return useful flops of its right-hand sides and Jacobians, the former as without a report (counted_real.hpp says what counts)
unsigned long long counted_flops(Law law, Damping damping, Block& block);

}  // namespace slideway
