# gnomon_shaders(TARGET SOURCES...): compiles GLSL entry points to SPIR-V with glslc (Vulkan 1.3), validates them and makes
# an object library that embeds each as `const std::span<const std::uint32_t> gnomon::spirv::NAME` (file name with
# dots as underscores), declared in the generated header "TARGET.h".
find_program(GLSLC glslc REQUIRED)
find_program(SPIRV_VAL spirv-val REQUIRED)
function(gnomon_shaders target)
    set(dir ${CMAKE_CURRENT_BINARY_DIR}/${target})
    set(embed ${PROJECT_SOURCE_DIR}/cmake/embed_spirv.cmake)
    file(MAKE_DIRECTORY ${dir})
    set(header "#pragma once\n#include <cstdint>\n#include <span>\nnamespace gnomon::spirv {\n")
    set(cpps)
    foreach(source ${ARGN})
        get_filename_component(source ${source} ABSOLUTE)
        get_filename_component(name ${source} NAME)
        string(MAKE_C_IDENTIFIER ${name} id)
        string(APPEND header "extern const std::span<const std::uint32_t> ${id};\n")
        set(cpp "#include \"${target}.h\"\nnamespace gnomon::spirv {\nnamespace {\nconstexpr std::uint32_t words[] =\n#include \"${name}.inc\"\n;\n}\nconst std::span<const std::uint32_t> ${id}{words};\n}\n")
        file(CONFIGURE OUTPUT ${dir}/${name}.cpp CONTENT "${cpp}" @ONLY)
        add_custom_command(
            OUTPUT ${dir}/${name}.inc
            COMMAND ${GLSLC} --target-env=vulkan1.3 -O -g -Werror -I ${PROJECT_SOURCE_DIR}/shaders -MD -MF ${dir}/${name}.d
                    -MT ${dir}/${name}.inc -o ${dir}/${name}.spv ${source}
            COMMAND ${SPIRV_VAL} --target-env vulkan1.3 ${dir}/${name}.spv
            COMMAND ${CMAKE_COMMAND} -DSPIRV=${dir}/${name}.spv -DINC=${dir}/${name}.inc -P ${embed}
            DEPENDS ${source} ${embed} DEPFILE ${dir}/${name}.d VERBATIM COMMENT "glslc ${name}")
        set_source_files_properties(${dir}/${name}.cpp PROPERTIES OBJECT_DEPENDS ${dir}/${name}.inc)
        list(APPEND cpps ${dir}/${name}.cpp)
    endforeach()
    file(CONFIGURE OUTPUT ${dir}/${target}.h CONTENT "${header}}\n" @ONLY)
    add_library(${target} OBJECT ${cpps})
    target_include_directories(${target} PUBLIC ${dir})
endfunction()
