// SPDX-License-Identifier: Apache-2.0
// GLSL only: which pixels show the same surface, for passes that blur the mask.
#ifndef GNOMON_SOFTEN_SURFACE_GLSL
#define GNOMON_SOFTEN_SURFACE_GLSL
#include "../shared/gpu_structs.h"
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

layout(constant_id = 0) const int kScale = 1; // pixels to a texel of the images that the blur works in
layout(constant_id = 1) const bool kEdgeAware = true; // edges of surfaces stay sharp
layout(constant_id = 2) const bool kHasNormals = true; // normals is no stand-in
layout(constant_id = 3) const int kKernel = 0; // screen_blur.h
layout(constant_id = 4) const bool kInSoftware = false; // screen_surface.glsl

#define GNOMON_SURFACE_SCREEN gnomon.screen
#define GNOMON_SURFACE_SAMPLED kInSoftware
#include "surface_share.glsl"

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
