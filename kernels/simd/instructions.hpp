// What xsimd 8.1 lacks for packs of doubles, does slowly or does with other bits than the rest: by the number of lanes, which tells the
// instruction sets of one processor apart.
#pragma once

#include "kernels/simd/target.hpp"

namespace slideway::inline SLIDEWAY_ISA::detail {

/// Of an instruction set that the unit is compiled for:
///   fma, fnma, fms   a·b + c, c − a·b, a·b − c, rounded once
///   min, max         a < b ? a : b, a > b ? a : b, with NaN and zeros of both signs too
///   mask_bits        bit i is the truth value of lane i
///   mask_of          the truth value of every lane
template <int lanes> struct Instructions;

}  // namespace slideway::inline SLIDEWAY_ISA::detail

#if defined(SLIDEWAY_SIMD) && defined(__x86_64__)
#include "kernels/simd/x86.hpp"
#elif defined(SLIDEWAY_SIMD) && defined(__aarch64__)
#include "kernels/simd/neon.hpp"
#endif
