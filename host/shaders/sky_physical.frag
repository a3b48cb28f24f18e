// SPDX-License-Identifier: Apache-2.0
// A sky of air, with the discs of sun and moon, and stars.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "screen_numbers.glsl"
#include "ray.glsl"
#define FRAME_SKY(I) SCREEN_NUMBER(kScreenSky + (I), sky[I])
#include "sky.glsl"
#include "shown.glsl"

layout(location = 0) out vec4 out_light;

// A disc with a soft rim of a tenth of its radius.
vec3 discOf(int body, vec3 d)
{
    float rim = 0.2 * (1.0 - SKY_DISC(body).w);
    return SKY_DISC(body).rgb * smoothstep(-rim, rim, dot(d, SKY_BODY(body).xyz) - SKY_DISC(body).w);
}

uvec3 scrambled(uvec3 v) // M. Jarzynski, M. Olano, "Hash Functions for GPU Rendering", 2020: pcg3d
{
    v = v * 1664525u + 1013904223u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v ^= v >> 16u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    return v;
}

// A star in some of the cells of a cube about the eye. It is as wide as a pixel, however large that is, and never
// dimmer for it.
vec3 starsAt(vec3 d)
{
    const float kCells = 56.0; // on an edge
    vec3 a = abs(d);
    int axis = a.x > a.y && a.x > a.z ? 0 : (a.y > a.z ? 1 : 2);
    vec2 on_face = axis == 0 ? d.yz / a.x : (axis == 1 ? d.xz / a.y : d.xy / a.z);
    vec2 at = (on_face * 0.5 + 0.5) * kCells;
    uint face = uint(axis) * 2u + (d[axis] > 0.0 ? 1u : 0u);
    vec3 random = vec3(scrambled(uvec3(uvec2(at), face))) * (1.0 / 4294967296.0);
    float pixel = max(length(FRAME_RAY_X.xyz), 5e-4) * 0.5 * kCells; // in cells
    vec2 off = fract(at) - (0.2 + 0.6 * random.xy);
    float width = 0.5 * pixel;
    float seen = exp(-dot(off, off) / max(width * width, 1e-6));
    float bright = 0.02 / max(1.015 - random.z, 0.015); // few are bright
    vec3 tint = mix(vec3(1.0, 0.80, 0.62), vec3(0.72, 0.83, 1.0), fract(random.z * 61.0));
    return tint * (seen * bright * smoothstep(0.0, 0.25, d.y));
}

void main()
{
    vec3 d = normalize(rayOf(gl_FragCoord.xy));
    vec3 high = discOf(0, d);
    if (kNight) {
        high += discOf(1, d) + starsAt(d) * SKY_STARS;
    }
    out_light = shown(physicalSky(d) + high * smoothstep(-0.002, 0.002, d.y), 1.0);
}
