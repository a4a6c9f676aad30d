# Writes HEADER with VERSION, COMPILER and the commit of SOURCE: its short name, "-dirty" if tracked files differ from it, "unknown"
# without git or outside a repository.
cmake_policy(VERSION 3.25)
set(commit unknown)
find_program(git git)
if(git)
    execute_process(COMMAND ${git} -C ${SOURCE} rev-parse --short HEAD
                    OUTPUT_VARIABLE name ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE RESULT_VARIABLE failed)
    if(NOT failed)
        set(commit ${name})
        execute_process(COMMAND ${git} -C ${SOURCE} status --porcelain --untracked-files=no
                        OUTPUT_VARIABLE changes ERROR_QUIET)
        if(changes)
            string(APPEND commit "-dirty")
        endif()
    endif()
endif()
file(CONFIGURE OUTPUT ${HEADER} @ONLY CONTENT
"// Made by cmake/commit.cmake.
#pragma once

#define SLIDEWAY_VERSION \"@VERSION@\"
#define SLIDEWAY_COMMIT \"@commit@\"
#define SLIDEWAY_COMPILER \"@COMPILER@\"
#define SLIDEWAY_BUILD \"slideway \" SLIDEWAY_VERSION \", commit \" SLIDEWAY_COMMIT \", \" SLIDEWAY_COMPILER
")
