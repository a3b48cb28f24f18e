#version 460
// SPDX-License-Identifier: Apache-2.0
// Edges of casters in a map (gnomon/shared/smoothies.h): a smoothie on each texel that has one on some side.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "gnomon/lib/smoothies_pass.glsl"
layout(set = 0, binding = 0) uniform texture2DArray map;
layout(set = 0, binding = 1, r32ui) writeonly uniform uimage2DArray scratch;

float depthAt(ivec2 texel)
{
    return texelFetch(map, ivec3(clamp(texel, tile.xy, tile.zw), area.z), 0).x;
}

void main()
{
    ivec2 texel = area.xy + ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThan(texel, tile.zw))) {
        return;
    }
    float here = depthAt(texel);
    bool found = false;
    for (int i = 0; i < 4; ++i) {
        ivec2 way = (i & 1) == 0 ? ivec2(1, 0) : ivec2(0, 1);
        way = i < 2 ? way : -way;
        found = found || isEdge(depthAt(texel - way), here, depthAt(texel + way), depthAt(texel + 2 * way), rule.x);
    }
    imageStore(scratch, ivec3(texel, kEdgeLayer), uvec4(uint(packSmoothie(Smoothie(here, found ? 0.0 : -1.0)))));
}
