# Every OpenGL function that the VTK libraries of LIBRARIES import from libGL is exported by PROGRAM,
# which leads it to OSMesa (render/gl_entry_points.cpp). GLX calls are left out: nothing makes them.
cmake_minimum_required(VERSION 3.25)

function(symbols file option out)
    execute_process(COMMAND ${NM} -D ${option} ${file}
        OUTPUT_VARIABLE text RESULT_VARIABLE failed)
    if(failed)
        message(FATAL_ERROR "${NM} cannot read ${file}")
    endif()
    string(REGEX MATCHALL " gl[A-WYZ][A-Za-z0-9]*" names "${text}")
    set(${out} ${names} PARENT_SCOPE)
endfunction()

symbols(${PROGRAM} --defined-only exported)
foreach(library IN LISTS LIBRARIES)
    symbols(${library} --undefined-only imported)
    list(APPEND all ${imported})
    foreach(name IN LISTS imported)
        if(NOT name IN_LIST exported)
            message(NOTICE "${library} imports${name}, which gl_entry_points.cpp lacks")
            set(is_missing TRUE)
        endif()
    endforeach()
endforeach()
list(LENGTH all count)
if(count LESS 20 OR is_missing)
    message(FATAL_ERROR "${count} imported functions looked at")
endif()
