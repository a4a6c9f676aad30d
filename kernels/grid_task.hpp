// The border between host and the threads of a grid: what they share, as plain views of memory that the host owns.
#pragma once

#include <cstdint>

#include "kernels/block.hpp"
#include "kernels/inputs.hpp"

namespace slideway {

/// What the threads of a grid write together.
struct GridState {
    std::uint64_t taken = 0;  // members of the block's queue
    std::uint64_t lane_steps_executed = 0;
    std::uint64_t lane_steps_useful = 0;
};

/// The work of a grid.
struct GridTask {
    Block block;  // `taken` and the counts of steps are the threads' own
    GridState* state = nullptr;
    Parts parts;  // of the scene: whose equations the kernel is to take
};

}  // namespace slideway
