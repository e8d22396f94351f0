# What the checks share: the files of the tree, their lines, and the report at the end.
#   cmake -D ROOT=<source tree> -P <check>.cmake
cmake_minimum_required(VERSION 3.25)

set(lint_layers core io render cli tests)
set(lint_count 0)

# Files of the project with one of the given endings, relative to ROOT. No build folder is entered.
function(lint_files out)
    set(found "")
    foreach(ending IN LISTS ARGN)
        file(GLOB top RELATIVE ${ROOT} ${ROOT}/*${ending})
        list(APPEND found ${top})
        foreach(folder IN ITEMS ${lint_layers} presets share .ci)
            file(GLOB_RECURSE below RELATIVE ${ROOT} ${ROOT}/${folder}/*${ending})
            list(APPEND found ${below})
        endforeach()
    endforeach()
    list(REMOVE_DUPLICATES found)
    list(SORT found)
    set(${out} "${found}" PARENT_SCOPE)
endfunction()

# Lines of a file as a list. Characters that mean something to CMake's lists are replaced by others:
# ";" by "@", "[" by "<", "]" by ">", a backslash by "/".
function(lint_lines path out)
    file(READ ${ROOT}/${path} text)
    string(REPLACE "\\" "/" text "${text}")
    string(REPLACE ";" "@" text "${text}")
    string(REPLACE "[" "<" text "${text}")
    string(REPLACE "]" ">" text "${text}")
    string(REPLACE "\n" ";" text "${text}")
    set(${out} "${text}" PARENT_SCOPE)
endfunction()

# Reports one breach and goes on, so that a run shows all of them.
macro(lint_breach place what)
    message(NOTICE "${place}: ${what}")
    math(EXPR lint_count "${lint_count} + 1")
endmacro()

function(lint_finish)
    if(lint_count GREATER 0)
        message(FATAL_ERROR "${lint_count} to mend")
    endif()
endfunction()
