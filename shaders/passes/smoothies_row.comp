#version 460
// SPDX-License-Identifier: Apache-2.0
// The edges of smoothies_edges.comp, made wide along x: each texel gets the edge of its row that is nearest to it, of
// two as near the one nearer to the light.
#extension GL_GOOGLE_include_directive : require
#include "gnomon/lib/smoothies_pass.glsl"
layout(set = 0, binding = 0, r32ui) uniform uimage2DArray scratch;

Smoothie edgeAt(int x, int y)
{
    int inside = clamp(x, tile.x, tile.z);
    Smoothie edge = unpackSmoothie(int(imageLoad(scratch, ivec3(inside, y, kEdgeLayer)).x));
    edge.distance = inside == x ? edge.distance : -1.0;
    return edge;
}

void main()
{
    ivec2 texel = area.xy + ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThan(texel, tile.zw))) {
        return;
    }
    Smoothie nearest = Smoothie(1.0, -1.0);
    for (int far = 0; far <= area.w && nearest.distance < 0.0; ++far) {
        Smoothie left = edgeAt(texel.x - far, texel.y);
        Smoothie right = edgeAt(texel.x + far, texel.y);
        bool is_left = left.distance >= 0.0 && (right.distance < 0.0 || left.depth < right.depth);
        nearest = is_left ? left : right;
        nearest.distance = nearest.distance < 0.0 ? -1.0 : float(far);
    }
    imageStore(scratch, ivec3(texel, kRowLayer), uvec4(uint(packSmoothie(nearest))));
}
