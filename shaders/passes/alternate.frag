#version 460
// SPDX-License-Identifier: Apache-2.0
// Joins what this frame's maps of one position of the sun say with what the frame before made of the other position's.
// Based on: P. Fortier, "Shadow maps for moving light sources", IceFall Games, 2010 (the last paragraphs: maps by turns).
#extension GL_GOOGLE_include_directive : require
#include "../shared/gpu_structs.h"
#include "../shared/sun_steps.h"

layout(set = 0, binding = 0, std140) uniform Constants
{
    GpuConstants gnomon;
};
layout(set = 0, binding = 1) uniform sampler2D depths;
layout(set = 0, binding = 2) uniform sampler2DArray visibility_now;
layout(set = 0, binding = 3) uniform sampler2DArray visibility_before;
layout(set = 0, binding = 4) uniform sampler2DArray distances_before;
layout(push_constant) uniform Before
{
    vec4 x; // rows that take an eye-relative point of this frame to pixels of the frame before
    vec4 y;
    vec4 w;
    vec4 eye;     // xyz: from the eye of the frame before to this one; w: layer of the images
    vec4 weights; // how much the frame before counts for each light
} before;
layout(location = 0) out vec4 visibility;
layout(location = 1) out float distance_now;

// Bilinear, of those pixels that show the same surface. w of the point in the frame before > 0.
void addBefore(ivec2 pixel, float share, float expected, inout vec4 sum, inout float shares)
{
    if (any(lessThan(pixel, ivec2(0))) || any(greaterThanEqual(vec2(pixel), gnomon.screen.size.xy))) {
        return;
    }
    ivec3 at = ivec3(pixel, int(before.eye.w));
    if (isSameSurface(texelFetch(distances_before, at, 0).r, expected)) {
        sum += share * texelFetch(visibility_before, at, 0);
        shares += share;
    }
}

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 now = texelFetch(visibility_now, ivec3(pixel, int(before.eye.w)), 0);
    visibility = now;
    distance_now = 0.0; // the background: no surface
    float depth = texelFetch(depths, pixel, 0).r;
    if (depth == gnomon.screen.view_axis.w) {
        return;
    }
    vec4 ndc = vec4((vec2(pixel) + 0.5) * gnomon.screen.size.zw * 2.0 - 1.0, depth, 1.0);
    vec4 h = vec4(dot(gnomon.screen.eye_x, ndc), dot(gnomon.screen.eye_y, ndc), dot(gnomon.screen.eye_z, ndc), dot(gnomon.screen.eye_w, ndc));
    vec3 p = h.xyz / h.w;
    distance_now = length(p);
    vec4 point = vec4(p, 1.0);
    float w = dot(before.w, point);
    if (!(w > 0.0) || before.weights == vec4(0.0)) {
        return;
    }
    vec2 texel = vec2(dot(before.x, point), dot(before.y, point)) / w - 0.5;
    // What is far off the screen need not be representable as an integer.
    texel = clamp(texel, vec2(-2.0), gnomon.screen.size.xy + 1.0);
    vec2 cell = floor(texel);
    vec2 part = texel - cell;
    ivec2 first = ivec2(cell);
    float expected = length(p + before.eye.xyz);
    vec4 sum = vec4(0.0);
    float shares = 0.0;
    addBefore(first, (1.0 - part.x) * (1.0 - part.y), expected, sum, shares);
    addBefore(first + ivec2(1, 0), part.x * (1.0 - part.y), expected, sum, shares);
    addBefore(first + ivec2(0, 1), (1.0 - part.x) * part.y, expected, sum, shares);
    addBefore(first + ivec2(1, 1), part.x * part.y, expected, sum, shares);
    // A sliver of the surface says nothing of this pixel.
    if (shares > 0.05) {
        visibility = now + (sum / shares - now) * before.weights;
    }
}
