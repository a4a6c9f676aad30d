# Writes HEADER with what a module and the program that opens it must have alike, as hashes:
#   SLIDEWAY_KERNEL_BORDER    of what a law or mechanism of one's own is compiled with, beside its own source;
#   SLIDEWAY_KERNEL_SOURCES   of that and of all that the tree's own modules, of rigid contacts, are made of.
# Each is of sources under SOURCE with all that they include there, of the flags of instruction sets, FLAGS beside them, and the version of xsimd in
# XSIMD.  The compiler may be another.
cmake_policy(VERSION 3.25)

# closure(<out> <file>...): the files, and those of the tree that they include, each once.
function(closure out)
    set(files ${ARGN})
    set(next ${ARGN})
    while(next)
        list(POP_FRONT next file)
        file(STRINGS ${SOURCE}/${file} lines REGEX "^#include \"(kernels|host/backend)/")
        foreach(line IN LISTS lines)
            string(REGEX REPLACE "^#include \"([^\"]+)\".*" "\\1" included "${line}")
            if(EXISTS ${SOURCE}/${included} AND NOT included IN_LIST files)
                list(APPEND files ${included})
                list(APPEND next ${included})
            endif()
        endforeach()
    endwhile()
    list(SORT files)
    set(${out} ${files} PARENT_SCOPE)
endfunction()

# hash_of(<out> <file>...)
function(hash_of out)
    set(hashes "${FLAGS}")
    foreach(file IN LISTS ARGN)
        file(SHA256 ${SOURCE}/${file} hash)
        string(APPEND hashes ";${hash}")
    endforeach()
    file(SHA256 ${XSIMD}/xsimd/config/xsimd_config.hpp hash)
    string(SHA256 hash "${hashes};${hash}")
    string(SUBSTRING ${hash} 0 16 hash)
    set(${out} ${hash} PARENT_SCOPE)
endfunction()

file(STRINGS ${XSIMD}/xsimd/config/xsimd_config.hpp versions REGEX "define XSIMD_VERSION_(MAJOR|MINOR|PATCH)")
string(REGEX REPLACE "[^0-9;]" "" versions "${versions}")
list(JOIN versions "." xsimd_version)
list(JOIN versions ", " xsimd_numbers)
set(border host/backend/kernel_module.cpp host/backend/cpu_law.cpp host/backend/cpu_mechanism.cpp host/backend/cpu_lanes.cpp
    host/backend/cpu_linkage.cpp)
file(GLOB rigid RELATIVE ${SOURCE} ${SOURCE}/kernels/rigid/*.hpp ${SOURCE}/kernels/mechanisms/*.hpp)
closure(of_border ${border})
closure(of_tree ${border} host/backend/cpu_rigid.cpp host/backend/cpu_rigid_joint.cpp ${rigid})
hash_of(border_hash ${of_border} cmake/isa_flags.cmake)
hash_of(tree_hash ${of_tree} cmake/isa_flags.cmake)
file(CONFIGURE OUTPUT ${HEADER} @ONLY CONTENT
"// Made by cmake/kernel_sources.cmake.
#pragma once

#define SLIDEWAY_KERNEL_BORDER \"@border_hash@\"
#define SLIDEWAY_KERNEL_SOURCES \"@tree_hash@\"
/// Of xsimd @xsimd_version@: major, minor, patch.
#define SLIDEWAY_KERNEL_XSIMD @xsimd_numbers@
/// The files of the border, ';' behind each.
#define SLIDEWAY_KERNEL_BORDER_FILES \"@of_border@;\"
")
