#pragma once

#include "kernels/grid_task.hpp"

namespace slideway::testing {

/// What one thread of a grid does: the lane program of slider-cranks under any law of the list, as host/backend/cuda.cu compiles it for
/// cards, here for the processor.  Takes a machine that `Isa::scalar` takes, and has its bits.
/// @param shadowed members have shadows
void run_grid_thread(GridTask const& task, bool shadowed);

}  // namespace slideway::testing
