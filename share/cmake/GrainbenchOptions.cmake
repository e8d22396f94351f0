# Options, dependencies, and the two INTERFACE targets that every target of ours links.
include(GNUInstallDirs)

option(GRAINBENCH_BUILD_IO "Build file formats (VTK, HDF5, JSON)" ON)
option(GRAINBENCH_BUILD_RENDER "Build the renderer (VTK on OSMesa) and the command line, which draws" ${GRAINBENCH_BUILD_IO})
option(GRAINBENCH_BUILD_TESTS "Build the tests" ${PROJECT_IS_TOP_LEVEL})
option(GRAINBENCH_FUZZ "Build the fuzz targets with libFuzzer; needs clang and a fuzzer-no-link sanitizer" OFF)
option(GRAINBENCH_WERROR "Treat warnings as errors" OFF)
set(GRAINBENCH_SANITIZE "" CACHE STRING "Sanitizers, as in -fsanitize=...: address,undefined or thread")

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
    set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()

# Same bits for every compiler switch and instruction set: no fused multiply-add behind our back and
# no value-changing optimisation.
add_library(grainbench_options INTERFACE)
target_compile_features(grainbench_options INTERFACE cxx_std_20)
target_compile_options(grainbench_options INTERFACE -ffp-contract=off -fvisibility=hidden)
if(GRAINBENCH_SANITIZE)
    target_compile_options(grainbench_options INTERFACE -fsanitize=${GRAINBENCH_SANITIZE} -fno-omit-frame-pointer)
    target_link_options(grainbench_options INTERFACE -fsanitize=${GRAINBENCH_SANITIZE})
endif()

add_library(grainbench_warnings INTERFACE)
target_compile_options(grainbench_warnings INTERFACE
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wdouble-promotion -Wold-style-cast
    -Wnon-virtual-dtor -Woverloaded-virtual -Wnull-dereference -Wduplicated-cond -Wlogical-op)
if(GRAINBENCH_WERROR)
    target_compile_options(grainbench_warnings INTERFACE -Werror)
endif()

# Flags of STEM_scalar.cpp, STEM_sse4.cpp, ...: one file per instruction set, each with its own
# (share/doc/decisions/0001). Sanitizers make so much of a pass that -O3 would take the compiler tens
# of minutes.
function(grainbench_instruction_sets stem)
    set(optimisation -O3)
    if(GRAINBENCH_SANITIZE)
        set(optimisation -O1)
    endif()
    set(scalar -DHWY_COMPILE_ONLY_SCALAR)
    set(sse4 -march=nehalem -maes -mpclmul)
    set(avx2 -march=haswell -maes -mpclmul)
    set(avx512 -march=skylake-avx512 -mtune=generic -mprefer-vector-width=512)
    foreach(isa IN ITEMS scalar sse4 avx2 avx512)
        set_source_files_properties(${stem}_${isa}.cpp PROPERTIES
            COMPILE_OPTIONS "${optimisation};${${isa}}")
    endforeach()
endfunction()

find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(hwy 1.0 REQUIRED)
find_package(Threads REQUIRED)
find_package(TBB 2021 REQUIRED COMPONENTS tbb)
if(GRAINBENCH_BUILD_IO)
    find_package(MPI REQUIRED COMPONENTS C)  # named by Debian's VTK targets
    find_package(VTK 9.1 REQUIRED COMPONENTS CommonCore CommonDataModel IOCore IOGeometry IOXML IOXMLParser)
    find_package(HDF5 1.10 REQUIRED COMPONENTS C)
    find_package(nlohmann_json 3.11 REQUIRED)
    find_package(CLI11 2.1 REQUIRED)
    find_package(spdlog 1.10 REQUIRED)
    find_package(fmt 9.1 REQUIRED)
endif()
if(GRAINBENCH_BUILD_RENDER)
    if(NOT GRAINBENCH_BUILD_IO)
        message(FATAL_ERROR "GRAINBENCH_BUILD_RENDER needs GRAINBENCH_BUILD_IO: pictures are drawn from run folders")
    endif()
    include(GrainbenchVtkDrawing)
    find_path(OSMESA_INCLUDE_DIR GL/osmesa.h REQUIRED)  # package libosmesa6-dev
endif()
