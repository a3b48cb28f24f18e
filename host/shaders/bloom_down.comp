// SPDX-License-Identifier: Apache-2.0
// Halves a level of bloom. See bloom_weights.h.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "bloom_weights.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform sampler2D finer; // linear filter, clamped
layout(set = 0, binding = 1, rgba16f) uniform writeonly image2D level;

void main()
{
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(at, imageSize(level)))) {
        return;
    }
    vec2 texel = 1.0 / vec2(textureSize(finer, 0));
    // Where four texels meet, so that each tap is the mean of four. By texels, not by share of the picture: the last
    // texel of an odd size is as large as the others.
    vec2 middle = vec2(at * 2 + 1);
    vec3 sum = vec3(0.0);
    for (int y = -2; y <= 2; ++y) {
        for (int x = -2; x <= 2; ++x) {
            if (((x ^ y) & 1) == 0) {
                sum += textureLod(finer, (middle + vec2(x, y)) * texel, 0.0).rgb * bloomTap(x, y);
            }
        }
    }
    imageStore(level, at, vec4(sum, 1.0));
}
