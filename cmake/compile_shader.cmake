# Compiles a shader with glslc, validates it, and writes its words as a C++ initialiser. For cmake -P, with
#   COMMAND        what compiles SOURCE into OUT.new and lists what that includes in OUT.d, between |
#   VALIDATE       what refuses a wrong OUT.new, between |
#   OUT, SOURCE    OUT.spv and OUT.inc are made; nothing that VALIDATE refused ever has that name
#   CACHE          folder of what was compiled before; empty: nothing is kept
#   ROOT, TOOLS    for its keys: paths below ROOT count as relative, and the tools' versions count
cmake_minimum_required(VERSION 3.25)

# key_of(RESULT FILES...): the name of what this command makes of these files, wherever ROOT and OUT are; empty where one of
# the files is not there.
function(key_of result)
    file(SHA256 ${CMAKE_CURRENT_FUNCTION_LIST_FILE} this)
    string(REPLACE "${OUT}" "" text "${this}|${TOOLS}|${COMMAND}|${VALIDATE}")
    string(REPLACE "${ROOT}/" "" text "${text}")
    foreach(file IN LISTS ARGN)
        cmake_path(ABSOLUTE_PATH file BASE_DIRECTORY ${ROOT} OUTPUT_VARIABLE path)
        if(NOT EXISTS ${path})
            set(${result} "" PARENT_SCOPE)
            return()
        endif()
        file(SHA256 ${path} hash)
        string(APPEND text "|${file} ${hash}")
    endforeach()
    string(SHA256 key "${text}")
    set(${result} ${key} PARENT_SCOPE)
endfunction()

# in_turn(WORDS): runs a command whose words stand between |, and ends with its message where it fails.
function(in_turn words)
    string(REPLACE "|" ";" words "${words}")
    execute_process(COMMAND ${words} RESULT_VARIABLE status)
    if(NOT status EQUAL 0)
        message(FATAL_ERROR "${OUT}: not made")
    endif()
endfunction()

# The list of what it includes is true as long as none of these has changed.
if(CACHE)
    key_of(command)
    if(EXISTS ${CACHE}/${command}.files)
        file(STRINGS ${CACHE}/${command}.files files)
        key_of(key ${files})
    endif()
    if(key AND EXISTS ${CACHE}/${key}.inc AND EXISTS ${CACHE}/${key}.spv)
        file(COPY_FILE ${CACHE}/${key}.spv ${OUT}.spv)
        file(COPY_FILE ${CACHE}/${key}.inc ${OUT}.inc)
        file(TOUCH ${CACHE}/${command}.files ${CACHE}/${key}.spv ${CACHE}/${key}.inc) # what was used is not old
        list(TRANSFORM files PREPEND "${ROOT}/" REGEX "^[^/]")
        list(TRANSFORM files REPLACE " " "\\\\ ")
        list(JOIN files " " files)
        file(WRITE ${OUT}.d "${OUT}.inc: ${files}\n")
        return()
    endif()
endif()

in_turn("${COMMAND}")
in_turn("${VALIDATE}")
file(READ ${OUT}.new hex HEX)
# SPIR-V starts with its magic number, in the writer's byte order; glslc writes little endian everywhere.
if(NOT hex MATCHES "^03022307")
    message(FATAL_ERROR "${OUT}.new is no little-endian SPIR-V")
endif()
string(REGEX REPLACE "(..)(..)(..)(..)" "0x\\4\\3\\2\\1," words ${hex})
# Lines of eight words: one line of a megabyte is slow to print should the compiler have to say something.
set(word "0x........,")
string(REGEX REPLACE "(${word}${word}${word}${word}${word}${word}${word}${word})" "\\1\n" words ${words})
file(RENAME ${OUT}.new ${OUT}.spv)
file(WRITE ${OUT}.inc "{${words}}\n")

if(CACHE)
    file(READ ${OUT}.d files)
    string(REGEX REPLACE "^[^:]*:|\\\\\n|\n" " " files "${files}")
    separate_arguments(files UNIX_COMMAND "${files}")
    list(TRANSFORM files REPLACE "^${ROOT}/" "")
    key_of(key ${files})
    list(JOIN files "\n" lines)
    # Others may be at the same: a file has its name only once it is whole.
    string(RANDOM LENGTH 12 part)
    file(MAKE_DIRECTORY ${CACHE})
    foreach(ending spv inc)
        file(COPY_FILE ${OUT}.${ending} ${CACHE}/${part})
        file(RENAME ${CACHE}/${part} ${CACHE}/${key}.${ending})
    endforeach()
    file(WRITE ${CACHE}/${part} "${lines}\n")
    file(RENAME ${CACHE}/${part} ${CACHE}/${command}.files)
endif()
