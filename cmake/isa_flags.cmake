# The flags of processors, which stand here and nowhere else; for this build, and for projects that find_package(slideway).
include(CheckCXXCompilerFlag)

# Members per Real.
set(SLIDEWAY_LANES_scalar 1)
set(SLIDEWAY_LANES_scalar_libm 1)
set(SLIDEWAY_LANES_avx2 4)
set(SLIDEWAY_LANES_avx512 8)
set(SLIDEWAY_LANES_neon 2)

# g++ copies structures in pieces of 16 bytes unless told otherwise; a pack that was stored in two pieces and is read back whole
# waits until the stores have left the core.
check_cxx_compiler_flag("-mmove-max=256 -mstore-max=256" SLIDEWAY_HAS_MOVE_MAX)

# slideway_isa_flags(<isa> <out_var>): compile options for a unit of that instruction set.
function(slideway_isa_flags isa out_var)
    set(flags -DSLIDEWAY_ISA=${isa})
    # Of other processors scalar needs no flag.
    if("avx2" IN_LIST SLIDEWAY_KNOWN_ISAS AND isa MATCHES "^(scalar|avx2)$")
        list(APPEND flags -mavx2 -mfma -mpopcnt)
    elseif(isa STREQUAL "avx512")
        list(APPEND flags -mavx512f -mavx512dq -mavx512cd -mavx512bw -mavx512vl -mfma -mpopcnt -mprefer-vector-width=512)
        # g++ 12 warns about its own intrinsic headers.
        if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
            list(APPEND flags -Wno-uninitialized -Wno-maybe-uninitialized)
        endif()
    endif()
    if(SLIDEWAY_HAS_MOVE_MAX AND isa STREQUAL "avx2")
        list(APPEND flags -mmove-max=256 -mstore-max=256)
    elseif(SLIDEWAY_HAS_MOVE_MAX AND isa STREQUAL "avx512")
        list(APPEND flags -mmove-max=512 -mstore-max=512)
    endif()
    # Pairing operations of one member costs the scalar kernels 4 %: they are to be the best scalar build there is.
    if(isa MATCHES "^scalar")
        list(APPEND flags -fno-tree-slp-vectorize)
    endif()
    if(SLIDEWAY_SCALAR_O1 AND isa STREQUAL "scalar")
        list(APPEND flags -O1)
    endif()
    set(${out_var} ${flags} PARENT_SCOPE)
endfunction()
