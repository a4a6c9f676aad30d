// How much memory this process may still take, where a limit says so (ulimit -v, RLIMIT_AS).
#pragma once

#include <cstdint>

namespace slideway {

/// [B] of address space that the process has mapped.
std::uint64_t mapped_bytes();

/// [B] that it may still map; the largest number where there is no limit.
std::uint64_t memory_room();

/// [B] that so many threads take before they do anything: their stacks, and what the C library keeps for each.
std::uint64_t bytes_of_threads(int threads);

/// Asked before libraries are that find no words for a lack of memory: they crash, end the process, or take a file for damaged.
/// @throws std::bad_alloc if there is less room
void require_memory(std::uint64_t bytes);

}  // namespace slideway
