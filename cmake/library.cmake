# What a host links: static, or shared with BUILD_SHARED_LIBS. Either shows gnomon/export.h's GNOMON_API alone, and either may
# become a part of a host's own shared library.
if(BUILD_SHARED_LIBS AND NOT CMAKE_SYSTEM_NAME STREQUAL "Linux")
    message(FATAL_ERROR "BUILD_SHARED_LIBS: gnomon is shared on Linux only (gnomon/export.h); take BUILD_SHARED_LIBS=OFF")
endif()

# gnomon_public_names(TARGET COMPONENT): what TARGET is called, and what of a shared one is seen from outside.
# Before 1.0 each minor version may change the ABI: symbols have its number, so that a program with another one is told.
function(gnomon_public_names target component)
    set_target_properties(${target} PROPERTIES
        OUTPUT_NAME gnomon-${component} EXPORT_NAME ${component}
        VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}
        CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON POSITION_INDEPENDENT_CODE ON)
    get_target_property(type ${target} TYPE)
    if(type STREQUAL "SHARED_LIBRARY")
        set(script ${CMAKE_CURRENT_BINARY_DIR}/${target}.map)
        configure_file(${PROJECT_SOURCE_DIR}/cmake/symbols.map.in ${script} @ONLY)
        set_property(TARGET ${target} APPEND PROPERTY LINK_DEPENDS ${script})
        target_link_options(${target} PRIVATE LINKER:--version-script=${script})
        # The sanitizers' own functions come from the program.
        if(NOT GNOMON_SANITIZE)
            target_link_options(${target} PRIVATE LINKER:-z,defs)
        endif()
    endif()
endfunction()

# gnomon_public_library(COMPONENT SOURCES...): the library gnomon_COMPONENT, for hosts gnomon::COMPONENT. Its public headers
# are in include/, and those that C++ and GLSL share in shaders/include; installed, all are in one folder.
function(gnomon_public_library component)
    set(target gnomon_${component})
    add_library(${target} ${ARGN})
    add_library(gnomon::${component} ALIAS ${target})
    target_include_directories(${target}
        PUBLIC $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include> $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/shaders/include>
        PRIVATE src)
    target_compile_features(${target} PUBLIC cxx_std_20)
    # Nobody puts other functions in the place of ours, so that the compiler may look into them.
    target_compile_options(${target} PRIVATE -fno-semantic-interposition)
    target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:gnomon_options>)
    gnomon_public_names(${target} ${component})
endfunction()
