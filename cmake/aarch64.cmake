# Cross-compilation for 64-bit ARM with Debian's compiler: scripts/neon_check.sh.
# SLIDEWAY_SYSROOT: a folder with arm64 packages unpacked into it; what is built runs under qemu-user.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_C_COMPILER aarch64-linux-gnu-gcc)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CMAKE_LIBRARY_ARCHITECTURE aarch64-linux-gnu)

set(SLIDEWAY_SYSROOT "" CACHE PATH "Root of the files of an arm64 system")
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES SLIDEWAY_SYSROOT)
set(CMAKE_SYSROOT ${SLIDEWAY_SYSROOT})
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
set(ENV{PKG_CONFIG_DIR} "")
set(ENV{PKG_CONFIG_SYSROOT_DIR} ${SLIDEWAY_SYSROOT})
set(ENV{PKG_CONFIG_LIBDIR} ${SLIDEWAY_SYSROOT}/usr/lib/aarch64-linux-gnu/pkgconfig:${SLIDEWAY_SYSROOT}/usr/share/pkgconfig)
# The linker looks for what shared libraries need in turn.
set(CMAKE_EXE_LINKER_FLAGS_INIT "-Wl,-rpath-link,${SLIDEWAY_SYSROOT}/lib/aarch64-linux-gnu:${SLIDEWAY_SYSROOT}/usr/lib/aarch64-linux-gnu")

find_program(SLIDEWAY_QEMU NAMES qemu-aarch64 qemu-aarch64-static)
set(CMAKE_CROSSCOMPILING_EMULATOR ${SLIDEWAY_QEMU} -L ${SLIDEWAY_SYSROOT})
