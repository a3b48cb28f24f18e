// SPDX-License-Identifier: Apache-2.0
// GLSL only: what the frame before made of a surface that this frame sees, for passes that join frames.
#ifndef GNOMON_REPROJECTION_GLSL
#define GNOMON_REPROJECTION_GLSL
#include "../shared/sun_steps.h"

// As vulkan/src/mask_history.h fills it.
struct Reprojection {
    vec4 x; // rows that take an eye-relative point of this frame to pixels of the frame before
    vec4 y;
    vec4 w;
    vec4 eye; // xyz: from the eye of the frame before to this one
};

// An earlier picture of a point: a bilinear read of those pixels that show the same surface.
struct Before {
    vec4 sum;
    float shares; // weight of the neighbours that were found, 0 .. 1; 0: not seen
};

void addBefore(sampler2DArray visibility, sampler2DArray distances, ivec3 at, vec2 size, float share, float expected,
               inout Before found)
{
    if (any(lessThan(at.xy, ivec2(0))) || any(greaterThanEqual(vec2(at.xy), size))) {
        return;
    }
    if (isSameSurface(texelFetch(distances, at, 0).r, expected)) {
        found.sum += share * texelFetch(visibility, at, 0);
        found.shares += share;
    }
}

// `p` relative to this frame's eye; `size` of the pictures in pixels; `layer` of the images.
Before fetchBefore(sampler2DArray visibility, sampler2DArray distances, Reprojection r, int layer, vec3 p, vec2 size)
{
    Before found = Before(vec4(0.0), 0.0);
    vec4 point = vec4(p, 1.0);
    float w = dot(r.w, point);
    if (!(w > 0.0)) {
        return found;
    }
    vec2 texel = vec2(dot(r.x, point), dot(r.y, point)) / w - 0.5;
    // A point far off the screen need not be representable as an integer.
    texel = clamp(texel, vec2(-2.0), size + 1.0);
    vec2 cell = floor(texel);
    vec2 part = texel - cell;
    ivec3 first = ivec3(ivec2(cell), layer);
    float expected = length(p + r.eye.xyz);
    addBefore(visibility, distances, first, size, (1.0 - part.x) * (1.0 - part.y), expected, found);
    addBefore(visibility, distances, first + ivec3(1, 0, 0), size, part.x * (1.0 - part.y), expected, found);
    addBefore(visibility, distances, first + ivec3(0, 1, 0), size, (1.0 - part.x) * part.y, expected, found);
    addBefore(visibility, distances, first + ivec3(1, 1, 0), size, part.x * part.y, expected, found);
    return found;
}

#endif
