# The interpreter of tools and tests, GNOMON_PYTHON: found once, and by its own path. What PATH has may be a script that looks
# for the interpreter at each call, which takes ten times as long as a tool does.
if(NOT GNOMON_PYTHON)
    find_package(Python3 REQUIRED COMPONENTS Interpreter)
    execute_process(COMMAND ${Python3_EXECUTABLE} -c "import sys; print(sys.executable)" OUTPUT_VARIABLE own_path
                    OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
    set(GNOMON_PYTHON ${own_path} CACHE FILEPATH "Python 3, for tools and tests")
endif()
