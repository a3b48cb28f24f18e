#version 460
// SPDX-License-Identifier: Apache-2.0
// A fin's smoothie for a texel (gnomon/shared/smoothie_fins.h), packed. The depth test keeps the fin that takes most
// light from the surface that the map shows there.
#extension GL_GOOGLE_include_directive : require
#include "gnomon/lib/fin_pass.glsl"
#include "gnomon/shared/smoothie_fins.h"

layout(set = 1, binding = 0) uniform sampler2DArray map;
layout(location = 0) flat in vec4 ends;
layout(location = 1) flat in vec4 depths;
layout(location = 2) flat in vec2 outward;
layout(location = 0) out uint smoothie;

float depthAt(ivec2 texel)
{
    ivec2 first = ivec2(tile.xy);
    ivec2 last = first + ivec2(2.0 * tile.zw) - 1;
    return texelFetch(map, ivec3(clamp(texel, first, last), int(rule.z)), 0).x;
}

void main()
{
    Fin fin = Fin(ends.xy, ends.zw, outward, depths.x, depths.y, depths.z, depths.w);
    vec2 centre = gl_FragCoord.xy;
    float nearest = finNearest(fin, centre);
    float distance = finDistance(fin, centre, nearest);
    if (distance > rule.x || isBehindFin(fin, centre)) {
        discard;
    }
    ivec2 texel = ivec2(centre);
    float here = depthAt(texel);
    float depth = finDepth(fin, nearest);
    float fall = here - depth;
    if (!isOverSurface(fall, 0.0, distance, rule.y)) {
        discard; // most of them, before their neighbours are read
    }
    vec2 lean = vec2(flatterLean(depthAt(texel - ivec2(1, 0)), here, depthAt(texel + ivec2(1, 0))),
                     flatterLean(depthAt(texel - ivec2(0, 1)), here, depthAt(texel + ivec2(0, 1))));
    if (!isOverSurface(fall, length(lean), distance, rule.y)) {
        discard;
    }
    smoothie = uint(packSmoothie(Smoothie(depth, distance)));
    gl_FragDepth = finOrder(distance, fall);
}
