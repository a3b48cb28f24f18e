# Run by gnomon_glsl_texts(): one module of SPIR-V as a literal of C++ with its GLSL.
execute_process(COMMAND ${SPIRV_CROSS} ${MODULE} --version 450 --no-es --glsl-emit-push-constant-as-ubo
                OUTPUT_VARIABLE text COMMAND_ERROR_IS_FATAL ANY)
# Push constants are the one block that has no binding.
string(REPLACE "layout(std140) uniform" "layout(binding = ${PUSH_BINDING}, std140) uniform" text "${text}")
file(WRITE ${OUT} "R\"glsl(${text})glsl\"\n")
