# Every source is as .clang-format wants it. Other versions of clang-format disagree in details, so
# only the version of the project is asked.
include(${CMAKE_CURRENT_LIST_DIR}/lint.cmake)

find_program(clang_format NAMES clang-format-14 clang-format)
if(NOT clang_format)
    message(NOTICE "SKIPPED: no clang-format here (package clang-format-14)")
    return()
endif()
execute_process(COMMAND ${clang_format} --version OUTPUT_VARIABLE version)
if(NOT version MATCHES "version 14[.]")
    message(NOTICE "SKIPPED: clang-format 14 is needed, this is ${version}")
    return()
endif()

lint_files(sources .hpp .cpp)
if(sources)
    execute_process(COMMAND ${clang_format} --dry-run -Werror ${sources}
        WORKING_DIRECTORY ${ROOT} RESULT_VARIABLE failed)
    if(failed)
        lint_breach("clang-format" "run: clang-format -i on the files above")
    endif()
endif()
lint_finish()
