// What one evaluation of the derivative costs, counted by running it on a number that counts.
#pragma once

#include <cstddef>

#include "kernels/inputs.hpp"

namespace slideway {

/// Useful flops of the lean derivative at some states, all together (counted_real.hpp says what counts).  Friction on, aligned way; of
/// restitution there are none.
/// @param members their initial state is the state to evaluate  @param times [count] [s]
unsigned long long derivative_flops(Law law, Damping damping, Inputs const* members, double const* times,
                                    std::size_t count);

}  // namespace slideway
