# Run at installation: writes the man page and the completions of the shells with the program itself, which has the tables that they are made
# of.  Where it does not run (built for another machine) there are none, and the installation goes on.
foreach(page IN ITEMS "share/man/man1/slideway.1;--man" "share/bash-completion/completions/slideway;--completion;bash"
                      "share/zsh/site-functions/_slideway;--completion;zsh" "share/fish/vendor_completions.d/slideway.fish;--completion;fish")
    list(POP_FRONT page file)
    set(target "$ENV{DESTDIR}${CMAKE_INSTALL_PREFIX}/${file}")
    execute_process(COMMAND ${SLIDEWAY_PROGRAM} help ${page} OUTPUT_VARIABLE text ERROR_VARIABLE error RESULT_VARIABLE code)
    if(NOT code EQUAL 0)
        message(STATUS "No man page and no completions: ${SLIDEWAY_PROGRAM} does not run here (${code}) ${error}")
        break()
    endif()
    message(STATUS "Installing: ${target}")
    file(WRITE "${target}" "${text}")
    list(APPEND CMAKE_INSTALL_MANIFEST_FILES "${CMAKE_INSTALL_PREFIX}/${file}")
endforeach()
