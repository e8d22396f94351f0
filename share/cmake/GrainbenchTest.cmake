# grainbench_test(NAME unit_walls SOURCES a.cpp b.cpp LINK grainbench::core LABELS unit [TIMEOUT seconds])
# One executable of GoogleTest cases; each case is one ctest test.
include(GoogleTest)
find_package(GTest 1.12 REQUIRED)

function(grainbench_test)
    cmake_parse_arguments(PARSE_ARGV 0 arg "" "NAME;TIMEOUT" "SOURCES;LINK;LABELS")
    if(NOT arg_TIMEOUT)
        set(arg_TIMEOUT 600)
    endif()
    add_executable(${arg_NAME} ${arg_SOURCES})
    target_include_directories(${arg_NAME} PRIVATE ${PROJECT_SOURCE_DIR})
    target_link_libraries(${arg_NAME} PRIVATE ${arg_LINK} grainbench_options grainbench_warnings GTest::gtest_main)
    # Each label separately: gtest_discover_tests takes the list apart again.
    gtest_discover_tests(${arg_NAME} DISCOVERY_MODE PRE_TEST
        PROPERTIES LABELS "${arg_LABELS}" TIMEOUT ${arg_TIMEOUT})
endfunction()
