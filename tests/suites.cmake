# What ctest reads of a program of tests that is listed by suites (slideway_add_tests): target, program, label, timeout and results are set.
# Loading a program takes longer than most tests of it.  What each test of a suite came to is in an XML file under results.
if(NOT EXISTS ${program})
    add_test(${target}_NOT_BUILT ${target}_NOT_BUILT)
    return()
endif()
execute_process(COMMAND ${program} --gtest_list_tests OUTPUT_VARIABLE listed COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "(^|\n)[A-Za-z0-9_/]+\\." suites "${listed}")
foreach(suite IN LISTS suites)
    string(REGEX REPLACE "[\n.]" "" suite "${suite}")
    string(REPLACE "/" "_" file "${suite}")
    add_test(${suite} ${program} "--gtest_filter=${suite}.*" "--gtest_output=xml:${results}/${target}.${file}.xml")
    set_tests_properties(${suite} PROPERTIES LABELS ${label} TIMEOUT ${timeout})
endforeach()
