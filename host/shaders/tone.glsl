// SPDX-License-Identifier: Apache-2.0
// From linear radiance to what a screen is sent.
#ifndef HOST_TONE_GLSL
#define HOST_TONE_GLSL

// Filmic curve: K. Narkowicz, "ACES Filmic Tone Mapping Curve", 2015. Exposure is chosen for this curve (frame_data.cpp).
vec3 filmic(vec3 x)
{
    return clamp((x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0);
}

// IEC 61966-2-1.
vec3 encodeSrgb(vec3 c)
{
    vec3 low = c * 12.92;
    vec3 high = 1.055 * pow(max(c, vec3(1e-8)), vec3(1.0 / 2.4)) - 0.055;
    return mix(high, low, lessThanEqual(c, vec3(0.0031308)));
}

float luma(vec3 encoded) { return dot(encoded, vec3(0.2126, 0.7152, 0.0722)); }

#endif
