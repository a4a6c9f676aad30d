#pragma once

#include "kernels/simd/target.hpp"

namespace slideway::inline SLIDEWAY_ISA {

/// Ends the program: for a defect of whoever wrote a model.
SLIDEWAY_FN void trap() {
#if defined(__CUDA_ARCH__)
    __trap();
#else
    __builtin_trap();
#endif
}

}  // namespace slideway::inline SLIDEWAY_ISA
