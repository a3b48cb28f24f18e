// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "scene_numbers.glsl"
#include "ray.glsl"
#include "material.glsl"
#include "octahedral_pair.glsl"
#include "shared/smooth_surface.h"

layout(location = 0) in vec4 normal;
layout(location = 1) in vec4 uvs;
layout(location = 2) in vec4 tangent;
layout(location = 3) in vec4 colour;
layout(location = 4) flat in uvec3 ids;

layout(location = 0) out vec4 out_base;     // square root of the base colour; occlusion
layout(location = 1) out vec4 out_normals;  // geometric, shading
layout(location = 2) out vec4 out_material; // metallic, roughness, 0, model / 2
layout(location = 3) out uvec2 out_ids;     // id and piece where the surface receives; id
layout(location = 4) out vec4 out_smooth;   // smoothEncode()

void main()
{
    vec4 base = baseColour(uvs, colour);
    vec3 p = rayOf(gl_FragCoord.xy) / gl_FragCoord.w;
    Surface s = surfaceAt(p, normal.xyz, tangent, uvs, base);
    out_base = vec4(sqrt(s.base.rgb), s.occlusion);
    out_normals = encodeNormals(s.geometric_normal, s.shading_normal);
    float second = s.model == 1.0 ? log2(MATERIAL_MODEL.y + 1.0) / 16.0 : s.roughness;
    out_material = vec4(s.metallic, second, 0.0, s.model * 0.5);
    out_ids = uvec2(ids.y, ids.x);
    out_smooth = vec4(smoothEncode(smoothSurface(p, s.geometric_normal, normal.xyz, normal.w), p), 0.0);
}
