// Functions of units that slideway_add_kernels() compiles, for the sources that call them: the widest that runs on the machine.
//
//     SLIDEWAY_KERNEL(void, run, (slideway::Block&))
//     slideway::run_kernel()(block);
#pragma once

#include <string_view>

#if __has_include("slideway_isas.hpp")
#include "slideway_isas.hpp"  // made by slideway_add_kernels()
#endif

namespace slideway {

/// Whether this machine runs code of an instruction set; scalar_libm only where nothing better does.
static inline bool runs_here(std::string_view isa) {
#if defined(__x86_64__)
    bool const avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    if (isa == "scalar_libm") return !avx2;
    if (isa != "avx512") return avx2;
    return avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512cd") &&
           __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl");
#else
    return !isa.empty();
#endif
}

}  // namespace slideway

#define SLIDEWAY_DECLARE_KERNEL(isa, Return, name, parameters) \
    namespace isa {                                            \
    Return name parameters;                                    \
    }
#define SLIDEWAY_CHOOSE_KERNEL(isa, name) \
    if (runs_here(#isa)) found = &isa::name;

/// Declares slideway::<isa>::name for each instruction set, and slideway::name_kernel(), the widest of them that runs here; nullptr if none does.
#define SLIDEWAY_KERNEL(Return, name, parameters)                                 \
    namespace slideway {                                                          \
    SLIDEWAY_FOR_EACH_ISA(SLIDEWAY_DECLARE_KERNEL, Return, name, parameters)      \
    static inline auto name##_kernel() {                                          \
        Return(*found) parameters = nullptr;                                      \
        SLIDEWAY_FOR_EACH_ISA(SLIDEWAY_CHOOSE_KERNEL, name)                       \
        return found;                                                             \
    }                                                                             \
    }
