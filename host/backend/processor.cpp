#include "host/backend/backend.hpp"

namespace slideway {

// The flags of cmake/isa.cmake, asked for one by one.
#if defined(__x86_64__)

bool processor_has(Isa isa) {
    bool const has_avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    switch (isa) {
        case Isa::scalar_libm:
            return true;
        case Isa::scalar:
        case Isa::avx2:
            return has_avx2;
        case Isa::avx512:
            return has_avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
                   __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512bw") &&
                   __builtin_cpu_supports("avx512vl");
        case Isa::neon:
            return false;
    }
    return false;
}

#else

bool processor_has(Isa isa) {
#if defined(__aarch64__)
    if (isa == Isa::neon) return true;
#endif
    return isa == Isa::scalar;
}

#endif

}  // namespace slideway
