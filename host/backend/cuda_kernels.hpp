// The kernels of cuda.cu, as the runtime knows them: functions of one GridTask.
#pragma once

namespace slideway {

/// A thread takes all the registers that it may, which leaves room for 256 in a multiprocessor: small blocks fill that best.
inline constexpr int threads_per_block = 64;

struct CudaKernels {
    void const* members = nullptr;
    void const* shadowed = nullptr;  // members with shadows
};

/// Of the slider-crank, for all laws.
CudaKernels cuda_kernels();

}  // namespace slideway
