# Shaders: GLSL compiled to SPIR-V with glslc (Vulkan 1.3), validated, and embedded in C++. Installed beside gnomon's targets,
# for hosts whose shaders include gnomon's.
include_guard(GLOBAL)

# gnomon_shader_variants(LIST SOURCE AXIS...): adds to LIST an entry for each variant of SOURCE: for every way to take one
# choice of each axis. An axis is its choices with | between them, a choice is "NAME:DEFINE,DEFINE"; an empty one adds
# nothing. The variant is called after the source and the names taken: pass.frag with "|wide:WIDE" and "a:KIND=1|b:KIND=2"
# makes pass_a.frag, pass_b.frag, pass_wide_a.frag and pass_wide_b.frag.
function(gnomon_shader_variants gnomon_list source)
    set(entries ${${gnomon_list}}) # before this function has variables that may have the list's name
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
    list(TRANSFORM variants REPLACE "^([^:]*):(.*)$" "\\1${stage}:${source}:\\2")
    set(${gnomon_list} ${entries} ${variants} PARENT_SCOPE)
endfunction()

# gnomon_shaders(TARGET [NAMESPACE NAME] ENTRIES...): makes an object library that embeds each entry as `const std::span<const
# std::uint32_t> NAME::ENTRY` (with dots as underscores), declared in the generated header "TARGET.h", which also has all of
# them in `NAME::all_of_TARGET` and their names ("pass.frag") in `NAME::names_of_TARGET`. Target TARGET_modules makes the SPIR-V files
# TARGET/NAME.spv alone; TARGET/TARGET.txt lists them as "NAME:SOURCE:DEFINE,DEFINE". NAME is TARGET if not given. An entry is a
# source, or one of gnomon_shader_variants().
# Sources find gnomon's GLSL as "gnomon/visibility.glsl". Debug builds keep their lines and names in the SPIR-V, but for those
# with sanitizers, which look at C++ alone.
# GNOMON_SHADER_CACHE is a folder where modules are kept, and taken from by every build of the same sources; empty: none.
function(gnomon_shaders target)
    cmake_parse_arguments(PARSE_ARGV 1 arg "" "NAMESPACE" "")
    if(NOT arg_NAMESPACE)
        set(arg_NAMESPACE ${target})
    endif()
    _gnomon_shader_tools()
    set(dir ${CMAKE_CURRENT_BINARY_DIR}/${target})
    file(MAKE_DIRECTORY ${dir})
    set(begin "namespace ${arg_NAMESPACE} {\n")
    set(header "#pragma once\n#include <cstdint>\n#include <span>\n${begin}")
    set(words)
    set(spans)
    set(incs)
    set(ids)
    set(names)
    set(listed)
    foreach(entry IN LISTS arg_UNPARSED_ARGUMENTS)
        set(defines)
        if(entry MATCHES "^([^:]+):([^:]+):(.*)$")
            set(name ${CMAKE_MATCH_1})
            set(source ${CMAKE_MATCH_2})
            string(REPLACE "," ";" defines "${CMAKE_MATCH_3}")
        else()
            set(source ${entry})
            get_filename_component(name ${source} NAME)
        endif()
        string(MAKE_C_IDENTIFIER ${name} id)
        list(APPEND ids ${id})
        list(APPEND names "\"${name}\"")
        list(JOIN defines "," said)
        string(APPEND listed "${name}:${source}:${said}\n")
        string(APPEND header "extern const std::span<const std::uint32_t> ${id};\n")
        string(APPEND words "constexpr std::uint32_t words_${id}[] =\n#include \"${name}.inc\"\n;\n")
        string(APPEND spans "const std::span<const std::uint32_t> ${id}{words_${id}};\n")
        list(APPEND incs ${dir}/${name}.inc)
        _gnomon_compile_shader(${target} ${name} ${source} ${defines})
    endforeach()
    list(JOIN ids ", &" all)
    list(LENGTH ids count)
    string(APPEND header "inline constexpr const std::span<const std::uint32_t>* all_of_${target}[${count}] = {&${all}};\n")
    list(JOIN names ", " names)
    string(APPEND header "inline constexpr const char* names_of_${target}[${count}] = {${names}};\n")
    file(CONFIGURE OUTPUT ${dir}/${target}.h CONTENT "${header}}\n" @ONLY)
    file(CONFIGURE OUTPUT ${dir}/${target}.txt CONTENT "${listed}" @ONLY)
    # One source for all: a compiler takes longer to start than to read a module's words.
    set(cpp "#include \"${target}.h\"\n${begin}namespace {\n${words}}\n${spans}}\n")
    file(CONFIGURE OUTPUT ${dir}/${target}.cpp CONTENT "${cpp}" @ONLY)
    set_source_files_properties(${dir}/${target}.cpp PROPERTIES OBJECT_DEPENDS "${incs}")
    add_library(${target} OBJECT ${dir}/${target}.cpp)
    # The modules alone: for a program that takes them while it runs.
    add_custom_target(${target}_modules DEPENDS ${incs})
    add_dependencies(${target} ${target}_modules)
    target_compile_features(${target} PUBLIC cxx_std_20)
    set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
    target_include_directories(${target} PUBLIC ${dir})
endfunction()

# They are looked for where the first shader is: who compiles none needs none.
function(_gnomon_shader_tools)
    find_program(GNOMON_GLSLC glslc HINTS ENV VULKAN_SDK PATH_SUFFIXES bin)
    find_program(GNOMON_SPIRV_VAL spirv-val HINTS ENV VULKAN_SDK PATH_SUFFIXES bin)
    foreach(tool GLSLC SPIRV_VAL)
        if(NOT GNOMON_${tool})
            message(FATAL_ERROR "gnomon_shaders: compiling shaders needs glslc and spirv-val, and one of them was not found; "
                                "install them (Debian: glslc, spirv-tools), or set GNOMON_${tool}")
        endif()
    endforeach()
    set(versions none)
    if(GNOMON_SHADER_CACHE)
        execute_process(COMMAND ${GNOMON_GLSLC} --version OUTPUT_VARIABLE compiler)
        execute_process(COMMAND ${GNOMON_SPIRV_VAL} --version OUTPUT_VARIABLE validator)
        string(SHA256 versions "${compiler}${validator}")
        if(CMAKE_HOST_UNIX) # what nobody has used for two weeks goes
            execute_process(COMMAND find ${GNOMON_SHADER_CACHE} -type f -mtime +13 -delete OUTPUT_QUIET ERROR_QUIET)
        endif()
    endif()
    set(GNOMON_SHADER_TOOLS ${versions} PARENT_SCOPE)
endfunction()

# _gnomon_compile_shader(TARGET NAME SOURCE DEFINES...): the rule that makes TARGET/NAME.inc, the words of the module.
function(_gnomon_compile_shader target name source)
    set(out ${CMAKE_CURRENT_BINARY_DIR}/${target}/${name})
    set(compile ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/compile_shader.cmake)
    get_filename_component(source ${source} ABSOLUTE)
    set(keep_names)
    if(NOT GNOMON_SANITIZE)
        set(keep_names "$<$<CONFIG:Debug>:|-g>")
    endif()
    set(defines ${ARGN})
    list(TRANSFORM defines PREPEND "|-D")
    list(JOIN defines "" defines)
    set(root ${gnomon_SOURCE_DIR})
    if(NOT root) # of an installed library
        set(root ${CMAKE_SOURCE_DIR})
    endif()
    set(includes $<TARGET_PROPERTY:gnomon::shaders,INTERFACE_INCLUDE_DIRECTORIES>)
    set(glslc "${GNOMON_GLSLC}|--target-env=vulkan1.3|-O${keep_names}|-Werror${defines}|-I$<JOIN:${includes},|-I>")
    # Lines and names, which Debug keeps, have the folder's name.
    set(cache "$<$<NOT:$<CONFIG:Debug>>:${GNOMON_SHADER_CACHE}>")
    if(GNOMON_SANITIZE)
        set(cache "${GNOMON_SHADER_CACHE}")
    endif()
    add_custom_command(
        OUTPUT ${out}.inc
        COMMAND ${CMAKE_COMMAND} "-DCOMMAND=${glslc}|-MD|-MF|${out}.d|-MT|${out}.inc|-o|${out}.new|${source}"
                "-DVALIDATE=${GNOMON_SPIRV_VAL}|--target-env|vulkan1.3|${out}.new" -DOUT=${out} "-DCACHE=${cache}"
                -DROOT=${root} -DTOOLS=${GNOMON_SHADER_TOOLS} -P ${compile}
        DEPENDS ${source} ${compile} DEPFILE ${out}.d VERBATIM COMMENT "glslc ${name}")
endfunction()
