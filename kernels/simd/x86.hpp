// AVX2 with FMA, and AVX-512.
#pragma once

#include "kernels/simd/instructions.hpp"

#if defined(SLIDEWAY_SIMD) && defined(__x86_64__)
#include <immintrin.h>
#endif

namespace slideway::inline SLIDEWAY_ISA::detail {

#if defined(SLIDEWAY_SIMD) && defined(__AVX2__) && defined(__FMA__)
template <> struct Instructions<4> {
    using Pack = __m256d;
    using Mask = __m256d;
    SLIDEWAY_FN static Pack fma(Pack a, Pack b, Pack c) { return _mm256_fmadd_pd(a, b, c); }
    SLIDEWAY_FN static Pack fnma(Pack a, Pack b, Pack c) { return _mm256_fnmadd_pd(a, b, c); }
    SLIDEWAY_FN static Pack fms(Pack a, Pack b, Pack c) { return _mm256_fmsub_pd(a, b, c); }
    SLIDEWAY_FN static Pack min(Pack a, Pack b) { return _mm256_min_pd(a, b); }
    SLIDEWAY_FN static Pack max(Pack a, Pack b) { return _mm256_max_pd(a, b); }
    SLIDEWAY_FN static unsigned mask_bits(Mask m) { return static_cast<unsigned>(_mm256_movemask_pd(m)); }
    SLIDEWAY_FN static Mask mask_of(bool value) { return _mm256_castsi256_pd(_mm256_set1_epi64x(value ? -1 : 0)); }
};
#endif

#if defined(SLIDEWAY_SIMD) && defined(__AVX512F__)
template <> struct Instructions<8> {
    using Pack = __m512d;
    using Mask = __mmask8;
    // xsimd 8.1 multiplies and adds, which is slower and gives other bits.
    SLIDEWAY_FN static Pack fma(Pack a, Pack b, Pack c) { return _mm512_fmadd_pd(a, b, c); }
    SLIDEWAY_FN static Pack fnma(Pack a, Pack b, Pack c) { return _mm512_fnmadd_pd(a, b, c); }
    SLIDEWAY_FN static Pack fms(Pack a, Pack b, Pack c) { return _mm512_fmsub_pd(a, b, c); }
    SLIDEWAY_FN static Pack min(Pack a, Pack b) { return _mm512_min_pd(a, b); }
    SLIDEWAY_FN static Pack max(Pack a, Pack b) { return _mm512_max_pd(a, b); }
    SLIDEWAY_FN static unsigned mask_bits(Mask m) { return static_cast<unsigned>(m); }
    // xsimd's constructor builds it bit by bit, in a function that g++ tends not to inline.
    SLIDEWAY_FN static Mask mask_of(bool value) { return static_cast<Mask>(value ? 0xff : 0); }
};
#endif

}  // namespace slideway::inline SLIDEWAY_ISA::detail
