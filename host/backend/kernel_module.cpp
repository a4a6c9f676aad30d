// What makes a module of the kernels of a unit (CMakeLists.txt here), whose table is SLIDEWAY_ISA::SLIDEWAY_TABLE.
#include "host/backend/kernel_module.hpp"

#include "host/backend/kernel_sources.hpp"

namespace slideway::SLIDEWAY_ISA {
extern MechanismKernels const SLIDEWAY_TABLE;
}

extern "C" __attribute__((visibility("default"))) slideway::KernelModule const* slideway_kernel_module() {
    static constexpr slideway::KernelModule module{slideway::kernel_interface, SLIDEWAY_KERNEL_SOURCES, &slideway::SLIDEWAY_ISA::SLIDEWAY_TABLE};
    return &module;
}
