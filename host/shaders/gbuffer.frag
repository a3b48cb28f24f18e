// SPDX-License-Identifier: Apache-2.0
// Surfaces for the pass that shades, and for the mask. GIVES_IDS, GIVES_SMOOTH: what not every mask reads.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "scene_numbers.glsl"
#include "ray.glsl"
#include "material.glsl"
#include "gbuffer_surface.glsl"
#include "gnomon/shared/smooth_surface.h"

layout(location = 0) in vec4 normal;
layout(location = 1) in vec4 uvs;
layout(location = 2) in vec4 tangent;
layout(location = 3) in vec4 colour;
layout(location = 4) flat in uvec3 ids;

layout(location = 0) out uvec4 out_surface; // packSurface(), and the object's id
layout(location = 1) out vec2 out_normal;   // geometric, octahedral
#ifdef GIVES_IDS
layout(location = 2) out uint out_id; // with its piece, where the surface receives
const int kSmoothPlace = 3;
#else
const int kSmoothPlace = 2;
#endif
#ifdef GIVES_SMOOTH
layout(location = kSmoothPlace) out vec4 out_smooth; // smoothEncode()
#endif

void main()
{
    vec4 base = baseColour(uvs, colour);
    vec3 p = pointOn(gl_FragCoord.xy, viewDepthOf(gl_FragCoord.z, gl_FragCoord.w));
    Surface s = surfaceAt(p, sightTo(p), normal.xyz, tangent, uvs, base);
    float second = s.model == 1.0 ? log2(MATERIAL_MODEL.y + 1.0) / 16.0 : s.roughness;
    vec2 shading = octahedralEncode(s.shading_normal);
    out_surface = uvec4(packSurface(s, shading, second), ids.x);
    out_normal = octahedralEncode(s.geometric_normal);
#ifdef GIVES_IDS
    out_id = ids.y;
#endif
#ifdef GIVES_SMOOTH
    if (kAllTextures) {
        out_smooth = vec4(smoothEncode(smoothSurface(p, s.geometric_normal, normal.xyz, normal.w), p), 0.0);
    } else { // nothing bends the shading normal, so it is the smooth surface's
        float lift = smoothLift(p, s.geometric_normal, s.shading_normal, normal.xyz, normal.w);
        out_smooth = vec4(shading, lift, 0.0);
    }
#endif
}
