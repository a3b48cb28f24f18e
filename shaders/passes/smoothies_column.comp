#version 460
// SPDX-License-Identifier: Apache-2.0
// Widens the result of smoothies_row.comp along y: each texel gets the edge that cuts off most light from the surface
// that it holds.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "gnomon/lib/smoothies_pass.glsl"
layout(set = 0, binding = 0) uniform texture2DArray map;
layout(set = 0, binding = 1, r32ui) readonly uniform uimage2DArray scratch;
layout(set = 0, binding = 2, r32ui) writeonly uniform uimage2DArray smoothies;

void main()
{
    ivec2 texel = area.xy + ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThan(texel, tile.zw))) {
        return;
    }
    float here = texelFetch(map, ivec3(texel, area.z), 0).x;
    float reach = float(area.w) + 0.5;
    Smoothie chosen = Smoothie(1.0, -1.0);
    float fall = 0.0;
    int last = min(texel.y + area.w, tile.w);
    for (int y = max(texel.y - area.w, tile.y); y <= last; ++y) {
        Smoothie edge = unpackSmoothie(int(imageLoad(scratch, ivec3(texel.x, y, kRowLayer)).x));
        float dy = float(y - texel.y);
        bool counts = edge.distance >= 0.0 && edge.distance * edge.distance + dy * dy <= reach * reach;
        float lower = here - edge.depth;
        float far = edgeDistance(edge.distance, dy);
        if (counts && lower > 2.0 * rule.x && (chosen.distance < 0.0 || outweighs(far, lower, chosen.distance, fall))) {
            chosen = Smoothie(edge.depth, far);
            fall = lower;
        }
    }
    imageStore(smoothies, ivec3(texel, area.z), uvec4(uint(packSmoothie(chosen))));
}
