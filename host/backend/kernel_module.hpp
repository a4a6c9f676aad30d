// The border between the program and a module of kernels: a shared object with the machine code of one instruction set, which the program opens
// when a scene first asks for it (kernel_modules.cpp), so that who does not ask need not compile it.
#pragma once

#include "host/backend/mechanism_kernels.hpp"

namespace slideway {

/// What a module says of itself.  It exports one function, `kernel_module_entry`, which returns this.
struct KernelModule {
    // Of every version, so that a program can say why it refuses one.
    int interface = 0;              // kernel_interface of its sources
    char const* sources = nullptr;  // SLIDEWAY_KERNEL_SOURCES, and what compiled them
    // Of this interface.
    MechanismKernels const* kernels = nullptr;
};

inline constexpr int kernel_interface = 1;
inline constexpr char const* kernel_module_entry = "slideway_kernel_module";
using KernelModuleEntry = KernelModule const*();

}  // namespace slideway
