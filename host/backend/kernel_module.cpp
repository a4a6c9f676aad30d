// What makes a module of the kernels of a unit (CMakeLists.txt here), whose table is SLIDEWAY_ISA::SLIDEWAY_TABLE: a LawKernels where
// SLIDEWAY_TABLE_OF_LAW is 1, else a MechanismKernels.
#include "host/backend/kernel_module.hpp"

#include <xsimd/config/xsimd_config.hpp>

#include "host/backend/kernel_sources.hpp"

#ifdef __clang__
#define SLIDEWAY_COMPILER __VERSION__
#else
#define SLIDEWAY_COMPILER "g++ " __VERSION__
#endif

#define SLIDEWAY_TEXT(word) SLIDEWAY_TEXT_OF(word)
#define SLIDEWAY_TEXT_OF(word) #word

// Packs cross the border.
static constexpr int xsimd_of_the_program[] = {SLIDEWAY_KERNEL_XSIMD};
static_assert(XSIMD_VERSION_MAJOR == xsimd_of_the_program[0] && XSIMD_VERSION_MINOR == xsimd_of_the_program[1] && XSIMD_VERSION_PATCH == xsimd_of_the_program[2],
              "xsimd is of another version than that which slideway was compiled with");

namespace slideway::SLIDEWAY_ISA {
#if SLIDEWAY_TABLE_OF_LAW
extern LawKernels const SLIDEWAY_TABLE;
#else
extern MechanismKernels const SLIDEWAY_TABLE;
#endif
}  // namespace slideway::SLIDEWAY_ISA

// Of a law or mechanism of one's own slideway compile says the hash of its source.
#ifdef SLIDEWAY_SOURCE_HASH
static constexpr char const *sources = SLIDEWAY_KERNEL_BORDER, *source = SLIDEWAY_SOURCE_HASH;
#else
static constexpr char const *sources = SLIDEWAY_KERNEL_SOURCES, *source = "";
#endif

extern "C" __attribute__((visibility("default"))) slideway::KernelModule const* slideway_kernel_module() {
    static constexpr slideway::KernelModule module{
        .interface = slideway::kernel_interface,
        .sources = sources,
        .compiler = SLIDEWAY_COMPILER,
        .source = source,
        .isa = SLIDEWAY_TEXT(SLIDEWAY_ISA),
#if SLIDEWAY_TABLE_OF_LAW
        .law = &slideway::SLIDEWAY_ISA::SLIDEWAY_TABLE,
#else
        .mechanism = &slideway::SLIDEWAY_ISA::SLIDEWAY_TABLE,
#endif
    };
    return &module;
}
