#version 460
// SPDX-License-Identifier: Apache-2.0
// mask-size=half: a layer of the mask from one of half its size. Pixels that find nothing there that holds for them are
// discarded. The depth image tells them from those that are done, and mask.frag draws them.
#extension GL_GOOGLE_include_directive : require
#include "gnomon/lib/mask_numbers.glsl"
#include "gnomon/shared/gpu_structs.h"
#include "gnomon/shared/mask_upsample.h"

layout(set = 0, binding = 1) uniform sampler2D depths;
layout(set = 0, binding = 2) uniform sampler2D normals;
layout(set = 0, binding = 3) uniform sampler2DArray source;
layout(constant_id = 0) const bool kHasNormals = true; // normals is no stand-in
layout(set = 0, binding = 4) uniform usampler2D object_ids;
layout(constant_id = 1) const bool kInSoftware = false; // screen_surface.glsl
layout(constant_id = 2) const bool kHasIds = false;     // else object_ids is a stand-in
layout(location = 0) flat in vec4 numbers_in[kScreenNumbers];
GpuScreen screen;
#define GNOMON_SURFACE_SCREEN screen
#define GNOMON_SURFACE_SAMPLED kInSoftware
#include "gnomon/lib/surface_share.glsl"

layout(location = 0) out vec4 visibility;

const int kScale = 2;

vec4 sourceTexel(ivec2 texel, vec2 size)
{
    float layer = numbers_in[kDrawLayer].x;
    return kInSoftware ? textureLod(source, vec3((vec2(texel) + 0.5) / size, layer), 0.0)
                       : texelFetch(source, ivec3(texel, int(layer)), 0);
}

// A surface with the id 0 receives no shadow.
bool receives(ivec2 pixel)
{
    return !kHasIds || GNOMON_SCREEN_TEXEL(object_ids, pixel).r != 0u;
}

void main()
{
#define READ(PLACE, MEMBER) screen.MEMBER = numbers_in[PLACE];
    GNOMON_SCREEN_NUMBERS(READ)
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    visibility = vec4(1.0);
    float depth = GNOMON_SCREEN_TEXEL(depths, pixel).r;
    if (depth == screen.fade.z || !receives(pixel)) {
        return; // lit, and done
    }
    Surface surface = surfaceAt(pixel, depth);
    vec2 size = floor((screen.size.xy + 1.0) / float(kScale));
    ivec2 last_pixel = ivec2(screen.size.xy) - 1;
    vec2 place = vec2(texelOfPixel(pixel.x, kScale), texelOfPixel(pixel.y, kScale));
    vec2 cell = floor(place);
    vec4 sum = vec4(0.0);
    vec4 least = vec4(1.0);
    vec4 most = vec4(0.0);
    float weights = 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 texel = clamp(ivec2(cell) + ivec2(i & 1, i >> 1), ivec2(0), ivec2(size) - 1);
        ivec2 there = min(ivec2(pixelOfTexel(texel.x, kScale), pixelOfTexel(texel.y, kScale)), last_pixel);
        float weight = cornerShare(place - cell, i) * shareOf(surface, there) * (receives(there) ? 1.0 : 0.0);
        vec4 value = sourceTexel(texel, size);
        sum += weight * value;
        weights += weight;
        least = weight > 0.0 ? min(least, value) : least;
        most = weight > 0.0 ? max(most, value) : most;
    }
    vec4 apart = most - least;
    if (!upsampleHolds(weights, max(max(apart.x, apart.y), max(apart.z, apart.w)))) {
        discard;
    }
    visibility = sum / weights;
}
