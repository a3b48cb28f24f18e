// SPDX-License-Identifier: Apache-2.0
// A sky of air, of the sun and by night of the moon, from the tables of host/src/sky_table.h; their discs, and stars.
// Below the horizon is ground in haze. OVER_SURFACE: laid over a surface that fades into it.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "screen_numbers.glsl"
#include "sky_numbers.glsl"
#include "ray.glsl"
#include "shown.glsl"
#include "atmosphere.h"

// For each body the light of molecules and many scatterings, and that of dust without its phase.
layout(set = 0, binding = 8) uniform sampler2DArray sky_tables;
// There are a moon or stars. A software rasteriser goes through all that a shader might do.
layout(constant_id = 22) const bool kNight = false;
#ifdef OVER_SURFACE
layout(location = kScreenShare) in float share;
#else
const float share = 1.0;
#endif
layout(location = 0) out vec4 out_light;

vec3 skyOf(int body, vec3 d)
{
    vec3 towards = SKY_BODY(body).xyz;
    float level = dot(d.xz, d.xz) * dot(towards.xz, towards.xz);
    float along = level > 1e-12 ? dot(d.xz, towards.xz) * inversesqrt(level) : 1.0;
    vec2 texels = vec2(textureSize(sky_tables, 0).xy);
    vec2 place = (skyTablePlace(d.y, along) * (texels - 1.0) + 0.5) / texels;
    vec3 molecules = textureLod(sky_tables, vec3(place, 2 * body), 0.0).rgb;
    vec3 dust = textureLod(sky_tables, vec3(place, 2 * body + 1), 0.0).rgb;
    vec3 above = vec3(d.x, max(d.y, 1e-4), d.z); // haze below the horizon is as at the horizon
    return (molecules + dust * dustPhase(dot(normalize(above), towards))) * SKY_TIMES(body);
}

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
    float pixel = max(isOrthographic() ? 0.0 : length(FRAME_RAY_X.xyz), 5e-4) * 0.5 * kCells; // in cells
    vec2 off = fract(at) - (0.2 + 0.6 * random.xy);
    float width = 0.5 * pixel;
    float seen = exp(-dot(off, off) / max(width * width, 1e-6));
    float bright = 0.02 / max(1.015 - random.z, 0.015); // few are bright
    vec3 tint = mix(vec3(1.0, 0.80, 0.62), vec3(0.72, 0.83, 1.0), fract(random.z * 61.0));
    return tint * (seen * bright * smoothstep(0.0, 0.25, d.y));
}

void main()
{
    vec3 d = normalize(sightThrough(gl_FragCoord.xy));
    vec3 sky = SKY_NIGHT + skyOf(0, d);
    vec3 high = discOf(0, d);
    if (kNight) {
        sky += skyOf(1, d);
        high += discOf(1, d) + starsAt(d) * SKY_STARS;
    }
    sky = mix(sky, SKY_GROUND, groundShare(d.y));
    out_light = shown(sky + high * smoothstep(-0.002, 0.002, d.y), share);
}
