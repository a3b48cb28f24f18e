# Warnings, sanitizers and the compiler cache, for every target of the project.
find_program(GNOMON_CCACHE ccache)
if(GNOMON_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
    # It goes by the includes that the compiler names, in place of preprocessing each source that it has not, and holds
    # what it has compiled for every checkout, wherever that lies.
    set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_DEPEND=true CCACHE_NOHASHDIR=true
                                    CCACHE_BASEDIR=${PROJECT_SOURCE_DIR} ${GNOMON_CCACHE})
endif()
# Where there is such a cache, shaders are kept as well (cmake/shaders.cmake).
set(folder "")
if(GNOMON_CCACHE AND PROJECT_IS_TOP_LEVEL AND DEFINED ENV{HOME})
    set(folder $ENV{HOME}/.cache/gnomon-build/shaders)
endif()
set(GNOMON_SHADER_CACHE "${folder}" CACHE PATH "Folder where compiled shaders are kept for further builds; empty: none")

add_library(gnomon_options INTERFACE)
target_compile_options(gnomon_options INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
                                                -Wnon-virtual-dtor -Woverloaded-virtual)
# What an initialiser leaves out is zero in C++, and Vulkan's structs are made to be filled in that way.
target_compile_options(gnomon_options INTERFACE -Wno-missing-field-initializers)
# At -O3, GCC 12 sees overlapping copies in std::string's operator+ that are not there (its bug 105651).
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    target_compile_options(gnomon_options INTERFACE $<$<CONFIG:Release>:-Wno-restrict>)
endif()
if(GNOMON_WERROR)
    target_compile_options(gnomon_options INTERFACE -Werror)
endif()
# Bit-for-bit the same plan on every compiler: no fused multiply-add unless the code says so.
target_compile_options(gnomon_options INTERFACE -ffp-contract=off)
# GCC looks for memory to reuse whenever it has taken some 100 MB more: a tenth of the time that sources compiled together
# take. They stay below 2 GB without.
if(GNOMON_UNITY AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    add_compile_options("SHELL:--param ggc-min-expand=1000" "SHELL:--param ggc-min-heapsize=2000000")
endif()
if(GNOMON_SANITIZE)
    add_compile_options(-fsanitize=${GNOMON_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
    add_link_options(-fsanitize=${GNOMON_SANITIZE})
endif()
# A fuzzer follows what its input does in everything that is compiled here; only its own binary has libFuzzer's main().
if(GNOMON_FUZZ)
    if(NOT CMAKE_CXX_COMPILER_ID MATCHES "Clang")
        message(FATAL_ERROR "GNOMON_FUZZ needs clang++: configure with --preset fuzz")
    endif()
    add_compile_options(-fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
    add_link_options(-fsanitize=address,undefined)
endif()

# gnomon_library(NAME SOURCES...): a part of the program: a static library with the project's options.
function(gnomon_library name)
    add_library(${name} STATIC ${ARGN})
    target_link_libraries(${name} PRIVATE gnomon_options)
endfunction()
