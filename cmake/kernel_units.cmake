# slideway_add_kernels(<target> SOURCES <file>... [ISAS <name>...]): compiles the files once for each instruction set (all that there are for the
# processor, unless they are named or SLIDEWAY_ISAS says native or some) with the flags of slideway's own kernels, and links them to the target.
#
# Each file is a unit of kernels: it defines its functions in `namespace slideway::inline SLIDEWAY_ISA` for the number type IsaReal
# (kernels/isa_real.hpp).  In the target's other sources SLIDEWAY_KERNEL(Return, name, (parameters)) of <slideway/dispatch.hpp> declares such a
# function, and name_kernel() is the widest that runs on the machine.
function(slideway_add_kernels target)
    cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES;ISAS")
    if(NOT arg_ISAS)
        set(arg_ISAS all)
        if(SLIDEWAY_ISAS)
            set(arg_ISAS ${SLIDEWAY_ISAS})
        endif()
    endif()
    slideway_known_isas(${CMAKE_SYSTEM_PROCESSOR} SLIDEWAY_KNOWN_ISAS)
    set(features)
    if(arg_ISAS STREQUAL "native")
        file(STRINGS /proc/cpuinfo features REGEX "^flags" LIMIT_COUNT 1)
    endif()
    slideway_chosen_isas("${arg_ISAS}" ${CMAKE_SYSTEM_PROCESSOR} "${features}" isas)

    find_path(SLIDEWAY_XSIMD xsimd/xsimd.hpp)
    if(NOT SLIDEWAY_XSIMD)
        message(FATAL_ERROR "slideway_add_kernels needs the headers of xsimd; install them (Debian: libxsimd-dev)")
    endif()
    get_property(number GLOBAL PROPERTY SLIDEWAY_UNITS)
    if(NOT number)
        set(number 0)
    endif()
    set(rows)
    foreach(isa IN LISTS isas)
        string(APPEND rows " \\\n    row(${isa} __VA_OPT__(, ) __VA_ARGS__)")
        slideway_isa_flags(${isa} flags)
        foreach(source IN LISTS arg_SOURCES)
            math(EXPR number "${number} + 1")
            set(unit ${target}_${isa}_${number})
            add_library(${unit} OBJECT ${source})
            target_link_libraries(${unit} PRIVATE slideway::kernels)
            target_include_directories(${unit} SYSTEM PRIVATE ${SLIDEWAY_XSIMD})
            set_target_properties(${unit} PROPERTIES POSITION_INDEPENDENT_CODE ON)
            target_compile_options(${unit} PRIVATE -O3 ${flags} -fno-math-errno -Wno-ignored-attributes)
            target_compile_definitions(${unit} PRIVATE SLIDEWAY_LANES=${SLIDEWAY_LANES_${isa}})
            target_sources(${target} PRIVATE $<TARGET_OBJECTS:${unit}>)
        endforeach()
    endforeach()
    set_property(GLOBAL PROPERTY SLIDEWAY_UNITS ${number})
    set(folder ${CMAKE_CURRENT_BINARY_DIR}/${target}_kernels)
    file(CONFIGURE OUTPUT ${folder}/slideway_isas.hpp @ONLY CONTENT
"#pragma once
#define SLIDEWAY_FOR_EACH_ISA(row, ...)@rows@
")
    target_include_directories(${target} PRIVATE ${folder})
    target_link_libraries(${target} PRIVATE slideway::kernels)
endfunction()
