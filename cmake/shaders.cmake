# Shaders: GLSL compiled to SPIR-V with glslc (Vulkan 1.3), validated, and embedded in C++.
find_program(GLSLC glslc REQUIRED)
find_program(SPIRV_VAL spirv-val REQUIRED)

# gnomon_shader_variants(LIST SOURCE AXIS...): adds to LIST an entry for each variant of SOURCE: for every way to take one
# choice of each axis. An axis is its choices with | between them, a choice is "NAME:DEFINE,DEFINE"; an empty one adds
# nothing. The variant is called after the source and the names taken: pass.frag with "|wide:WIDE" and "a:KIND=1|b:KIND=2"
# makes pass_a.frag, pass_b.frag, pass_wide_a.frag and pass_wide_b.frag.
function(gnomon_shader_variants list source)
    get_filename_component(base ${source} NAME_WE)
    get_filename_component(stage ${source} LAST_EXT)
    set(variants "${base}:")
    foreach(axis IN LISTS ARGN)
        string(REPLACE "|" ";" choices "${axis}")
        set(more)
        foreach(variant IN LISTS variants)
            string(REGEX MATCH "^([^:]*):(.*)$" _ "${variant}")
            set(name "${CMAKE_MATCH_1}")
            set(defines "${CMAKE_MATCH_2}")
            foreach(choice IN LISTS choices)
                if(choice STREQUAL "")
                    list(APPEND more "${name}:${defines}")
                elseif(choice MATCHES "^([a-z0-9_]*):(.*)$")
                    string(JOIN "_" new_name ${name} ${CMAKE_MATCH_1})
                    string(JOIN "," new_defines ${defines} ${CMAKE_MATCH_2})
                    list(APPEND more "${new_name}:${new_defines}")
                else()
                    message(FATAL_ERROR "no choice of a shader's variants: ${choice}")
                endif()
            endforeach()
        endforeach()
        set(variants "${more}")
    endforeach()
    foreach(variant IN LISTS variants)
        string(REGEX MATCH "^([^:]*):(.*)$" _ "${variant}")
        list(APPEND ${list} "${CMAKE_MATCH_1}${stage}:${source}:${CMAKE_MATCH_2}")
    endforeach()
    set(${list} "${${list}}" PARENT_SCOPE)
endfunction()

# gnomon_shaders(TARGET ENTRIES...): makes an object library that embeds each entry as `const std::span<const
# std::uint32_t> gnomon::spirv::NAME` (with dots as underscores), declared in the generated header "TARGET.h", which also
# has all of them in `gnomon::spirv::all_of_TARGET`. An entry is a source, or one of gnomon_shader_variants(). Debug
# builds keep the source's lines and names in the SPIR-V, but for those with sanitizers, which look at C++ alone.
# GNOMON_SPIRV_FROM is another build folder, whose modules are taken as they are. It has to be built already, from the same
# sources, in Release or with sanitizers.
function(gnomon_shaders target)
    set(dir ${CMAKE_CURRENT_BINARY_DIR}/${target})
    set(keep_names)
    if(NOT GNOMON_SANITIZE)
        set(keep_names $<$<CONFIG:Debug>:-g>)
    endif()
    file(RELATIVE_PATH place ${CMAKE_BINARY_DIR} ${CMAKE_CURRENT_BINARY_DIR})
    set(embed ${PROJECT_SOURCE_DIR}/cmake/embed_spirv.cmake)
    file(MAKE_DIRECTORY ${dir})
    set(header "#pragma once\n#include <cstdint>\n#include <span>\nnamespace gnomon::spirv {\n")
    set(words)
    set(spans)
    set(incs)
    set(ids)
    foreach(entry ${ARGN})
        set(defines)
        if(entry MATCHES "^([^:]+):([^:]+):(.*)$")
            set(name ${CMAKE_MATCH_1})
            set(source ${CMAKE_MATCH_2})
            string(REPLACE "," ";" defines "${CMAKE_MATCH_3}")
            list(TRANSFORM defines PREPEND "-D")
        else()
            set(source ${entry})
            get_filename_component(name ${source} NAME)
        endif()
        get_filename_component(source ${source} ABSOLUTE)
        string(MAKE_C_IDENTIFIER ${name} id)
        list(APPEND ids ${id})
        string(APPEND header "extern const std::span<const std::uint32_t> ${id};\n")
        string(APPEND words "constexpr std::uint32_t words_${id}[] =\n#include \"${name}.inc\"\n;\n")
        string(APPEND spans "const std::span<const std::uint32_t> ${id}{words_${id}};\n")
        list(APPEND incs ${dir}/${name}.inc)
        if(GNOMON_SPIRV_FROM)
            set(made ${GNOMON_SPIRV_FROM}/${place}/${target}/${name})
            add_custom_command(
                OUTPUT ${dir}/${name}.inc
                COMMAND ${CMAKE_COMMAND} -E copy ${made}.spv ${dir}/${name}.spv
                COMMAND ${CMAKE_COMMAND} -E copy ${made}.inc ${dir}/${name}.inc
                DEPENDS ${made}.inc VERBATIM COMMENT "copying ${name}")
            continue()
        endif()
        add_custom_command(
            OUTPUT ${dir}/${name}.inc
            COMMAND ${GLSLC} --target-env=vulkan1.3 -O ${keep_names} -Werror ${defines}
                    -I ${PROJECT_SOURCE_DIR}/shaders -I ${PROJECT_SOURCE_DIR}/shaders/include
                    -MD -MF ${dir}/${name}.d -MT ${dir}/${name}.inc
                    -o ${dir}/${name}.spv ${source}
            COMMAND ${SPIRV_VAL} --target-env vulkan1.3 ${dir}/${name}.spv
            COMMAND ${CMAKE_COMMAND} -DSPIRV=${dir}/${name}.spv -DINC=${dir}/${name}.inc -P ${embed}
            DEPENDS ${source} ${embed} DEPFILE ${dir}/${name}.d VERBATIM COMMAND_EXPAND_LISTS COMMENT "glslc ${name}")
    endforeach()
    list(JOIN ids ", &" all)
    list(LENGTH ids count)
    string(APPEND header "inline constexpr const std::span<const std::uint32_t>* all_of_${target}[${count}] = {&${all}};\n")
    file(CONFIGURE OUTPUT ${dir}/${target}.h CONTENT "${header}}\n" @ONLY)
    # One source for all: a compiler takes longer to start than to read a module's words.
    set(cpp "#include \"${target}.h\"\nnamespace gnomon::spirv {\nnamespace {\n${words}}\n${spans}}\n")
    file(CONFIGURE OUTPUT ${dir}/${target}.cpp CONTENT "${cpp}" @ONLY)
    set_source_files_properties(${dir}/${target}.cpp PROPERTIES OBJECT_DEPENDS "${incs}")
    add_library(${target} OBJECT ${dir}/${target}.cpp)
    target_include_directories(${target} PUBLIC ${dir})
endfunction()
