// SPDX-License-Identifier: Apache-2.0
// The first level of bloom: what is above the threshold, halved. See bloom_weights.h.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "bloom_weights.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const bool kAverageFour = false;
layout(constant_id = 1) const float kThreshold = 1.0;
layout(constant_id = 2) const float kKnee = 0.5;
layout(set = 0, binding = 0) uniform sampler2D radiance; // linear filter, clamped
layout(set = 0, binding = 1, rgba16f) uniform writeonly image2D level;

// A pixel of the picture; with supersampling the mean of its four samples.
vec3 pixelAt(ivec2 pixel, ivec2 last)
{
    pixel = clamp(pixel, ivec2(0), last);
    if (kAverageFour) {
        return textureLod(radiance, (vec2(pixel) * 2.0 + 1.0) / vec2(textureSize(radiance, 0)), 0.0).rgb;
    }
    return texelFetch(radiance, pixel, 0).rgb;
}

void main()
{
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(at, imageSize(level)))) {
        return;
    }
    ivec2 last = textureSize(radiance, 0) / (kAverageFour ? 2 : 1) - 1;
    // The four corner boxes of 4 x 4 pixels and the one in the middle, out of 6 x 6.
    vec3 corner[4] = vec3[4](vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0));
    vec3 centre = vec3(0.0);
    for (int y = 0; y < 6; ++y) {
        for (int x = 0; x < 6; ++x) {
            vec3 light = bloomLight(pixelAt(at * 2 - 2 + ivec2(x, y), last), kThreshold, kKnee) / 16.0;
            bool left = x < 4;
            bool right = x >= 2;
            bool top = y < 4;
            bool bottom = y >= 2;
            corner[0] += left && top ? light : vec3(0.0);
            corner[1] += right && top ? light : vec3(0.0);
            corner[2] += left && bottom ? light : vec3(0.0);
            corner[3] += right && bottom ? light : vec3(0.0);
            centre += x > 0 && x < 5 && y > 0 && y < 5 ? light : vec3(0.0);
        }
    }
    float weight = kBloomCentre * bloomCalm(centre);
    vec3 sum = centre * weight;
    for (int i = 0; i < 4; ++i) {
        float w = kBloomCorner * bloomCalm(corner[i]);
        weight += w;
        sum += corner[i] * w;
    }
    imageStore(level, at, vec4(sum / weight, 1.0));
}
