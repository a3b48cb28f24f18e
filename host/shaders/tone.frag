// SPDX-License-Identifier: Apache-2.0
// The tone curve, on the light with what glows added; with supersampling also the average of four samples, after the
// curve, so that edges against bright surfaces stay smooth.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "bloom_tent.glsl"
#include "tone.glsl"

layout(constant_id = 0) const bool kAverageFour = false;
layout(constant_id = 1) const bool kBloom = false;
layout(constant_id = 2) const float kBloomShare = 0.0; // intensity / levels
layout(constant_id = 3) const float kBloomRadius = 1.0;
layout(set = 0, binding = 5) uniform sampler2D radiance;
layout(set = 0, binding = 7) uniform sampler2D glow; // half the size, linear filter, clamped
layout(location = 0) out vec4 out_colour;

// `added` is left out, not 0, where there is no bloom: the picture is the same to the last bit.
vec3 shown(ivec2 sample_at, vec3 added)
{
    vec3 light = texelFetch(radiance, sample_at, 0).rgb;
    return toneOf(kBloom ? light + added : light);
}

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec3 added = vec3(0.0);
    if (kBloom) {
        added = tentOf(glow, pixel, kBloomRadius) * kBloomShare;
    }
    vec3 c;
    if (kAverageFour) {
        pixel *= 2;
        c = shown(pixel, added) + shown(pixel + ivec2(1, 0), added) + shown(pixel + ivec2(0, 1), added) +
            shown(pixel + ivec2(1, 1), added);
        c *= 0.25;
    } else {
        c = shown(pixel, added);
    }
    out_colour = encoded(c, gl_FragCoord.xy);
}
