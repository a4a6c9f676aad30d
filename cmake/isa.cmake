include(CheckCXXCompilerFlag)

# The instruction sets that kernels are built for.  Every unit built for one of them sees its name as SLIDEWAY_ISA,
# the inline namespace of kernels/real.hpp, so that no two of them share a function.

# `scalar` is one member per Real on a machine with AVX2 and FMA: the reference that avx2 and avx512 must meet bit for
# bit.  `sse2` runs on every x86-64 but rounds each multiply-add twice.
set(SLIDEWAY_ISAS scalar sse2 avx2 avx512)
# Members per Real.
set(SLIDEWAY_LANES_scalar 1)
set(SLIDEWAY_LANES_sse2 2)
set(SLIDEWAY_LANES_avx2 4)
set(SLIDEWAY_LANES_avx512 8)

# g++ copies structures in pieces of 16 bytes unless told otherwise; a pack that was stored in two pieces and is read back whole
# waits until the stores have left the core.
check_cxx_compiler_flag("-mmove-max=256 -mstore-max=256" SLIDEWAY_HAS_MOVE_MAX)

# slideway_isa_flags(<isa> <out_var>): compile options for a unit of that instruction set.
function(slideway_isa_flags isa out_var)
    set(flags -DSLIDEWAY_ISA=${isa})
    if(isa STREQUAL "scalar" OR isa STREQUAL "avx2")
        list(APPEND flags -mavx2 -mfma -mpopcnt)
    elseif(isa STREQUAL "avx512")
        list(APPEND flags -mavx512f -mavx512dq -mavx512cd -mavx512bw -mavx512vl -mfma -mpopcnt -mprefer-vector-width=512)
        # g++ 12 warns about its own intrinsic headers.
        if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
            list(APPEND flags -Wno-uninitialized -Wno-maybe-uninitialized)
        endif()
    elseif(isa STREQUAL "sse2")
        list(APPEND flags -DSLIDEWAY_NO_FMA)
    else()
        message(FATAL_ERROR "slideway_isa_flags: unknown instruction set '${isa}' (one of: ${SLIDEWAY_ISAS})")
    endif()
    if(SLIDEWAY_HAS_MOVE_MAX AND isa STREQUAL "avx2")
        list(APPEND flags -mmove-max=256 -mstore-max=256)
    elseif(SLIDEWAY_HAS_MOVE_MAX AND isa STREQUAL "avx512")
        list(APPEND flags -mmove-max=512 -mstore-max=512)
    endif()
    # Pairing operations of one member costs the scalar kernels 4 %: they are to be the best scalar build there is.
    if(isa STREQUAL "scalar")
        list(APPEND flags -fno-tree-slp-vectorize)
    endif()
    set(${out_var} ${flags} PARENT_SCOPE)
endfunction()

# slideway_isa_unit(<library> <isa> <source>): the source as an object library with the flags of the kernels that ship.  The unit
# sees SLIDEWAY_ISA and SLIDEWAY_LANES and defines its functions in that namespace.
function(slideway_isa_unit library isa source)
    slideway_isa_flags(${isa} flags)
    set(options ${flags} -fno-math-errno -Wno-ignored-attributes)
    # The headers of SIMD take longer to read than many a kernel to compile.
    set(headers slideway_headers_${isa})
    if(NOT TARGET ${headers})
        add_library(${headers} OBJECT ${PROJECT_SOURCE_DIR}/cmake/headers.cpp)
        target_compile_options(${headers} PRIVATE ${options})
        target_precompile_headers(${headers} PRIVATE <immintrin.h> <xsimd/xsimd.hpp> <cmath> <cstddef> <cstdint> <vector>)
    endif()
    add_library(${library} OBJECT ${source})
    target_compile_options(${library} PRIVATE ${options})
    target_compile_definitions(${library} PRIVATE SLIDEWAY_LANES=${SLIDEWAY_LANES_${isa}})
    target_precompile_headers(${library} REUSE_FROM ${headers})
endfunction()
