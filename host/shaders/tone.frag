// SPDX-License-Identifier: Apache-2.0
// The tone curve; with supersampling also the average of four samples, after the curve, so that edges against bright
// surfaces stay smooth. Alpha holds the luma, for the pass that smooths edges.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "tone.glsl"

layout(constant_id = 0) const bool kAverageFour = false;
layout(set = 0, binding = 8) uniform sampler2D radiance;
layout(location = 0) out vec4 out_colour;

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec3 c;
    if (kAverageFour) {
        pixel *= 2;
        c = filmic(texelFetch(radiance, pixel, 0).rgb) + filmic(texelFetch(radiance, pixel + ivec2(1, 0), 0).rgb) +
            filmic(texelFetch(radiance, pixel + ivec2(0, 1), 0).rgb) +
            filmic(texelFetch(radiance, pixel + ivec2(1, 1), 0).rgb);
        c *= 0.25;
    } else {
        c = filmic(texelFetch(radiance, pixel, 0).rgb);
    }
    c = encodeSrgb(c);
    out_colour = vec4(c, luma(c));
}
