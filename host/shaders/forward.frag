// SPDX-License-Identifier: Apache-2.0
// Surfaces that are not in the G-buffer: blended ones, lit here; and what emits, added to what is shaded already.
// The mask knows nothing of blended surfaces. With GNOMON_FILTER they ask the maps themselves, as the mask did. A light
// has colours for them where the mask has its colours.
#version 460
#extension GL_GOOGLE_include_directive : require
#ifdef GNOMON_FILTER
#define GNOMON_SET 2
#define GNOMON_TINTS true
uint receiver_object;
uint receiver_piece;
#define GNOMON_OBJECT receiver_object
#define GNOMON_PIECE receiver_piece
#include "gnomon/smooth_surface.glsl"
#include "gnomon/visibility.glsl"
#endif
#include "frame.glsl"
#include "lighting.glsl"
#include "material.glsl"

layout(constant_id = 3) const bool kEmissiveOnly = false;
layout(set = 0, binding = 7) uniform sampler2DArray cookies;

layout(location = 0) in vec4 normal;
layout(location = 1) in vec4 uvs;
layout(location = 2) in vec4 tangent;
layout(location = 3) in vec4 colour;
layout(location = 4) flat in uvec3 ids; // as scene.vert has them
layout(location = 0) out vec4 out_light;

// What reaches the surface of a light. `own_tint`: of gnomonLightColour().
vec3 seenBy(uint light, vec3 p, Surface surface, vec3 own_tint)
{
#ifdef GNOMON_FILTER
    if (ids.y != 0u) {
        vec4 smooth_surface = gnomonSmoothSurface(p, surface.geometric_normal, normal);
        vec4 seen = gnomonLightColour(light, p, surface.geometric_normal, smooth_surface, own_tint, gl_FragCoord.xy);
        return (int(frame.lights[light].right.w) & 4) != 0 ? seen.rgb : vec3(seen.a);
    }
#endif
    return vec3(1.0);
}

void main()
{
#ifdef GNOMON_OBJECT
    receiver_object = ids.x - 1u;
    receiver_piece = ids.y >> 20; // scene.vert
#endif
    vec3 emitted = material.emissive.rgb * texture(emissive_texture, place(4, uvs)).rgb * frame.sky_horizon.w;
    vec4 base = baseColour(uvs, colour);
    if (kEmissiveOnly) {
        out_light = vec4(emitted, 0.0);
        return;
    }
    vec3 p = rayOf(gl_FragCoord.xy) / gl_FragCoord.w;
    Surface surface = surfaceAt(p, normal.xyz, tangent, uvs, base);
    if (surface.model == 2.0) {
        out_light = vec4(base.rgb * frame.sky_horizon.w * base.a, base.a);
        return;
    }
    float second = surface.model == 1.0 ? material.model.y : surface.roughness;
    Lit s = litSurface(p, surface.shading_normal, base.rgb, surface.metallic, second, surface.model);
    // Casters are drawn without colours of vertices.
    vec4 own = clamp(baseColour(uvs, vec4(1.0)), 0.0, 1.0);
    vec3 own_tint = ids.z != 0u ? 1.0 - own.a * (1.0 - own.rgb) : vec3(1.0);
    vec3 sum = ambient(s, surface.model == 1.0 ? 1.0 : second, surface.occlusion) + emitted;
    for (uint i = 0; i < frame.counts.x; ++i) {
        vec3 l;
        vec3 e = arriving(frame.lights[i], p, cookies, l);
        float n_l = max(dot(s.n, l), 0.0);
        sum += reflectance(s, l, n_l) * e * (n_l * seenBy(i, p, surface, own_tint));
    }
    out_light = vec4(sum * base.a, base.a); // premultiplied
}
