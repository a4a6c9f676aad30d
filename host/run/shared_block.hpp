// One block for several threads, of runs too small to be cut into blocks.
#pragma once

#include <cstddef>

#include "host/backend/backend.hpp"

namespace slideway {

/// The kernel run by several threads at once on one block: each has packs of its own and takes the next member when a lane falls free, so
/// that lanes idle once, at the end of the run, and not at the end of every thread's blocks.  No more threads than fill a pack each.
/// What the kernel throws in one of them ends the block in all, and is thrown again.
/// @param lanes of a pack  @param kernel from several threads
BlockKernel shared_by_threads(BlockKernel kernel, int threads, std::size_t lanes);

}  // namespace slideway
