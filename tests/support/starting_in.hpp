// A member that starts in a given state.
#pragma once

#include <cstddef>
#include <iterator>

#include "kernels/inputs.hpp"

namespace slideway::testing {

/// These inputs with another start.  @param state of a spatial mechanism, in the order of the golden tables: ten numbers, or twelve with x and vx; the last two
/// are angle and speed of a crank, too
template <class State> Inputs starting_in(Inputs in, State const& state) {
    double* const places[] = {&in.y, &in.z, &in.vy, &in.vz, &in.roll, &in.yaw, &in.pitch, &in.wx, &in.wy, &in.wz, &in.x, &in.vx};
    for (std::size_t i = 0; i < std::size(state); ++i) *places[i] = static_cast<double>(state[i]);
    return in;
}

}  // namespace slideway::testing
