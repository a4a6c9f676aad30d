// The number type of a unit built for one instruction set.  The parity tests take it too: they must test what ships.
#pragma once

#include "kernels/real.hpp"

namespace slideway::inline SLIDEWAY_ISA {

#if SLIDEWAY_LANES == 8
using IsaReal = Batch<xsimd::avx512dq>;
#elif SLIDEWAY_LANES == 4
using IsaReal = Batch<xsimd::fma3<xsimd::avx2>>;
#elif SLIDEWAY_LANES == 2
using IsaReal = Batch<xsimd::neon64>;
#else
using IsaReal = double;
#endif

}  // namespace slideway::inline SLIDEWAY_ISA
