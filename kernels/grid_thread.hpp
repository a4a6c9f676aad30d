#pragma once

#include "kernels/grid_task.hpp"
#include "kernels/real.hpp"
#include "kernels/simd/expect.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// What one thread of a grid does: it takes members from the queue that all share, one after the other, and integrates each to its
/// end, until none is left.  Who takes which member does not matter, for a member's result depends on its own inputs only; the
/// counts of steps are whole numbers, whose sum has no order.
/// @param integrate the lane program of one lane (kernels/integrate.hpp), called with the block.
template <class Integrate> SLIDEWAY_HD void run_thread(GridTask const& task, Integrate const& integrate) {
    SLIDEWAY_EXPECT(task.state != nullptr);
    Block block = task.block;
    GridState& state = *task.state;
    block.taken = &state.taken;
    block.lane_steps_executed = block.lane_steps_useful = 0;
    integrate(block);
    fetch_add(state.lane_steps_executed, block.lane_steps_executed);
    fetch_add(state.lane_steps_useful, block.lane_steps_useful);
}

}  // namespace slideway::inline SLIDEWAY_ISA
