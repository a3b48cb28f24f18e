# gnomon_texts(HEADER NAME FILE...): the files' text, one after the other, as `inline constexpr std::string_view NAME[]` in HEADER of
# the build folder, once gnomon_texts_header(HEADER) is called. In pieces, for compilers need not take longer literals than
# 64 KiB. Whatever the files hold stands there unchanged: no file may have `)text"`.
function(gnomon_texts header name)
    set(pieces "")
    foreach(file ${ARGN})
        set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
        file(READ ${file} text)
        string(LENGTH "${text}" length)
        set(start 0)
        while(start LESS length)
            string(SUBSTRING "${text}" ${start} 50000 piece)
            string(APPEND pieces "    R\"text(${piece})text\",\n")
            math(EXPR start "${start} + 50000")
        endwhile()
    endforeach()
    set_property(DIRECTORY APPEND_STRING PROPERTY GNOMON_TEXTS_${header}
                 "inline constexpr std::string_view ${name}[] = {\n${pieces}};\n")
endfunction()

function(gnomon_texts_header header)
    get_property(texts DIRECTORY PROPERTY GNOMON_TEXTS_${header})
    file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/${header}.new "#pragma once\n#include <string_view>\n${texts}")
    file(COPY_FILE ${CMAKE_CURRENT_BINARY_DIR}/${header}.new ${CMAKE_CURRENT_BINARY_DIR}/${header} ONLY_IF_DIFFERENT)
endfunction()
