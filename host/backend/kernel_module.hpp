// The border between the program and a module of kernels: a shared object with the machine code of one instruction set, which the program opens
// when a scene first asks for it, so that who does not ask need not compile it.  It may change with every version before 1.0.
#pragma once

#include "host/backend/kernel_tables.hpp"

namespace slideway {

/// What a module says of itself.  It exports one function, `kernel_module_entry`, which returns this.
struct KernelModule {
    // Of every version, so that a program can say why it refuses one.
    int interface = 0;               // kernel_interface of its sources
    char const* sources = nullptr;   // what both sides of the border must have alike (cmake/kernel_sources.cmake)
    char const* compiler = nullptr;  // that compiled it; any that keeps the border will do
    // Of this interface.
    char const* source = nullptr;    // hash of a source outside the tree; "" of the tree's own
    char const* isa = nullptr;       // the instruction set that it is compiled for
    MechanismKernels const* mechanism = nullptr;
    LawKernels const* law = nullptr;
};

inline constexpr int kernel_interface = 3;
inline constexpr char const* kernel_module_entry = "slideway_kernel_module";
using KernelModuleEntry = KernelModule const*();

}  // namespace slideway
