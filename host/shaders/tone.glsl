// SPDX-License-Identifier: Apache-2.0
// From linear radiance to what a screen is sent.
#ifndef HOST_TONE_GLSL
#define HOST_TONE_GLSL
#include "tone_curve.h"

layout(constant_id = 24) const bool kFilmic = false; // ToneCurve
layout(constant_id = 25) const bool kDither = false;

vec3 toneOf(vec3 light) { return kFilmic ? filmicTone(light) : neutralTone(light); }

// IEC 61966-2-1.
vec3 encodeSrgb(vec3 c)
{
    vec3 low = c * 12.92;
    vec3 high = 1.055 * pow(max(c, vec3(1e-8)), vec3(1.0 / 2.4)) - 0.055;
    return mix(high, low, lessThanEqual(c, vec3(0.0031308)));
}

float luma(vec3 encoded) { return dot(encoded, vec3(0.2126, 0.7152, 0.0722)); }

// The output for a pixel; alpha holds the luma, for the pass that smooths edges. Each channel has noise of its own.
vec4 encoded(vec3 toned, vec2 pixel)
{
    vec3 c = encodeSrgb(toned);
    float bright = luma(c);
    if (kDither) {
        c.r = dithered(c.r, gradientNoise(pixel));
        c.g = dithered(c.g, gradientNoise(pixel + vec2(47.0, 17.0)));
        c.b = dithered(c.b, gradientNoise(pixel + vec2(13.0, 83.0)));
    }
    return vec4(c, bright);
}

#endif
