# The steps of install.consumer_builds_and_runs; stops at the first that fails.
cmake_minimum_required(VERSION 3.25)
file(REMOVE_RECURSE ${WORK})

function(step)
    execute_process(COMMAND ${ARGN} RESULT_VARIABLE failed OUTPUT_VARIABLE text ERROR_VARIABLE text)
    if(failed)
        list(JOIN ARGN " " line)
        message(FATAL_ERROR "${line}\n${text}")
    endif()
    set(output "${text}" PARENT_SCOPE)
endfunction()

function(expect text)
    if(NOT output STREQUAL text)
        message(FATAL_ERROR "the consumer said\n${output}instead of\n${text}")
    endif()
endfunction()

# A library built with a sanitizer needs its consumer linked with it.
set(flags "")
if(SANITIZE)
    set(flags -DCMAKE_CXX_FLAGS=-fsanitize=${SANITIZE})
endif()

step(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix)
step(${CMAKE_COMMAND} -S ${SOURCE} -B ${WORK}/build -G ${GENERATOR} ${flags}
    -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_PREFIX_PATH=${WORK}/prefix -DWITH_IO=${WITH_IO}
    -DWITH_RENDER=${WITH_RENDER})
step(${CMAKE_COMMAND} --build ${WORK}/build)
step(${WORK}/build/consumer)
expect("grainbench ${VERSION}: 202 nodes, peak 0.35 m/s\n")
if(WITH_IO)
    set(scene ${WORK}/prefix/share/grainbench/presets/scenes/bouncing-ball.json)
    step(${WORK}/build/reader ${scene})
    expect("Bouncing ball: 1 walls\n")
endif()
if(WITH_RENDER)
    # The leak sanitizer reports which suppressions it used among what the program says.
    step(${CMAKE_COMMAND} -E env LSAN_OPTIONS=print_suppressions=0 ${WORK}/build/painter)
    expect("drawn\n")
    step(${WORK}/prefix/bin/grainbench check ${scene})
endif()
