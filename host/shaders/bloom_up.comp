// SPDX-License-Identifier: Apache-2.0
// Adds a coarser level of bloom to a level. See bloom_weights.h.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "bloom_tent.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const float kRadius = 1.0;
layout(set = 0, binding = 0) uniform sampler2D coarser; // linear filter, clamped
layout(set = 0, binding = 1, rgba16f) uniform image2D level;

void main()
{
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(at, imageSize(level)))) {
        return;
    }
    imageStore(level, at, vec4(imageLoad(level, at).rgb + tentOf(coarser, at, kRadius), 1.0));
}
