// What a unit is compiled for: the namespace of its kernels, how their functions are declared, and whether packs exist.
#pragma once

#if !defined(__CUDACC__) && !defined(SLIDEWAY_NO_SIMD)
#define SLIDEWAY_SIMD 1
#endif

#ifndef SLIDEWAY_ISA
#define SLIDEWAY_ISA portable
#endif

#if defined(__CUDACC__)
#define SLIDEWAY_HD __host__ __device__
#define SLIDEWAY_FN __host__ __device__ inline
#define SLIDEWAY_NOINLINE __host__ __device__ __noinline__
#else
#define SLIDEWAY_HD
#define SLIDEWAY_FN inline __attribute__((always_inline))
#define SLIDEWAY_NOINLINE __attribute__((noinline))
#endif
