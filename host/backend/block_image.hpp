// One piece of memory with all that a block reads and writes: how a block travels to a card and back.
#pragma once

#include <cstddef>

#include "kernels/grid_task.hpp"

namespace slideway {

/// Bytes of an image.  What the threads leave behind lies at the end: of the way back it is all.
struct ImageSize {
    std::size_t total = 0;
    std::size_t results_at = 0;  // offset
};

/// Of the block's arrays, whatever they hold.
ImageSize image_size(Block const& block);

/// Copies the block's arrays into an image, results too: what a run does not write keeps its value.
void write_image(Block const& block, std::byte* image);

/// The work that the image holds, for who sees it at `address`: its pointers are not for the host unless that is where the image is.
GridTask task_in(Block const& block, Parts const& parts, std::byte* address);

/// Copies the results in an image to the block's arrays, and its counts of steps to the block.
void read_results(std::byte const* image, Block& block);

}  // namespace slideway
