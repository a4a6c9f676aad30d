// What a unit is compiled for: the namespace of its kernels, how their functions are declared, and whether packs exist.
#pragma once

#if !defined(__CUDACC__) && !defined(SLIDEWAY_NO_SIMD)
#define SLIDEWAY_SIMD 1
#endif

#ifndef SLIDEWAY_ISA
#define SLIDEWAY_ISA portable
#endif

// SLIDEWAY_FN is inlined, and so is a lambda with SLIDEWAY_INLINED behind its parameters; SLIDEWAY_NOINLINE is a function of its own; SLIDEWAY_CARD_CALL is inlined on processors and called on cards, whose
// assembler shares out the registers better between several functions than within a long one (gpu.md).  SLIDEWAY_UNROLL stands before a loop
// whose constant number of turns g++ would keep as a loop.
// Who compiles kernels oftener than he runs them says -DSLIDEWAY_FN=inline: the compiler then chooses what it inlines, and takes a third of the time.
#if defined(__CUDACC__)
#define SLIDEWAY_HD __host__ __device__
#define SLIDEWAY_FN __host__ __device__ inline
#define SLIDEWAY_NOINLINE __host__ __device__ __noinline__
#define SLIDEWAY_CARD_CALL __host__ __device__ __noinline__
#define SLIDEWAY_INLINED
#define SLIDEWAY_UNROLL
#else
#define SLIDEWAY_HD
#ifdef SLIDEWAY_FN
#define SLIDEWAY_INLINED
#else
#define SLIDEWAY_FN inline SLIDEWAY_INLINED
#define SLIDEWAY_INLINED __attribute__((always_inline))
#endif
#define SLIDEWAY_NOINLINE __attribute__((noinline))
#define SLIDEWAY_CARD_CALL SLIDEWAY_FN
#define SLIDEWAY_UNROLL _Pragma("GCC unroll 32")
#endif
