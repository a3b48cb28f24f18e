// SPDX-License-Identifier: Apache-2.0
// The mean of 4 x 4 texels of ambient occlusion that lie on one surface. A texel stands for the pixel in the middle of
// what it averages: pixel 2 i - 1.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "screen_numbers.glsl"
#include "ray.glsl"
#include "gnomon/shared/octahedral.h"
#include "occlusion_texel.glsl"

layout(set = 0, binding = 1) uniform sampler2D depths;
layout(set = 0, binding = 9) uniform sampler2D normals;
layout(set = 0, binding = 10) uniform usampler2D searched;
layout(location = 0) out uint out_seen;

void main()
{
    vec2 size = vec2(textureSize(depths, 0));
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec2 middle = clamp(vec2(at * 2) - 0.5, vec2(0.5), size - 0.5);
    float stored = textureLod(depths, middle / size, 0.0).r;
    float view_depth = viewDepthOf(stored, FRAME_DEPTH.x * stored + FRAME_DEPTH.y);
    vec3 p = pointOn(middle, view_depth);
    vec3 normal = octahedralDecode(textureLod(normals, middle / size, 0.0).xy);
    float tolerance = surfaceTolerance(view_depth);
    float sum = 0.0;
    float weight = 0.0;
    for (int i = 0; i < 4; ++i) {
        vec2 corner = vec2(at) + vec2((i & 1) * 2 - 1, (i >> 1) * 2 - 1);
        uvec4 texels = textureGather(searched, corner / vec2(textureSize(searched, 0)));
        vec4 x = 2.0 * (corner.x + vec4(-1.0, 0.0, 0.0, -1.0)) + 0.5; // in the order that a gather has
        vec4 y = 2.0 * (corner.y + vec4(0.0, 0.0, -1.0, -1.0)) + 0.5;
        vec4 weights = surfaceWeights(p, normal, x, y, depthOfTexels(texels), tolerance);
        sum += dot(weights, seenOfTexels(texels));
        weight += dot(weights, vec4(1.0));
    }
    out_seen = packSeen(view_depth, stored > 0.0 ? sum / weight : 1.0); // the sky has no normal
}
