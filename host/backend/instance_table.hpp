#pragma once

#include "kernels/block.hpp"

namespace slideway {

/// The machine code of one kernel instance.
struct KernelInstance {
    void (*run)(Block&) = nullptr;
    void (*run_shadowed)(Block&) = nullptr;  // members with shadows
    void (*probe)(ProbeTable const&) = nullptr;
};

/// Instances of one instruction set, law and damping: [friction][misaligned way].
struct InstanceTable {
    KernelInstance at[2][2];
};

}  // namespace slideway
