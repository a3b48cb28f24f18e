// SPDX-License-Identifier: Apache-2.0
// Every drawn surface. Instances carry their transform, because instance-rate attributes cost a software rasteriser far
// less than a gather per vertex. CLIPPED: with two planes in the objects' own space, beyond which nothing is drawn.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "by_vertex.glsl"
#include "frame.glsl"
#include "material_data.glsl"
#include "scene_position.glsl"
#include "gnomon/shared/smooth_surface.h"
#include "gnomon/shared/object_ids.h"

layout(constant_id = 2) const bool kAllTextures = false;

layout(location = 1) in vec2 uv_base; // the base colour's coordinates
layout(location = 2) in vec4 normal; // w: 4096 where it is creased, and the vertex's piece, over 32767
layout(location = 3) in vec4 tangent;
layout(location = 4) in vec4 colour; // linear
layout(location = 5) in vec2 uv_other;
layout(location = 9) in uvec3 ids; // object id + 1; the same where it receives, else 0; 1 where it tints the light

layout(location = 0) out vec4 out_normal; // w: smoothPlane()
layout(location = 1) out vec4 out_uvs;
layout(location = 2) out vec4 out_tangent;
layout(location = 3) out vec4 out_colour;
layout(location = 4) flat out uvec3 out_ids; // the second with the piece in its upper bits, where it is not 0
layout(location = 5) flat out vec4 numbers[kSceneNumberCount];

void main()
{
    vec3 q = placeVertex();
    // The cofactors take normals along whatever the transform is.
    vec3 c_x = cross(row_y.xyz, row_z.xyz);
    vec3 c_y = cross(row_z.xyz, row_x.xyz);
    vec3 c_z = cross(row_x.xyz, row_y.xyz);
    out_normal.xyz = vec3(dot(c_x, normal.xyz), dot(c_y, normal.xyz), dot(c_z, normal.xyz));
    out_tangent = vec4(0.0);
    if (kAllTextures) {
        float mirrored = sign(dot(row_x.xyz, c_x));
        out_normal.xyz *= mirrored;
        out_tangent.xyz = vec3(dot(row_x.xyz, tangent.xyz), dot(row_y.xyz, tangent.xyz), dot(row_z.xyz, tangent.xyz));
        out_tangent.w = tangent.w * mirrored;
    }
    uint more = uint(normal.w * 32767.0 + 0.5);
    out_normal.w = smoothPlane(out_normal.xyz, q, more >= uint(kMostPieces));
    out_uvs = vec4(uv_base, uv_other);
    out_colour = colour;
    out_ids = ids;
    if (kInSoftware) {
        numbers[kSceneRayX] = frame.ray_x;
        numbers[kSceneRayY] = frame.ray_y;
        numbers[kSceneRay0] = frame.ray_0;
        numbers[kSceneBase] = material.base_colour;
        numbers[kSceneNumbers] = material.numbers;
        numbers[kSceneModel] = material.model;
        numbers[kScenePlaceU] = material.places[0].u;
        numbers[kScenePlaceV] = material.places[0].v;
    }
    if (ids.y != 0u) {
        out_ids.y |= (more % uint(kMostPieces)) << kPieceShift;
    }
}
