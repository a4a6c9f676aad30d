// The right-hand side of one instruction set, as the benchmark calls it.  Plain data: units built for different instruction sets
// share no code.
#pragma once

#include <cstddef>
#include <cstdint>

#include "kernels/inputs.hpp"

namespace slideway {

/// One law; friction on, aligned way, point damping.
struct RhsKernel {
    int lanes;
    std::size_t pack_bytes;  // of one pack's parameters, state and results; 64-byte alignment
    /// Fills packs from members, whose number is a multiple of `lanes`.
    void (*load)(void* packs, Inputs const* members, double const* times, std::size_t count);
    /// Evaluates every pack `in_a_row` times, the whole `passes` times over; [1] is the variant that fills the report.
    void (*evaluate[2])(void* packs, std::size_t count, int in_a_row, int passes);
};

struct RhsKernels {
    RhsKernel paper, conservative;
};

/// Each instruction set's namespace has one, `rhs_kernels`; the counting number's has `operations` too, done so far.
using RhsKernelMaker = RhsKernels();
using OperationCounter = std::uint64_t();

}  // namespace slideway
