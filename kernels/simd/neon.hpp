// NEON of 64-bit ARM.
#pragma once

#include "kernels/simd/instructions.hpp"

#if defined(SLIDEWAY_SIMD) && defined(__aarch64__)
#include <arm_neon.h>
#endif

namespace slideway::inline SLIDEWAY_ISA::detail {

#if defined(SLIDEWAY_SIMD) && defined(__aarch64__)
template <> struct Instructions<2> {
    using Pack = float64x2_t;
    using Mask = uint64x2_t;
    SLIDEWAY_FN static Pack fma(Pack a, Pack b, Pack c) { return vfmaq_f64(c, a, b); }
    SLIDEWAY_FN static Pack fnma(Pack a, Pack b, Pack c) { return vfmsq_f64(c, a, b); }
    SLIDEWAY_FN static Pack fms(Pack a, Pack b, Pack c) { return vfmaq_f64(vnegq_f64(c), a, b); }
    // fmin and fmax let NaN through from either side and tell zeros apart.
    SLIDEWAY_FN static Pack min(Pack a, Pack b) { return vbslq_f64(vcltq_f64(a, b), a, b); }
    SLIDEWAY_FN static Pack max(Pack a, Pack b) { return vbslq_f64(vcgtq_f64(a, b), a, b); }
    SLIDEWAY_FN static unsigned mask_bits(Mask m) {
        return static_cast<unsigned>((vgetq_lane_u64(m, 0) & 1u) | (vgetq_lane_u64(m, 1) & 2u));
    }
    SLIDEWAY_FN static Mask mask_of(bool value) { return vdupq_n_u64(value ? ~std::uint64_t{0} : 0); }
};
#endif

}  // namespace slideway::inline SLIDEWAY_ISA::detail
