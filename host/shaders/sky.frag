// SPDX-License-Identifier: Apache-2.0
// A gradient from zenith over horizon to ground, with the sun in it, and the moon where there is one.
// OVER_SURFACE: laid over a surface that fades into it.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "screen_numbers.glsl"
#include "sky_numbers.glsl"
#include "ray.glsl"
#include "shown.glsl"

#ifdef OVER_SURFACE
layout(location = kScreenShare) in float share;
#else
const float share = 1.0;
#endif
layout(location = 0) out vec4 out_light;

void main()
{
    vec3 d = normalize(sightThrough(gl_FragCoord.xy));
    vec3 sky = mix(SKY_HORIZON, SKY_ZENITH, pow(clamp(d.y, 0.0, 1.0), 0.4));
    // Haze: what is below the horizon takes on the ground's colour slowly and never wholly.
    sky = mix(sky, SKY_GROUND, 0.65 * smoothstep(0.0, 0.8, -d.y));
    sky *= 0.75; // as a backdrop it would outshine what it lights, whose colours are mostly dark
    for (uint i = 0; i < min(frame.counts.x, 2u); ++i) {
        if (frame.lights[i].place.w > 0.5) {
            continue;
        }
        float c = dot(d, frame.lights[i].place.xyz);
        // Cosine of a disc twice the sun's, and a halo.
        float disc = smoothstep(0.99985, 0.99992, c);
        float halo = 0.25 * pow(max(c, 0.0), 400.0) + 0.12 * pow(max(c, 0.0), 24.0);
        sky += frame.lights[i].colour.rgb * (disc * 4.0 + halo);
    }
    out_light = shown(sky, share);
}
