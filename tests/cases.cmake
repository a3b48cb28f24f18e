# Registers googletest binaries with ctest: a process for many cases, since opening a device is dearer than most of them.
#
# tests/stages.txt names what is long: such cases are ctest tests of their own with the label `long`, and not
# run under sanitizers. GNOMON_RAN_IN is the folder of results of a run in another build, usually Release: what drew there is
# left out here (.ci/run, sanitizers).
include(${PROJECT_SOURCE_DIR}/cmake/python.cmake)
set(GNOMON_RAN_IN "" CACHE PATH "Results of another build's tests: cases that drew there are left out; empty: all are run")
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/stages.txt)
set(ran_in)
if(GNOMON_RAN_IN)
    set(ran_in --ran-in ${GNOMON_RAN_IN})
endif()
# A line for each test: NAME FILTER LONG, and a line for each source that has no case to run.
execute_process(COMMAND ${GNOMON_PYTHON} -B ${PROJECT_SOURCE_DIR}/tools/cases.py choose ${ran_in}
                OUTPUT_VARIABLE GNOMON_CASES COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "[^\n]+" GNOMON_CASES "${GNOMON_CASES}")

# gnomon_test_sources(OUT FOLDER): the sources of a test binary, but for those without a case to run.
function(gnomon_test_sources out folder)
    file(GLOB sources CONFIGURE_DEPENDS ${folder}/*.cpp)
    list(TRANSFORM GNOMON_CASES REPLACE "^unused (.*)$" "${PROJECT_SOURCE_DIR}/\\1" OUTPUT_VARIABLE unused)
    list(REMOVE_ITEM sources ${unused})
    set(${out} ${sources} PARENT_SCOPE)
endfunction()

# gnomon_cases(NAME [SHARDS n] [COST n]): the cases of test_NAME as ctest tests NAME.1 to NAME.n, of which each runs every
# n-th case, and those that are long as NAME.long. Those of a higher COST begin first, so that no processor waits for them
# at the end. Results are written to results/NAME.i.json in the build folder.
function(gnomon_cases name)
    cmake_parse_arguments(PARSE_ARGV 1 arg "" "SHARDS;COST" "")
    if(NOT arg_SHARDS)
        set(arg_SHARDS 1)
    endif()
    if(NOT arg_COST)
        set(arg_COST 1)
    endif()
    target_link_libraries(test_${name} PRIVATE gnomon_case_costs)
    # Sanitizers double what compiling takes, and optimising does again. These five have arithmetic by the million.
    if(GNOMON_SANITIZE AND NOT name MATCHES "^(core|shaders|scene|worlds|truth)$")
        target_compile_options(test_${name} PRIVATE -O0)
    endif()
    set(without)
    foreach(line ${GNOMON_CASES})
        if(line MATCHES "^(long|without) ${name} (.*)$")
            set(${CMAKE_MATCH_1} ${CMAKE_MATCH_2})
        endif()
    endforeach()
    foreach(shard RANGE 1 ${arg_SHARDS})
        math(EXPR index "${shard} - 1")
        add_test(NAME ${name}.${shard} COMMAND test_${name})
        set_tests_properties(${name}.${shard} PROPERTIES TIMEOUT 1800 COST ${arg_COST} ENVIRONMENT
            "GTEST_FILTER=*-${without};GTEST_TOTAL_SHARDS=${arg_SHARDS};GTEST_SHARD_INDEX=${index};GTEST_OUTPUT=json:${CMAKE_BINARY_DIR}/results/${name}.${shard}.json")
    endforeach()
    if(long AND NOT GNOMON_SANITIZE)
        add_test(NAME ${name}.long COMMAND test_${name})
        set_tests_properties(${name}.long PROPERTIES TIMEOUT 1800 LABELS long ENVIRONMENT
            "GTEST_FILTER=${long};GTEST_OUTPUT=json:${CMAKE_BINARY_DIR}/results/${name}.long.json")
    endif()
endfunction()
