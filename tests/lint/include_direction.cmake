# Which layer may include what: core <- io <- render <- cli, tests may see all, nobody sees tests.
include(${CMAKE_CURRENT_LIST_DIR}/lint.cmake)

# Project headers allowed in quotes, third-party headers allowed in angle brackets. A header of the
# standard library has no dot in its name and is allowed everywhere.
set(quoted_core "^core/")
set(angled_core "^(Eigen|hwy|tbb|oneapi/tbb|sanitizer)/|^sys/mman[.]h$")
set(quoted_io "^(core|io)/")
set(angled_io "^(nlohmann|valijson|fmt|spdlog)/|^vtk[A-Za-z0-9]+[.]h$|^hdf5[.]h$|^(unistd|fcntl|sys/[a-z]+)[.]h$")
set(quoted_render "^(core|io|render)/")
set(forbidden_render "^core/contact/")  # pictures come from run folders, not from laws
set(angled_render "^(nlohmann|fmt)/|^vtk[A-Za-z0-9]+[.]h$|^GL/|^(dlfcn|png)[.]h$")
set(quoted_cli "^(core|io|render|cli)/")
set(angled_cli "^(CLI|benchmark|fmt|spdlog)/|^(unistd|malloc|sys/[a-z]+)[.]h$")
set(quoted_tests "^(core|io|render|cli|tests)/")
set(angled_tests "^")

# The bench measures what the processor can do with loops of its own, compiled like those of the engine.
set(quoted_bench "${quoted_cli}")
set(angled_bench "${angled_cli}|^hwy/")

# A law is one equation and reads nothing but what a law is, and what laws with a tangential history
# share.
set(quoted_law "^core/(contact/law|contact/tangential|describe)[.]hpp$")
set(angled_law "^$")

foreach(layer IN LISTS lint_layers)
    file(GLOB_RECURSE files RELATIVE ${ROOT} ${ROOT}/${layer}/*.hpp ${ROOT}/${layer}/*.cpp)
    foreach(path IN LISTS files)
        set(rule ${layer})
        if(path MATCHES "^core/contact/laws/")
            set(rule law)
        elseif(path MATCHES "^cli/bench/")
            set(rule bench)
        endif()
        file(STRINGS ${ROOT}/${path} includes REGEX "^[ \t]*#[ \t]*include")
        foreach(line IN LISTS includes)
            if(line MATCHES "include[ \t]*\"([^\"]+)\"")
                set(header ${CMAKE_MATCH_1})
                if(NOT header MATCHES "${quoted_${rule}}"
                   OR (DEFINED forbidden_${rule} AND header MATCHES "${forbidden_${rule}}"))
                    lint_breach(${path} "may not include \"${header}\"")
                endif()
            elseif(line MATCHES "include[ \t]*<([^>]+)>")
                set(header ${CMAKE_MATCH_1})
                if(header MATCHES "[./]" AND NOT header MATCHES "${angled_${rule}}")
                    lint_breach(${path} "may not include <${header}>")
                endif()
            endif()
        endforeach()
    endforeach()
endforeach()
lint_finish()
