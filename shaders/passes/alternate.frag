#version 460
// SPDX-License-Identifier: Apache-2.0
// Joins what this frame's maps of one position of the sun say with what the frame before made of the other position's.
// Based on: P. Fortier, "Shadow maps for moving light sources", IceFall Games, 2010 (the last paragraphs: maps by turns).
#extension GL_GOOGLE_include_directive : require
#include "gnomon/lib/reprojection.glsl"
#include "gnomon/shared/gpu_structs.h"

layout(set = 0, binding = 0, std140) uniform Constants
{
    GpuConstants gnomon;
};
layout(set = 0, binding = 1) uniform sampler2D depths;
layout(set = 0, binding = 2) uniform sampler2DArray visibility_now;
layout(set = 0, binding = 3) uniform sampler2DArray visibility_before;
layout(set = 0, binding = 4) uniform sampler2DArray distances_before;
layout(push_constant) uniform Push
{
    Reprojection before;
    vec4 weights; // how much the frame before counts for each light
} push;
layout(location = 0) out vec4 visibility;
layout(location = 1) out float distance_now;

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 now = texelFetch(visibility_now, ivec3(pixel, int(push.before.eye.w)), 0);
    visibility = now;
    distance_now = 0.0; // the background: no surface
    float depth = texelFetch(depths, pixel, 0).r;
    if (depth == gnomon.screen.fade.z) {
        return;
    }
    vec4 ndc = vec4((vec2(pixel) + 0.5) * gnomon.screen.size.zw * 2.0 - 1.0, depth, 1.0);
    vec4 h = vec4(dot(gnomon.screen.eye_x, ndc), dot(gnomon.screen.eye_y, ndc), dot(gnomon.screen.eye_z, ndc), dot(gnomon.screen.eye_w, ndc));
    vec3 p = h.xyz / h.w;
    distance_now = length(p);
    if (push.weights == vec4(0.0)) {
        return;
    }
    Before found = fetchBefore(visibility_before, distances_before, push.before, int(push.before.eye.w), p, gnomon.screen.size.xy);
    // A sliver of the surface says nothing of this pixel.
    if (found.shares > 0.05) {
        visibility = now + (found.sum / found.shares - now) * push.weights;
    }
}
