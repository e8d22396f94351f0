# grainbench_test(NAME unit_walls SOURCES a.cpp b.cpp LINK grainbench::core LABELS unit)
# One executable of GoogleTest cases; each case is one ctest test.
#
# grainbench_slow_test(NAME example SOURCES a.cpp LINK grainbench::io LABELS physics TIMEOUT 3600)
# One executable that is one ctest test, labelled slow as well: left out by share/test.sh.
include(GoogleTest)
find_package(GTest 1.12 REQUIRED)

function(grainbench_test_program name)
    cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES;LINK")
    add_executable(${name} ${arg_SOURCES})
    target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR})
    target_link_libraries(${name}
        PRIVATE ${arg_LINK} grainbench_options grainbench_warnings GTest::gtest_main)
endfunction()

function(grainbench_test)
    cmake_parse_arguments(PARSE_ARGV 0 arg "" "NAME" "SOURCES;LINK;LABELS")
    grainbench_test_program(${arg_NAME} SOURCES ${arg_SOURCES} LINK ${arg_LINK})
    gtest_discover_tests(${arg_NAME} DISCOVERY_MODE PRE_TEST PROPERTIES LABELS "${arg_LABELS}")
endfunction()

# gtest_discover_tests takes a list of labels apart, so a slow test is registered as a whole.
function(grainbench_slow_test)
    cmake_parse_arguments(PARSE_ARGV 0 arg "" "NAME;TIMEOUT" "SOURCES;LINK;LABELS")
    grainbench_test_program(${arg_NAME} SOURCES ${arg_SOURCES} LINK ${arg_LINK})
    add_test(NAME ${arg_NAME} COMMAND ${arg_NAME})
    set_tests_properties(${arg_NAME} PROPERTIES
        LABELS "${arg_LABELS};slow" TIMEOUT ${arg_TIMEOUT} RUN_SERIAL ON)
endfunction()
