# The instruction sets that kernels are built for.  Every unit built for one of them sees its name as SLIDEWAY_ISA,
# the inline namespace of kernels/real.hpp, so that no two of them share a function.  isa_flags.cmake has the flags of processors.
include(${CMAKE_CURRENT_LIST_DIR}/isa_choice.cmake)

# `scalar` is one member per Real: the reference that all others meet bit for bit.  On x86-64 it needs AVX2 and FMA; `scalar_libm` takes its
# place on machines without, where the C library multiplies and adds with one rounding.
set(SLIDEWAY_ISAS ${default_isas} CACHE STRING
    "Instruction sets of the kernels: all, widest (of this machine; builds soonest), native (scalar and the widest), or a list of names")
set(machine_features)
if(SLIDEWAY_ISAS MATCHES "^(native|widest)$")
    if(CMAKE_CROSSCOMPILING)
        message(FATAL_ERROR "SLIDEWAY_ISAS=${SLIDEWAY_ISAS} is of the machine that builds; name the instruction sets of ${CMAKE_SYSTEM_PROCESSOR}")
    endif()
    file(STRINGS /proc/cpuinfo machine_features REGEX "^flags" LIMIT_COUNT 1)
endif()
slideway_known_isas(${CMAKE_SYSTEM_PROCESSOR} SLIDEWAY_KNOWN_ISAS)
slideway_chosen_isas("${SLIDEWAY_ISAS}" ${CMAKE_SYSTEM_PROCESSOR} "${machine_features}" SLIDEWAY_BUILT_ISAS)
include(${CMAKE_CURRENT_LIST_DIR}/isa_flags.cmake)
list(JOIN SLIDEWAY_BUILT_ISAS ", " names)
message(STATUS "Kernels are compiled for: ${names}")

# What code may know of the choice: host/backend/built_isas.hpp.
set(rows)
foreach(isa IN LISTS SLIDEWAY_BUILT_ISAS)
    string(APPEND rows " \\\n    row(${isa} __VA_OPT__(, ) __VA_ARGS__)")
endforeach()
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/generated/host/backend/built_isas.hpp @ONLY CONTENT
"// Made by cmake/isa.cmake.
#pragma once

/// row(name, ...) for each instruction set that the kernels of this build were compiled for, by its name in Isa.
#define SLIDEWAY_FOR_EACH_ISA(row, ...)@rows@
")
include_directories(${PROJECT_BINARY_DIR}/generated)

# slideway_isa_unit(<library> <isa> <source>): the source as an object library with the flags of the kernels that ship.  The unit
# sees SLIDEWAY_ISA and SLIDEWAY_LANES and defines its functions in that namespace.
function(slideway_isa_unit library isa source)
    slideway_isa_flags(${isa} flags)
    set(options ${flags} -fno-math-errno -Wno-ignored-attributes)
    # The headers of SIMD take longer to read than many a kernel to compile.
    set(headers slideway_headers_${isa})
    if(NOT TARGET ${headers})
        add_library(${headers} OBJECT ${PROJECT_SOURCE_DIR}/cmake/headers.cpp)
        set_target_properties(${headers} PROPERTIES POSITION_INDEPENDENT_CODE ON)
        target_compile_options(${headers} PRIVATE ${options})
        target_precompile_headers(${headers} PRIVATE <xsimd/xsimd.hpp> <cmath> <cstddef> <cstdint> <vector>)
    endif()
    add_library(${library} OBJECT ${source})
    set_target_properties(${library} PROPERTIES POSITION_INDEPENDENT_CODE ON)
    target_compile_options(${library} PRIVATE ${options})
    target_compile_definitions(${library} PRIVATE SLIDEWAY_LANES=${SLIDEWAY_LANES_${isa}})
    target_precompile_headers(${library} REUSE_FROM ${headers})
endfunction()
