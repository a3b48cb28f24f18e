# Registers googletest binaries with ctest: a process for many cases, since opening a device is dearer than most of them.
#
# GNOMON_STAGE chooses cases: "all" (make test, make asan), or one of the two that .ci/run parts them into by stages.txt:
# "release" and "sanitizers". Every case is in one of these at least, as tools/cases.py proves of their results.
find_package(Python3 REQUIRED COMPONENTS Interpreter)
set(GNOMON_STAGE all CACHE STRING "Which cases ctest runs: all, release or sanitizers")
set_property(CACHE GNOMON_STAGE PROPERTY STRINGS all release sanitizers)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/stages.txt)
file(STRINGS ${CMAKE_CURRENT_LIST_DIR}/stages.txt GNOMON_STAGE_LINES REGEX "^[^#]")

# _gnomon_patterns(NAME OUT SECTION...): the patterns that stages.txt has for NAME in these sections, by colons.
function(_gnomon_patterns name out)
    set(section)
    set(patterns)
    foreach(line ${GNOMON_STAGE_LINES})
        if(line MATCHES "^= (.+)$")
            set(section ${CMAKE_MATCH_1})
        elseif(line MATCHES "^${name} +([^ ]+)" AND section IN_LIST ARGN)
            list(APPEND patterns ${CMAKE_MATCH_1})
        endif()
    endforeach()
    list(JOIN patterns ":" patterns)
    set(${out} "${patterns}" PARENT_SCOPE)
endfunction()

# gnomon_test_sources(NAME OUT FOLDER): the sources of test_NAME, but for those without a case in the stage.
function(gnomon_test_sources name out folder)
    file(GLOB sources CONFIGURE_DEPENDS ${folder}/*.cpp)
    if(GNOMON_STAGE STREQUAL "release")
        execute_process(COMMAND ${Python3_EXECUTABLE} -B ${PROJECT_SOURCE_DIR}/tools/stage_sources.py ${name} ${sources}
                        OUTPUT_VARIABLE needed COMMAND_ERROR_IS_FATAL ANY)
        string(REGEX MATCHALL "[^\n]+" needed "${needed}")
        # An executable has a source; that of a binary without cases is built on demand only.
        if(needed)
            set(sources ${needed})
        endif()
    endif()
    set(${out} ${sources} PARENT_SCOPE)
endfunction()

# gnomon_cases(NAME [SHARDS n] [COST n]): the cases of test_NAME that are of the stage, as ctest tests NAME.1 to NAME.n, of
# which each runs every n-th case. Those of a higher COST begin first, so that no processor waits for them at the end. Results are
# written to results/NAME.i.json in the build folder. A binary without a case in the stage is
# built on demand only.
function(gnomon_cases name)
    cmake_parse_arguments(PARSE_ARGV 1 arg "" "SHARDS;COST" "")
    if(NOT arg_SHARDS)
        set(arg_SHARDS 1)
    endif()
    if(NOT arg_COST)
        set(arg_COST 1)
    endif()
    set(filter "*")
    if(GNOMON_STAGE STREQUAL "release")
        _gnomon_patterns(${name} filter "release only" "both")
    elseif(GNOMON_STAGE STREQUAL "sanitizers")
        _gnomon_patterns(${name} without "release only")
        set(filter "*-${without}")
    endif()
    if(filter STREQUAL "")
        set_target_properties(test_${name} PROPERTIES EXCLUDE_FROM_ALL ON)
        return()
    endif()
    foreach(shard RANGE 1 ${arg_SHARDS})
        math(EXPR index "${shard} - 1")
        add_test(NAME ${name}.${shard} COMMAND test_${name})
        set_tests_properties(${name}.${shard} PROPERTIES TIMEOUT 1800 COST ${arg_COST} ENVIRONMENT
            "GTEST_FILTER=${filter};GTEST_TOTAL_SHARDS=${arg_SHARDS};GTEST_SHARD_INDEX=${index};GTEST_OUTPUT=json:${CMAKE_BINARY_DIR}/results/${name}.${shard}.json")
    endforeach()
endfunction()
