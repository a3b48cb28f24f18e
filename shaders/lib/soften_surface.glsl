// SPDX-License-Identifier: Apache-2.0
// GLSL only: which pixels show the same surface, for passes that blur the mask.
#ifndef GNOMON_SOFTEN_SURFACE_GLSL
#define GNOMON_SOFTEN_SURFACE_GLSL
#include "../shared/gpu_structs.h"
#include "../shared/octahedral.h"
#include "../shared/screen_blur.h"

layout(set = 0, binding = 0, std140) uniform Constants
{
    GpuConstants gnomon;
};
layout(set = 0, binding = 1) uniform sampler2D depths;
layout(set = 0, binding = 2) uniform sampler2D normals;
layout(set = 0, binding = 3) uniform sampler2DArray source;
layout(set = 0, binding = 4, std140) uniform Points
{
    vec4 points[kDiscPoints / 2]; // two each
};
layout(push_constant) uniform Push
{
    ivec4 sizes; // xy: of the source, the texels in use; zw: of the picture
    ivec4 how;   // x: the source has 1 / x of the picture's size; y: its layer; z: points of the disc
    vec4 along;  // xy: the pass's direction; z: pixels from tap to tap
} push;

layout(constant_id = 0) const int kScale = 1; // of the images that the blur is worked out in
layout(constant_id = 1) const bool kEdgeAware = true;
layout(constant_id = 2) const bool kHasNormals = true;
layout(constant_id = 3) const int kKernel = 0; // screen_blur.h

#define GNOMON_NUMBERS gnomon
#define GNOMON_SURFACE_SCREEN GNOMON_NUMBERS.screen
#include "screen_surface.glsl"

// A pixel's plane. Depth is affine on the screen, so a point is on it where dot(plane, ndc) / dot(eye_w, ndc) = at.
struct Surface {
    vec4 plane;
    float at;
    float px_per_m;
    vec3 n;
};

Surface surfaceAt(ivec2 pixel, float depth)
{
    vec4 h = pointAt(pixel, depth);
    vec3 p = h.xyz / h.w;
    Surface s;
    s.n = kHasNormals ? octahedralDecode(texelFetch(normals, pixel, 0).rg) : normalFromDepth(pixel, depth, p);
    s.plane = s.n.x * gnomon.screen.eye_x + s.n.y * gnomon.screen.eye_y + s.n.z * gnomon.screen.eye_z;
    s.at = dot(s.n, p);
    vec3 right = vec3(gnomon.screen.eye_x.x, gnomon.screen.eye_y.x, gnomon.screen.eye_z.x) * (2.0 * gnomon.screen.size.z);
    s.px_per_m = abs(h.w) / length(right);
    return s;
}

// What another pixel counts for: 0 .. 1.
float shareOf(Surface s, ivec2 pixel)
{
    float depth = texelFetch(depths, pixel, 0).r;
    vec4 ndc = vec4((vec2(pixel) + 0.5) * gnomon.screen.size.zw * 2.0 - 1.0, depth, 1.0);
    float off = abs(dot(s.plane, ndc) / dot(gnomon.screen.eye_w, ndc) - s.at) * s.px_per_m;
    float share = screenDepthShare(off);
    if (kHasNormals) {
        share *= screenNormalShare(dot(s.n, octahedralDecode(texelFetch(normals, pixel, 0).rg)));
    }
    return depth == gnomon.screen.fade.z ? 0.0 : share;
}

ivec2 pixelsOf(ivec2 texel, int scale)
{
    return min(ivec2(pixelOfTexel(texel.x, scale), pixelOfTexel(texel.y, scale)), push.sizes.zw - 1);
}

vec4 sourceTexel(ivec2 texel)
{
    return texelFetch(source, ivec3(texel, push.how.y), 0);
}

// Between texels, by the sampler. `place` in texels; what the image has beyond those in use is not read.
vec4 sourceAt(vec2 place)
{
    vec2 inside = clamp(place, vec2(0.5), vec2(push.sizes.xy) - 0.5);
    return textureLod(source, vec3(inside / vec2(textureSize(source, 0).xy), push.how.y), 0.0);
}

#endif
