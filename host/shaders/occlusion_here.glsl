// SPDX-License-Identifier: Apache-2.0
// Ambient occlusion of a pixel of the picture, from the image of half its size.
#ifndef HOST_OCCLUSION_HERE_GLSL
#define HOST_OCCLUSION_HERE_GLSL
#include "gnomon/shared/octahedral.h"
#include "occlusion_texel.glsl"

layout(set = 0, binding = 9) uniform sampler2D normals;
layout(set = 0, binding = 11) uniform usampler2D occlusion; // occlusion_smooth.frag

float seenHere(vec3 p, float view_depth)
{
    vec3 normal = octahedralDecode(texelHere(normals).xy);
    vec2 pixel = floor(gl_FragCoord.xy);
    vec2 first = floor((pixel + 1.0) * 0.5);
    vec2 corner = first + 1.0;
    uvec4 texels = textureGather(occlusion, corner / vec2(textureSize(occlusion, 0)));
    vec2 share = fract((pixel + 1.0) * 0.5); // 0 or 1/2
    vec4 column = vec4(0.0, 1.0, 1.0, 0.0); // in the order that a gather has
    vec4 row = vec4(1.0, 1.0, 0.0, 0.0);
    vec4 weights = abs(1.0 - column - share.x) * abs(1.0 - row - share.y);
    vec4 x = 2.0 * (first.x + column) - 0.5;
    vec4 y = 2.0 * (first.y + row) - 0.5;
    weights *= surfaceWeights(p, normal, x, y, depthOfTexels(texels), surfaceTolerance(view_depth));
    return dot(weights, seenOfTexels(texels)) / dot(weights, vec4(1.0));
}

#endif
