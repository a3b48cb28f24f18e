# cmake -DCHECKED=FILE -DSPIRV=FILE -DINC=FILE -P embed_spirv.cmake: writes the words of CHECKED to INC as a C++
# initialiser, and renames it to SPIRV. So nothing that spirv-val refused ever has that name.
file(READ ${CHECKED} hex HEX)
# SPIR-V starts with its magic number, in the writer's byte order; glslc writes little endian everywhere.
if(NOT hex MATCHES "^03022307")
    message(FATAL_ERROR "${CHECKED} is no little-endian SPIR-V")
endif()
string(REGEX REPLACE "(..)(..)(..)(..)" "0x\\4\\3\\2\\1," words ${hex})
# Lines of eight words: one line of a megabyte is slow to print should the compiler have to say something.
set(word "0x........,")
string(REGEX REPLACE "(${word}${word}${word}${word}${word}${word}${word}${word})" "\\1\n" words ${words})
file(RENAME ${CHECKED} ${SPIRV})
file(WRITE ${INC} "{${words}}\n")
