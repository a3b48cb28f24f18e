// SPDX-License-Identifier: Apache-2.0
// Surfaces that are shaded where they are drawn: all opaque ones with Shading::forward, blended ones always; and what
// emits, added to what a G-buffer was shaded to. With filters they ask the maps themselves, as the mask does:
// door 2 of docs/integrating.md. A light has colours for them where the mask has its colours.
#version 460
#extension GL_GOOGLE_include_directive : require
layout(constant_id = 3) const bool kEmissiveOnly = false;
layout(constant_id = 8) const bool kOpaque = false; // else blended
layout(constant_id = 10) const bool kTints = true;  // blended casters may tint the light
layout(constant_id = 26) const bool kLayered = false; // views may be ViewServes::layered ones
layout(constant_id = 27) const bool kOrthographic = false; // all views are
#include "shown.glsl" // first: the library's headers take the macros of portability.h back
#include "gnomon/shared/blended_tint.h"
#if defined(GNOMON_FILTER) || defined(GNOMON_FILTERS)
#define SHADOWED
#include "by_vertex.glsl" // kInSoftware
#include "gnomon/lib/compiled_filters.glsl"
#define GNOMON_SET 2
#define GNOMON_TINTS kTints
#define GNOMON_LAYERED kLayered
#define GNOMON_ORTHOGRAPHIC_ONLY kOrthographic
#define GNOMON_IN_SOFTWARE kInSoftware
#define GNOMON_CONSTANT_ID 11
#include "gnomon/technique_constants.glsl"
#if GNOMON_COMPILES_IDS
uint receiver_object;
uint receiver_piece;
#define GNOMON_OBJECT receiver_object
#define GNOMON_PIECE receiver_piece
#endif
#include "gnomon/smooth_surface.glsl"
#include "gnomon/visibility.glsl"
#endif
#include "frame.glsl"
#include "scene_numbers.glsl"
#include "ray.glsl"
#define FRAME_SKYLIGHT(I) frame.skylight[I]
#define FRAME_DEPTH frame.depth
#include "material.glsl"
#include "shaded_lights.glsl"

layout(set = 0, binding = 4) uniform sampler2DArray cookies;

layout(location = 0) in vec4 normal;
layout(location = 1) in vec4 uvs;
layout(location = 2) in vec4 tangent;
layout(location = 3) in vec4 colour;
layout(location = 4) flat in uvec3 ids; // as scene.vert has them
layout(location = 0) out vec4 out_light;

// The share of a light that reaches the surface. `own_tint` is an argument of gnomonLightColour().
vec3 seenBy(uint light, vec3 p, Surface surface, vec3 own_tint)
{
#ifdef SHADOWED
    if (ids.y != 0u) {
        vec4 smooth_surface = gnomonSmoothSurface(p, surface.geometric_normal, normal);
        vec4 seen = gnomonLightColour(light, p, surface.geometric_normal, smooth_surface, own_tint, gl_FragCoord.xy);
        return kTints && (int(frame.lights[light].right.w) & 4) != 0 ? seen.rgb : vec3(seen.a);
    }
#endif
    return vec3(1.0);
}

// The tint that this blended surface has put into the map, if it casts: it must not tint itself.
vec3 ownTint(vec4 base)
{
    if (kOpaque || ids.z == 0u) {
        return vec3(1.0);
    }
    return blendedTint(clamp(base, 0.0, 1.0), MATERIAL_MODEL.w);
}

void main()
{
#ifdef GNOMON_OBJECT
    receiver_object = ids.x - 1u;
    receiver_piece = ids.y >> 20; // scene.vert
#endif
    vec3 emitted = emission(uvs) * FRAME_SKYLIGHT(6).w;
    if (kEmissiveOnly) {
        out_light = vec4(emitted, 0.0);
        return;
    }
    vec4 base = baseColour(uvs, colour);
    float alpha = kOpaque ? 1.0 : base.a;
    vec3 p = pointOn(gl_FragCoord.xy, viewDepthOf(gl_FragCoord.z, gl_FragCoord.w));
    Surface surface = surfaceAt(p, sightTo(p), normal.xyz, tangent, uvs, base);
    float model = kPhysicalOnly ? 0.0 : surface.model;
    if (model == 2.0) {
        out_light = shown(base.rgb * FRAME_SKYLIGHT(6).w, alpha);
        return;
    }
    bool phong_2005 = kOpaque && kPhong2005;
    float second = model == 1.0 ? MATERIAL_MODEL.y : surface.roughness;
    Lit s = litSurface(p, -sightTo(p), surface.shading_normal, base.rgb, phong_2005 ? 0.0 : surface.metallic, second,
                       phong_2005 ? 1.0 : model);
    vec3 own_tint = ownTint(base);
    vec3 sum = emitted + (kOpaque ? lampLight(surface.lit) : vec3(0.0));
    if (!phong_2005) {
        sum += ambient(s, model == 1.0 ? 1.0 : second, vec3(surface.occlusion), surface.occlusion);
    }
    if (kFixedLights > 0) {
        for (uint i = 0; i < kFixedLights; ++i) {
            sum += lightFrom(frame.lights[i], s, cookies, seenBy(i, p, surface, own_tint));
        }
    } else {
        for (uint i = 0; i < frame.counts.x; ++i) {
            sum += lightFrom(frame.lights[i], s, cookies, seenBy(i, p, surface, own_tint));
        }
    }
    out_light = shown(sum, alpha);
}
