# What `cmake --install` puts where. Three components, which are also the Debian packages (cmake/package.cmake): library is what
# a linked program needs, development what a compiler needs, tools is the program.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(gnomon_cmake_dir ${CMAKE_INSTALL_LIBDIR}/cmake/gnomon)

# gnomon_pkg_config(COMPONENT DESCRIPTION LIBS REQUIRES REQUIRES_PRIVATE): gnomon-COMPONENT.pc, which finds the rest from where
# it lies itself, so that an installed tree may be moved.
function(gnomon_pkg_config component description libs requires requires_private)
    set(prefix ${CMAKE_INSTALL_PREFIX})
    if(NOT IS_ABSOLUTE ${CMAKE_INSTALL_LIBDIR})
        file(RELATIVE_PATH up /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
        string(REGEX REPLACE "/$" "" up ${up})
        set(prefix "\${pcfiledir}/${up}")
    endif()
    foreach(dir includedir libdir)
        string(TOUPPER ${dir} name)
        set(${dir} "\${prefix}")
        cmake_path(APPEND ${dir} ${CMAKE_INSTALL_${name}})
    endforeach()
    configure_file(cmake/gnomon.pc.in gnomon-${component}.pc @ONLY)
    install(FILES ${CMAKE_CURRENT_BINARY_DIR}/gnomon-${component}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig
            COMPONENT development)
endfunction()

set(gnomon_libs "-L\${libdir} -lgnomon-")
gnomon_pkg_config(core "Plans of shadow maps" ${gnomon_libs}core glm "")
gnomon_pkg_config(pack "What shaders read of Gnomon's plans" ${gnomon_libs}pack gnomon-core "")
# A program in C that links the static library names the runtime of C++.
set(libs "${gnomon_libs}c")
if(NOT BUILD_SHARED_LIBS)
    string(APPEND libs " ${gnomon_libs}pack ${gnomon_libs}core -lstdc++ -lm")
endif()
gnomon_pkg_config(c "Plans of shadow maps for C" ${libs} "" "")
set(gnomon_components core pack c)
if(GNOMON_VULKAN)
    list(APPEND gnomon_components vulkan vulkan_classics)
    gnomon_pkg_config(vulkan "Soft shadows recorded into Vulkan command buffers" ${gnomon_libs}vulkan gnomon-pack vulkan)
    set(libs "${gnomon_libs}vulkan_classics")
    if(BUILD_SHARED_LIBS) # vulkan/classics/CMakeLists.txt
        set(libs "")
    endif()
    gnomon_pkg_config(vulkan_classics "Classic techniques of soft shadows for Vulkan" "${libs}" gnomon-vulkan "")
endif()
if(GNOMON_GL)
    list(APPEND gnomon_components gl)
    gnomon_pkg_config(gl "Soft shadows drawn by OpenGL 4.5" ${gnomon_libs}gl gnomon-pack "")
endif()
gnomon_pkg_config(shaders "Gnomon's GLSL, in includedir" "" "" "")

foreach(component IN LISTS gnomon_components)
    install(TARGETS gnomon_${component} EXPORT gnomon-${component}
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development
        LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library NAMELINK_COMPONENT development
        INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
    string(REPLACE _ / folder ${component})
    install(DIRECTORY ${folder}/include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development)
endforeach()
install(TARGETS gnomon_glsl EXPORT gnomon-shaders INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(DIRECTORY shaders/include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development)

foreach(component IN LISTS gnomon_components ITEMS shaders)
    install(EXPORT gnomon-${component} NAMESPACE gnomon:: DESTINATION ${gnomon_cmake_dir} COMPONENT development)
endforeach()
# Before 1.0 a minor version may change the interface.
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/gnomon-config-version.cmake
    VERSION ${PROJECT_VERSION} COMPATIBILITY SameMinorVersion)
install(FILES cmake/gnomon-config.cmake cmake/shaders.cmake cmake/compile_shader.cmake
              ${CMAKE_CURRENT_BINARY_DIR}/gnomon-config-version.cmake
        DESTINATION ${gnomon_cmake_dir} COMPONENT development)

install(DIRECTORY examples DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT development PATTERN examples/CMakeLists.txt EXCLUDE)
if(NOT GNOMON_PACKAGE)
    install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT development)
endif()

list(TRANSFORM gnomon_components PREPEND gnomon_ OUTPUT_VARIABLE gnomon_installed)
if(GNOMON_PROGRAM)
    list(APPEND gnomon_installed gnomon)
    install(TARGETS gnomon RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT tools)
    # The program tells its own command lines and manual. Each is built by `all`, since nothing may be built while installing.
    set(told ${CMAKE_CURRENT_BINARY_DIR}/told)
    set(told_files ${told}/gnomon ${told}/_gnomon ${told}/gnomon.fish ${told}/gnomon.1)
    add_custom_command(OUTPUT ${told_files}
        COMMAND ${CMAKE_COMMAND} -E make_directory ${told}
        COMMAND gnomon completion bash > ${told}/gnomon
        COMMAND gnomon completion zsh > ${told}/_gnomon
        COMMAND gnomon completion fish > ${told}/gnomon.fish
        COMMAND gnomon man > ${told}/gnomon.1
        DEPENDS gnomon VERBATIM)
    add_custom_target(gnomon_told ALL DEPENDS ${told_files})
    list(APPEND gnomon_installed gnomon_told)
    install(FILES ${told}/gnomon DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT tools)
    install(FILES ${told}/_gnomon DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions COMPONENT tools)
    install(FILES ${told}/gnomon.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d COMPONENT tools)
    if(NOT GNOMON_PACKAGE) # Debian has it compressed: package.cmake
        install(FILES ${told}/gnomon.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT tools)
    endif()
endif()
# For `make install`, which builds no tests.
add_custom_target(gnomon_installed DEPENDS ${gnomon_installed})

if(BUILD_SHARED_LIBS)
    # Found from where they lie, wherever that is; CMAKE_SKIP_INSTALL_RPATH is for prefixes that the loader knows.
    list(TRANSFORM gnomon_components PREPEND gnomon_ OUTPUT_VARIABLE libraries)
    set_target_properties(${libraries} PROPERTIES INSTALL_RPATH $ORIGIN)
    if(GNOMON_PROGRAM)
        file(RELATIVE_PATH up ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_LIBDIR})
        set_target_properties(gnomon PROPERTIES INSTALL_RPATH $ORIGIN/${up})
    endif()
endif()
