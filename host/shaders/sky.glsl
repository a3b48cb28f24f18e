// SPDX-License-Identifier: Apache-2.0
// What comes from the sky along a unit direction away from the eye, discs and stars apart, for the pass that draws it and
// for grounds that fade into it. The includer defines FRAME_SKY(I) and has included frame.glsl.
#ifndef HOST_SKY_GLSL
#define HOST_SKY_GLSL
#include "sky_numbers.glsl"
#include "atmosphere.h"

// For each body what molecules and many scatterings give, and what dust gives but for its phase.
layout(set = 0, binding = 8) uniform sampler2DArray sky_tables;
// There are a moon or stars. A software rasteriser goes through all that a shader might do.
layout(constant_id = 21) const bool kNight = false;

// A gradient from zenith over horizon to ground, with the sun in it, and the moon where there is one.
vec3 plainSky(vec3 d)
{
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
    return sky;
}

vec3 airLitBy(int body, vec3 d)
{
    vec3 towards = SKY_BODY(body).xyz;
    float level = dot(d.xz, d.xz) * dot(towards.xz, towards.xz);
    float along = level > 1e-12 ? dot(d.xz, towards.xz) * inversesqrt(level) : 1.0;
    vec2 texels = vec2(textureSize(sky_tables, 0).xy);
    vec2 place = (skyTablePlace(d.y, along) * (texels - 1.0) + 0.5) / texels;
    vec3 molecules = textureLod(sky_tables, vec3(place, 2 * body), 0.0).rgb;
    vec3 dust = textureLod(sky_tables, vec3(place, 2 * body + 1), 0.0).rgb;
    vec3 above = vec3(d.x, max(d.y, 0.0), d.z); // haze below the horizon is as at the horizon
    return (molecules + dust * dustPhase(dot(normalize(above), towards))) * SKY_TIMES(body);
}

// A sky of air, of the sun and by night of the moon, from the tables of host/src/sky_table.h. What is below the horizon is
// ground in haze.
vec3 physicalSky(vec3 d)
{
    vec3 sky = SKY_NIGHT + airLitBy(0, d);
    if (kNight) {
        sky += airLitBy(1, d);
    }
    return mix(sky, SKY_GROUND, groundShare(d.y));
}

#endif
