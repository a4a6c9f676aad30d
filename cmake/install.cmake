# What `cmake --install` brings: the program with man page and completions, the library, the kernels' headers, CMake's package, scenes and jobs.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/slideway)
set(headers_dir ${CMAKE_INSTALL_INCLUDEDIR}/slideway)

install(TARGETS slideway RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
if(NOT CMAKE_CROSSCOMPILING)
    install(CODE "set(SLIDEWAY_PROGRAM \"$<TARGET_FILE:slideway>\")")
    install(SCRIPT ${CMAKE_CURRENT_LIST_DIR}/pages.cmake)
endif()
install(DIRECTORY scenes DESTINATION ${CMAKE_INSTALL_DATADIR}/slideway)
install(DIRECTORY examples/jobs DESTINATION ${CMAKE_INSTALL_DATADIR}/slideway/examples)  # tables of scenes among them
# Under the names that Debian has for them.
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright)
execute_process(COMMAND gzip -9nc ${PROJECT_SOURCE_DIR}/CHANGELOG.md OUTPUT_FILE ${PROJECT_BINARY_DIR}/changelog.gz)
install(FILES ${PROJECT_BINARY_DIR}/changelog.gz DESTINATION ${CMAKE_INSTALL_DOCDIR} OPTIONAL)

# The kernels are headers: who includes them says for which processor.
add_library(slideway_kernels INTERFACE)
target_include_directories(slideway_kernels INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}> $<INSTALL_INTERFACE:${headers_dir}>)
target_compile_features(slideway_kernels INTERFACE cxx_std_20)
# Bits may not depend on what the compiler contracts.
target_compile_options(slideway_kernels INTERFACE -ffp-contract=off)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(slideway_kernels INTERFACE "$<$<CXX_COMPILER_ID:GNU>:SHELL:--param large-function-insns=1000000>"
        "$<$<CXX_COMPILER_ID:GNU>:SHELL:--param large-stack-frame-growth=100000>")
endif()
set_target_properties(slideway_kernels PROPERTIES EXPORT_NAME kernels)
set_target_properties(slideway_shared PROPERTIES EXPORT_NAME slideway)
target_include_directories(slideway_shared INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
target_compile_features(slideway_shared INTERFACE cxx_std_20)

install(TARGETS slideway_shared EXPORT slideway-targets LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT slideway-targets NAMESPACE slideway:: DESTINATION ${package_dir})
install(FILES host/library/slideway.hpp DESTINATION ${headers_dir})
# The kernels' headers need no build: cmake -S . -B build, cmake --install build --component headers.
install(TARGETS slideway_kernels EXPORT slideway-headers-targets)
install(EXPORT slideway-headers-targets NAMESPACE slideway:: DESTINATION ${package_dir} COMPONENT headers)
install(FILES kernels/kernels.hpp kernels/dispatch.hpp DESTINATION ${headers_dir} COMPONENT headers)
install(DIRECTORY kernels ${PROJECT_BINARY_DIR}/generated/kernels DESTINATION ${headers_dir} COMPONENT headers FILES_MATCHING PATTERN "*.hpp")
# What slideway compile compiles a law or mechanism of one's own with.
get_property(border GLOBAL PROPERTY SLIDEWAY_BORDER_SOURCES)
install(FILES ${border} DESTINATION ${headers_dir}/host/backend)
configure_package_config_file(cmake/slideway-config.cmake.in ${PROJECT_BINARY_DIR}/slideway-config.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/slideway-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/slideway-config.cmake ${PROJECT_BINARY_DIR}/slideway-config-version.cmake cmake/isa_choice.cmake
    cmake/isa_flags.cmake cmake/kernel_units.cmake DESTINATION ${package_dir} COMPONENT headers)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "the slideway project")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "contact dynamics of thousands of mechanisms with clearance joints at once")
set(CPACK_PACKAGE_DESCRIPTION "slideway integrates ensembles of mechanisms whose translational joint has clearance: tolerance studies,\n\
 chaos statistics and benchmarks, with a contact law of surfaces, lines and points.")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS libudunits2-data)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS libxsimd-dev)  # of the kernels' headers
set(suggests python3)
if(MPI_CXX_FOUND)
    string(APPEND suggests ", openmpi-bin")
endif()
set(CPACK_DEBIAN_PACKAGE_SUGGESTS ${suggests})
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
include(CPack)
