#pragma once

#include "kernels/block.hpp"

namespace slideway {

/// The machine code of one kernel instance.
struct KernelInstance {
    void (*run)(Block&) = nullptr;
    void (*run_shadowed)(Block&) = nullptr;  // members with shadows; none of a mechanism that has no exponents
    void (*probe)(ProbeTable const&) = nullptr;
};

/// Instances of one instruction set, law and damping: [mechanism][friction][misaligned way], of the mechanisms with a joint of faces, which
/// come first.
struct InstanceTable {
    KernelInstance at[3][2][2];
};

/// Instances of the planar mechanism of one instruction set: [restitution][friction][free crank].
struct PlanarInstances {
    KernelInstance at[2][2][2];
};

}  // namespace slideway
