// SPDX-License-Identifier: Apache-2.0
// Deferred shading of every surface pixel: hemisphere light, and each light times its visibility. With
// HOST_COMPACT_MASK the lights are those of the pixel's tile.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "lighting.glsl"
#include "shared/octahedral.h"

// Of the frame's lights, when there are few: unrolled loops read uniforms at fixed places, which a software rasteriser
// does once for all pixels. 0: any number.
layout(constant_id = 0) const int kFixedLights = 0;
layout(constant_id = 1) const bool kDirectionalOnly = false;
layout(constant_id = 2) const bool kPhysicalOnly = false; // every surface is metallic-roughness
layout(constant_id = 3) const bool kReflectionPhong = false; // Shading::reflection_phong

layout(set = 0, binding = 1) uniform sampler2D depths;
layout(set = 0, binding = 2) uniform sampler2D bases;
layout(set = 0, binding = 3) uniform sampler2D normals;
layout(set = 0, binding = 4) uniform sampler2D materials;
layout(set = 0, binding = 6) uniform sampler2DArray mask;
layout(set = 0, binding = 7) uniform sampler2DArray cookies;
layout(location = 0) out vec4 out_light;
#ifdef HOST_COMPACT_MASK
#define GNOMON_TILES_SET 1
#include "gnomon/compact_mask.glsl"
#endif

vec3 seenOf(uint i, ivec2 pixel)
{
    if (frame.counts.y == 0) {
        return vec3(1.0);
    }
    int slot = int(frame.lights[i].right.w);
    vec4 texel = texelFetch(mask, ivec3(pixel, slot >> 3), 0);
    return (slot & 4) != 0 ? texel.rgb : vec3(texel[slot & 3]);
}

vec3 lightFrom(uint i, Lit s, vec3 seen)
{
    vec3 l = frame.lights[i].place.xyz;
    vec3 e = frame.lights[i].colour.rgb;
    if (!kDirectionalOnly) {
        e = arriving(frame.lights[i], s.p, cookies, l);
    }
    float n_l = max(dot(s.n, l), 0.0);
    if (kReflectionPhong) {
        return s.diffuse * e * (seen * (n_l + reflectionPhong(s, l, n_l)));
    }
    return reflectance(s, l, n_l) * e * (n_l * seen);
}

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 base = texelFetch(bases, pixel, 0);
    base.rgb *= base.rgb;
    vec4 numbers = texelFetch(materials, pixel, 0);
    float model = kPhysicalOnly ? 0.0 : floor(numbers.a * 2.0 + 0.5);
    if (model == 2.0) {
        out_light = vec4(base.rgb * frame.sky_horizon.w, 1.0);
        return;
    }
    float depth = texelFetch(depths, pixel, 0).r;
    vec3 p = rayOf(gl_FragCoord.xy) / (frame.depth.x * depth + frame.depth.y);
    vec3 n = octahedralDecode(texelFetch(normals, pixel, 0).ba);
    float second = model == 1.0 ? exp2(numbers.g * 16.0) - 1.0 : numbers.g;
    Lit s = litSurface(p, n, base.rgb, kReflectionPhong ? 0.0 : numbers.r, second, kReflectionPhong ? 1.0 : model);
    vec3 sum = kReflectionPhong ? vec3(0.0) : ambient(s, model == 1.0 ? 1.0 : numbers.g, base.a);
#ifdef HOST_COMPACT_MASK
    GnomonTileLights tile = gnomonTileLights(pixel);
    for (uint i = tile.first; i < tile.first + tile.count; ++i) {
        GnomonTileLight one = gnomonTileLight(i);
        sum += lightFrom(one.light, s, vec3(gnomonTileVisibility(mask, pixel, one)));
    }
#else
    if (kFixedLights > 0) {
        for (uint i = 0; i < kFixedLights; ++i) {
            sum += lightFrom(i, s, seenOf(i, pixel));
        }
    } else {
        for (uint i = 0; i < frame.counts.x; ++i) {
            sum += lightFrom(i, s, seenOf(i, pixel));
        }
    }
#endif
    out_light = vec4(sum, 1.0);
}
