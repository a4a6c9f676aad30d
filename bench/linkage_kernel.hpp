// The right-hand side of the planar slider-crank of one instruction set: by its own kernel, and as a linkage, whose plan is looked up or a constant.
#pragma once

#include <cstddef>

#include "kernels/inputs.hpp"

namespace slideway {

/// One of the three ways; with friction and restitution.
struct LinkageKernel {
    int lanes;
    std::size_t pack_bytes;  // of one pack's parameters, state and results; 64-byte alignment
    /// Fills packs with members in states of six components, `count` a multiple of `lanes`.
    void (*load)(void* packs, Parts const& parts, Inputs const* members, double const* states, std::size_t count);
    /// Evaluates every pack `in_a_row` times.
    void (*evaluate)(void* packs, Parts const& parts, std::size_t count, int in_a_row);
};

struct LinkageKernels {
    LinkageKernel planar, tables, compiled;
    LinkagePlan const* plan;  // the constant one
};
using LinkageKernelMaker = LinkageKernels();  // each instruction set's namespace has one, `linkage_kernels_of_bench`

}  // namespace slideway
