# Writes HEADER with what tells one machine code of the kernels from another: a hash of the sources under SOURCE that a unit of kernels is compiled of,
# of the flags of instruction sets, FLAGS beside them, the version of xsimd in XSIMD, and the COMPILER.
cmake_policy(VERSION 3.25)
file(GLOB_RECURSE sources ${SOURCE}/kernels/*.hpp ${SOURCE}/host/backend/cpu_*.cpp ${SOURCE}/host/backend/cpu_*.hpp ${SOURCE}/host/backend/*_kernels.hpp
    ${SOURCE}/cmake/isa_flags.cmake ${XSIMD}/xsimd/config/xsimd_config.hpp)
list(SORT sources)
set(hashes "${FLAGS};${COMPILER}")
foreach(source IN LISTS sources)
    file(SHA256 ${source} hash)
    string(APPEND hashes ";${hash}")
endforeach()
string(SHA256 hash "${hashes}")
string(SUBSTRING ${hash} 0 16 hash)
file(CONFIGURE OUTPUT ${HEADER} @ONLY CONTENT
"// Made by cmake/kernel_sources.cmake.
#pragma once

#define SLIDEWAY_KERNEL_SOURCES \"@hash@, @COMPILER@\"
")
