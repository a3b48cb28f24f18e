# gnomon_glsl_texts(TARGET NAMESPACE NAME FROM SPIRV MODULES...): makes an object library with modules of SPIRV, a target of
# gnomon_shaders() in the folder DIRECTORY's build folder, as GLSL 4.50 for OpenGL, by spirv-cross. The generated header
# "TARGET.h" has them in `NAME::kTexts`, by name ("pass.frag"). Specialization constants become
# `#define SPIRV_CROSS_CONSTANT_ID_n`, push constants a uniform block with binding PUSH_BINDING, bindings stay what they are.
include_guard(GLOBAL)

function(gnomon_glsl_texts target)
    cmake_parse_arguments(PARSE_ARGV 1 arg "" "NAMESPACE;FROM;DIRECTORY;PUSH_BINDING" "")
    set(dir ${CMAKE_CURRENT_BINARY_DIR}/${target})
    file(MAKE_DIRECTORY ${dir})
    set(script ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/glsl_text.cmake)
    set(texts)
    set(incs)
    foreach(name IN LISTS arg_UNPARSED_ARGUMENTS)
        set(module ${arg_DIRECTORY}/${arg_FROM}/${name})
        add_custom_command(OUTPUT ${dir}/${name}.inc
            COMMAND ${CMAKE_COMMAND} -DSPIRV_CROSS=${GNOMON_SPIRV_CROSS} -DMODULE=${module}.spv -DOUT=${dir}/${name}.inc
                    -DPUSH_BINDING=${arg_PUSH_BINDING} -P ${script}
            DEPENDS ${module}.inc ${script} ${arg_FROM}_modules VERBATIM COMMENT "spirv-cross ${name}")
        string(APPEND texts "    {\"${name}\",\n#include \"${name}.inc\"\n    },\n")
        list(APPEND incs ${dir}/${name}.inc)
    endforeach()
    list(LENGTH incs count)
    set(begin "namespace ${arg_NAMESPACE} {\n")
    string(CONCAT header "#pragma once\n#include <string_view>\n${begin}struct Text {\n    std::string_view name;\n"
                         "    std::string_view text;\n};\nextern const Text kTexts[${count}];\n}\n")
    file(CONFIGURE OUTPUT ${dir}/${target}.h CONTENT "${header}" @ONLY)
    file(CONFIGURE OUTPUT ${dir}/${target}.cpp
         CONTENT "#include \"${target}.h\"\n${begin}const Text kTexts[${count}] = {\n${texts}};\n}\n" @ONLY)
    set_source_files_properties(${dir}/${target}.cpp PROPERTIES OBJECT_DEPENDS "${incs}")
    add_library(${target} OBJECT ${dir}/${target}.cpp)
    add_custom_target(${target}_made DEPENDS ${incs})
    add_dependencies(${target} ${target}_made)
    target_compile_features(${target} PUBLIC cxx_std_20)
    set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden)
    target_include_directories(${target} PUBLIC ${dir})
endfunction()
