# Writes HEADER with the commit of SOURCE, "-dirty" after it where tracked files differ from it, or
# "unknown" where there is no git or no repository. A header that is right already is left alone.
cmake_minimum_required(VERSION 3.25)
set(hash "unknown")
find_package(Git QUIET)
if(Git_FOUND)
    execute_process(
        COMMAND ${GIT_EXECUTABLE} describe --always --dirty --abbrev=12 --exclude=*
        WORKING_DIRECTORY ${SOURCE}
        RESULT_VARIABLE failed OUTPUT_VARIABLE answer ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
    if(NOT failed)
        set(hash "${answer}")
    endif()
endif()
file(CONFIGURE OUTPUT ${HEADER} @ONLY CONTENT
"/// Commit of the sources, written in every build.
#pragma once

namespace grainbench::cli {

inline constexpr const char* git_hash = \"@hash@\";

}  // namespace grainbench::cli
")
