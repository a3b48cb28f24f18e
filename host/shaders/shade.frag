// SPDX-License-Identifier: Apache-2.0
// Deferred shading of every surface pixel: hemisphere light, and each light times its visibility. With
// HOST_COMPACT_MASK the lights are those of the pixel's tile.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "screen_numbers.glsl"
#include "ray.glsl"
#include "shaded_lights.glsl"
#include "gbuffer_surface.glsl"
#include "shown.glsl"
#include "ambient_occlusion.h"
#include "occlusion_here.glsl"

layout(constant_id = 23) const bool kOccluded = false;
layout(set = 0, binding = 1) uniform sampler2D depths;
layout(set = 0, binding = 2) uniform usampler2D surfaces;
layout(set = 0, binding = 3) uniform sampler2DArray mask;
layout(set = 0, binding = 4) uniform sampler2DArray cookies;
layout(location = 0) out vec4 out_light;
#ifdef HOST_COMPACT_MASK
#define GNOMON_TILES_SET 1
#include "gnomon/compact_mask.glsl"
#endif

LightData lightAt(uint i)
{
    LightData light = frame.lights[i];
    if (kInSoftware && kFixedLights == 1) {
        light.place = numbers_in[kScreenPlace];
        light.colour = numbers_in[kScreenColour];
        light.right = numbers_in[kScreenRight];
    }
    return light;
}

vec3 seenOf(uint i)
{
    if (FRAME_DEPTH.z == 0.0) {
        return vec3(1.0);
    }
    int slot = int(lightAt(i).right.w);
    vec4 texel = texelHere(mask, slot >> 3);
    return (slot & 4) != 0 ? texel.rgb : vec3(texel[slot & 3]);
}

// Light of the sky. A material's own occlusion and that found in the picture often stand for the same creases.
vec3 ambientHere(Lit s, float roughness, float own_occlusion, float view_depth)
{
    if (!kOccluded) {
        return ambient(s, roughness, vec3(own_occlusion), own_occlusion);
    }
    float seen = min(own_occlusion, seenHere(s.p, view_depth));
    vec3 bounced = vec3(bouncedOcclusion(seen, s.diffuse.r), bouncedOcclusion(seen, s.diffuse.g),
                        bouncedOcclusion(seen, s.diffuse.b));
    return ambient(s, roughness, bounced, specularOcclusion(seen, s.n_v, roughness));
}

void main()
{
    StoredSurface stored = unpackSurface(texelHere(surfaces).xyz);
    vec4 base = stored.base;
    float model = kPhysicalOnly ? 0.0 : stored.model;
    if (model == 2.0) {
        out_light = shown(base.rgb * FRAME_SKYLIGHT(6).w, 1.0);
        return;
    }
    float depth = texelHere(depths).r;
    float view_depth = viewDepthOf(depth, FRAME_DEPTH.x * depth + FRAME_DEPTH.y);
    vec3 p = pointOn(gl_FragCoord.xy, view_depth);
    float second = model == 1.0 ? exp2(stored.second * 16.0) - 1.0 : stored.second;
    Lit s = litSurface(p, -sightTo(p), stored.shading_normal, base.rgb, kPhong2005 ? 0.0 : stored.metallic, second,
                       kPhong2005 ? 1.0 : model);
    vec3 sum = kPhong2005 ? vec3(0.0) : ambientHere(s, model == 1.0 ? 1.0 : stored.second, base.a, view_depth);
    sum += lampLight(stored.lit);
#ifdef HOST_COMPACT_MASK
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    GnomonTileLights tile = gnomonTileLights(pixel);
    for (uint i = tile.first; i < tile.first + tile.count; ++i) {
        GnomonTileLight one = gnomonTileLight(i);
        sum += lightFrom(frame.lights[one.light], s, cookies, vec3(gnomonTileVisibility(mask, pixel, one)));
    }
#else
    if (kFixedLights > 0) {
        for (uint i = 0; i < kFixedLights; ++i) {
            sum += lightFrom(lightAt(i), s, cookies, seenOf(i));
        }
    } else {
        for (uint i = 0; i < frame.counts.x; ++i) {
            sum += lightFrom(lightAt(i), s, cookies, seenOf(i));
        }
    }
#endif
    out_light = shown(sum, 1.0);
}
