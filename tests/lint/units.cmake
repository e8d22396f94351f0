# Physical members say their unit first in their comment: `double radius;  ///< [m]`.
include(${CMAKE_CURRENT_LIST_DIR}/lint.cmake)

set(number_type "(double|Vec3|T|Vec3Of<T>|std::vector<double>|std::vector<Vec3>)")
# lint_lines shows ";" as "@" and brackets as "<" and ">".
set(member "^ +${number_type} [a-z][a-z0-9_]*({}| = [^@]*)?@")

file(GLOB laws RELATIVE ${ROOT} ${ROOT}/core/contact/laws/*.hpp ${ROOT}/core/body/laws/*.hpp)
file(GLOB states RELATIVE ${ROOT} ${ROOT}/core/contact/*.hpp ${ROOT}/core/state/*.hpp
    ${ROOT}/core/insertion/*.hpp ${ROOT}/core/frame.hpp ${ROOT}/core/simulation.hpp)

foreach(path IN LISTS laws states)
    lint_lines(${path} lines)
    set(number 0)
    foreach(line IN LISTS lines)
        math(EXPR number "${number} + 1")
        if(NOT line MATCHES "${member}")
            continue()
        endif()
        if(line MATCHES "///<" AND NOT line MATCHES "///< <[^>]+>")
            lint_breach(${path}:${number} "the comment does not start with a unit in brackets")
        elseif(path IN_LIST laws AND line MATCHES "^ +double " AND NOT line MATCHES "///<")
            lint_breach(${path}:${number} "a parameter of a law without its unit")
        endif()
    endforeach()
endforeach()

# Every law says where it comes from, in the order of the style page.
foreach(path IN LISTS laws)
    file(READ ${ROOT}/${path} text)
    if(NOT text MATCHES "\n/// Model .*\n/// Source .*\n/// Symbols .*\n/// Signs .*\n/// History .*\n/// Limits ")
        lint_breach(${path} "the header comment lacks one of Model, Source, Symbols, Signs, History, Limits")
    endif()
endforeach()
lint_finish()
