// SPDX-License-Identifier: Apache-2.0
// Reads a level of bloom for a texel of the level that is twice as fine.
#ifndef HOST_BLOOM_TENT_GLSL
#define HOST_BLOOM_TENT_GLSL
#include "bloom_weights.h"

vec3 tentOf(sampler2D coarser, ivec2 at, float radius)
{
    vec2 texel = 1.0 / vec2(textureSize(coarser, 0));
    vec2 middle = (vec2(at) + 0.5) * 0.5;
    vec3 sum = vec3(0.0);
    for (int y = -1; y <= 1; ++y) {
        for (int x = -1; x <= 1; ++x) {
            sum += textureLod(coarser, (middle + vec2(x, y) * radius) * texel, 0.0).rgb * bloomTent(x, y);
        }
    }
    return sum;
}

#endif
