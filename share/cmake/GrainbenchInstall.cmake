# Install and export, so that find_package(grainbench COMPONENTS core) works. One export per component:
# who asks for core needs neither VTK nor HDF5.
include(CMakePackageConfigHelpers)

set(grainbench_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/grainbench)
# Headers keep their path from the root of the project: #include "core/scene.hpp".
set(grainbench_header_dir ${CMAKE_INSTALL_INCLUDEDIR}/grainbench)

install(TARGETS grainbench_core EXPORT grainbenchCoreTargets
    FILE_SET HEADERS DESTINATION ${grainbench_header_dir}
    FILE_SET generated DESTINATION ${grainbench_header_dir})
install(EXPORT grainbenchCoreTargets NAMESPACE grainbench:: DESTINATION ${grainbench_package_dir})

if(TARGET grainbench_io)
    install(TARGETS grainbench_io EXPORT grainbenchIoTargets
        FILE_SET HEADERS DESTINATION ${grainbench_header_dir})
    install(EXPORT grainbenchIoTargets NAMESPACE grainbench:: DESTINATION ${grainbench_package_dir})
endif()
if(TARGET grainbench_render)
    install(TARGETS grainbench_render EXPORT grainbenchRenderTargets
        FILE_SET HEADERS DESTINATION ${grainbench_header_dir})
    install(EXPORT grainbenchRenderTargets NAMESPACE grainbench:: DESTINATION ${grainbench_package_dir})
    install(FILES ${PROJECT_SOURCE_DIR}/share/cmake/GrainbenchVtkDrawing.cmake
        DESTINATION ${grainbench_package_dir})
endif()
if(TARGET grainbench)
    install(TARGETS grainbench)
endif()

configure_package_config_file(
    ${PROJECT_SOURCE_DIR}/share/cmake/grainbenchConfig.cmake.in
    ${PROJECT_BINARY_DIR}/generated/grainbenchConfig.cmake
    INSTALL_DESTINATION ${grainbench_package_dir}
    NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(
    ${PROJECT_BINARY_DIR}/generated/grainbenchConfigVersion.cmake COMPATIBILITY SameMajorVersion)
install(FILES
    ${PROJECT_BINARY_DIR}/generated/grainbenchConfig.cmake
    ${PROJECT_BINARY_DIR}/generated/grainbenchConfigVersion.cmake
    DESTINATION ${grainbench_package_dir})

foreach(folder IN ITEMS presets share/schema)
    if(EXISTS ${PROJECT_SOURCE_DIR}/${folder})
        install(DIRECTORY ${PROJECT_SOURCE_DIR}/${folder}
            DESTINATION ${CMAKE_INSTALL_DATADIR}/grainbench)
    endif()
endforeach()
