# The lists that say which contact laws and mechanisms there are: kernels/laws/list.hpp and kernels/mechanisms/list.hpp.  From them:
#   SLIDEWAY_LAW_NAMES, SLIDEWAY_MECHANISM_NAMES   as in the scene; the header of each is kernels/<kind>/<name>.hpp
#   SLIDEWAY_LAW_TYPE_<name>, SLIDEWAY_MECHANISM_TYPE_<name>, SLIDEWAY_MECHANISM_BASE_<name>
#   SLIDEWAY_MECHANISM_BASES                       each once
#   generated/kernels/all_laws.hpp, generated/kernels/all_mechanisms.hpp   which include them all
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/kernels/laws/list.hpp
    ${PROJECT_SOURCE_DIR}/kernels/mechanisms/list.hpp)

# slideway_read_list(<folder> <prefix>): the rows of kernels/<folder>/list.hpp.
function(slideway_read_list folder prefix)
    file(READ ${PROJECT_SOURCE_DIR}/kernels/${folder}/list.hpp text)
    string(REGEX MATCHALL "\n +row\\([^)]*\\)" rows "${text}")
    set(names)
    set(bases)
    set(includes)
    foreach(row IN LISTS rows)
        if(NOT row MATCHES "row\\(([a-z_0-9]+), ([A-Za-z0-9]+)(, ([A-Za-z0-9]+))?\\)")
            message(FATAL_ERROR "kernels/${folder}/list.hpp: a row that is not row(name, Type) or row(name, Type, Base): ${row}")
        endif()
        set(name ${CMAKE_MATCH_1})
        set(base ${CMAKE_MATCH_4})
        list(APPEND names ${name})
        set(${prefix}_TYPE_${name} ${CMAKE_MATCH_2} PARENT_SCOPE)
        if(base)
            set(${prefix}_BASE_${name} ${base} PARENT_SCOPE)
            list(APPEND bases ${base})
        endif()
        string(APPEND includes "#include \"kernels/${folder}/${name}.hpp\"\n")
    endforeach()
    list(REMOVE_DUPLICATES bases)
    set(${prefix}_NAMES ${names} PARENT_SCOPE)
    set(${prefix}_BASES ${bases} PARENT_SCOPE)
    file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/generated/kernels/all_${folder}.hpp @ONLY CONTENT
"// Made by cmake/kernel_lists.cmake of kernels/${folder}/list.hpp.
#pragma once

${includes}")
endfunction()

slideway_read_list(laws SLIDEWAY_LAW)
slideway_read_list(mechanisms SLIDEWAY_MECHANISM)
