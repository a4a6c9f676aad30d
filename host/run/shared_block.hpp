// One block for several threads, of runs too small to be cut into blocks.
#pragma once

#include <cstddef>
#include <utility>

#include "host/backend/backend.hpp"

namespace slideway {

/// A kernel run by several threads at once on one block: each has packs of its own and takes the next member when a lane falls free, so
/// that lanes idle once, at the end of the run, and not at the end of every thread's blocks.  No more threads than fill a pack each.
/// A process that is killed loses the block it works on: one that would take long is given up early, for the run to be cut into blocks.
class SharedBlockKernel {
public:
    /// When a block is given up [s]: the time after which the whole is predicted from what is covered then, and the longest that it may take.
    struct TimeLimits {
        double trial = 1, most = 20;
    };

    /// @param lanes of a pack  @param kernel from several threads
    SharedBlockKernel(BlockKernel kernel, int threads, std::size_t lanes, TimeLimits limits)
        : kernel_(std::move(kernel)), threads_(threads), lanes_(lanes), limits_(limits) {}

    /// @return whether the block was given up.  @throws what the kernel throws in one of the threads; that ends the block in all
    bool run(Block& block) const;

private:
    BlockKernel const kernel_;
    int const threads_;
    std::size_t const lanes_;
    TimeLimits const limits_;
};

}  // namespace slideway
