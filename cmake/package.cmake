# CPack: the three Debian packages libgnomon0, libgnomon-dev and gnomon. `make package` configures for them by the preset
# "package": a shared library, a folder of a system, GNOMON_PACKAGE.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME gnomon)
set(CPACK_PACKAGE_VENDOR "The Gnomon authors")
set(CPACK_PACKAGE_CONTACT "The Gnomon authors <gnomon@packages.invalid>" CACHE STRING "The Debian packages' maintainer")
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_COMPONENTS_ALL library development)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(same_version "(= ${PROJECT_VERSION})")

set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "") # each package has its own, in its description's first line
set(about "Gnomon turns a frame (camera, lights, bounds of objects) into one visibility
value per pixel and light: shadow maps of all kinds, or shadow volumes, planned
on the CPU and recorded into the caller's Vulkan 1.3 command buffers.")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME libgnomon${PROJECT_VERSION_MAJOR})
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_LIBRARY_DESCRIPTION "real-time soft shadows - shared libraries\n${about}")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SHLIBDEPS ON)
# Programs depend on the very version that they were linked with, for as long as each may change the ABI.
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS_POLICY "=")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/packaging/debian/triggers)

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libgnomon-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION "real-time soft shadows - development files\n${about}

C, C++ and GLSL headers, files for CMake and pkg-config, and examples.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
    "${CPACK_DEBIAN_LIBRARY_PACKAGE_NAME} ${same_version}, libglm-dev")
if(GNOMON_VULKAN)
    string(APPEND CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS ", libvulkan-dev (>= 1.3)")
endif()
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_RECOMMENDS "glslc, spirv-tools")

if(GNOMON_PROGRAM)
    list(APPEND CPACK_COMPONENTS_ALL tools)
    set(CPACK_DEBIAN_TOOLS_PACKAGE_NAME gnomon)
    set(CPACK_DEBIAN_TOOLS_PACKAGE_SECTION graphics)
    set(CPACK_DEBIAN_TOOLS_DESCRIPTION "real-time soft shadows - the program that draws and measures them\n${about}

The program gnomon renders glTF files and built-in worlds with every technique,
and holds each against ray-traced shadows.")
    set(CPACK_DEBIAN_TOOLS_PACKAGE_SHLIBDEPS ON)
    set(CPACK_DEBIAN_TOOLS_PACKAGE_DEPENDS "${CPACK_DEBIAN_LIBRARY_PACKAGE_NAME} ${same_version}")
    set(CPACK_DEBIAN_TOOLS_PACKAGE_RECOMMENDS "mesa-vulkan-drivers | vulkan-icd, fonts-dejavu-core")
    set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS
        ${CMAKE_BINARY_DIR}/core ${CMAKE_BINARY_DIR}/pack ${CMAKE_BINARY_DIR}/vulkan)
endif()

if(GNOMON_PACKAGE)
    # Policy asks each package for its licence and its changes.
    find_program(GNOMON_GZIP gzip REQUIRED)
    set(changes ${CMAKE_CURRENT_BINARY_DIR}/changelog.gz)
    set(debian ${PROJECT_SOURCE_DIR}/packaging/debian)
    add_custom_command(OUTPUT ${changes} COMMAND ${GNOMON_GZIP} -9cn ${debian}/changelog > ${changes}
                       DEPENDS ${debian}/changelog VERBATIM)
    add_custom_target(gnomon_changes ALL DEPENDS ${changes})
    if(GNOMON_PROGRAM)
        set(manual ${CMAKE_CURRENT_BINARY_DIR}/told/gnomon.1)
        add_custom_command(OUTPUT ${manual}.gz COMMAND ${GNOMON_GZIP} -9cn ${manual} > ${manual}.gz DEPENDS ${manual} VERBATIM)
        add_custom_target(gnomon_manual ALL DEPENDS ${manual}.gz)
        install(FILES ${manual}.gz DESTINATION share/man/man1 COMPONENT tools)
    endif()
    foreach(component IN LISTS CPACK_COMPONENTS_ALL)
        string(TOUPPER ${component} name)
        set(doc share/doc/${CPACK_DEBIAN_${name}_PACKAGE_NAME})
        install(FILES ${debian}/copyright ${changes} DESTINATION ${doc} COMPONENT ${component})
    endforeach()
endif()

if(PROJECT_IS_TOP_LEVEL)
    include(CPack)
endif()
