#version 460
// SPDX-License-Identifier: Apache-2.0
// Casters' shadow volumes. Six corners for each element of a mesh: an edge's wall, or a triangle's two caps. Corners are
// pulled from buffers, because a wall asks for two triangles; so they are where skinning has put them.
// firstVertex: six times the mesh's first element; firstInstance: the vertex that the mesh's indices count from.
#extension GL_GOOGLE_include_directive : require
#include "gnomon/shared/shadow_volume.h"

layout(push_constant) uniform Push
{
    mat4 clip_from_eye;
    vec4 row_x; // eye-relative from object
    vec4 row_y;
    vec4 row_z;
    vec4 place; // the light's
};
layout(set = 0, binding = 0, std430) restrict readonly buffer Elements
{
    uvec4 elements[]; // an edge: two vertices, the triangles on its left and right; caps: kNoTriangle, -, a triangle
};
layout(set = 0, binding = 1, std430) restrict readonly buffer Triangles
{
    uint corners[]; // three vertices each
};
layout(set = 0, binding = 2, std430) restrict readonly buffer Positions
{
    float positions[];
};

vec3 pointOf(uint vertex)
{
    uint i = 3u * (vertex + uint(gl_InstanceIndex));
    vec4 p = vec4(positions[i], positions[i + 1u], positions[i + 2u], 1.0);
    return vec3(dot(row_x, p), dot(row_y, p), dot(row_z, p));
}

bool casts(uint triangle, float mirrored)
{
    if (triangle == kNoTriangle) {
        return false;
    }
    precise vec3 a = pointOf(corners[3u * triangle]);
    precise vec3 b = pointOf(corners[3u * triangle + 1u]);
    precise vec3 c = pointOf(corners[3u * triangle + 2u]);
    return volumeCasts(a, b, c, place, mirrored);
}

void main()
{
    uvec4 element = elements[uint(gl_VertexIndex) / 6u];
    float mirrored = dot(cross(row_x.xyz, row_y.xyz), row_z.xyz) < 0.0 ? -1.0 : 1.0;
    int corner = volumeCorner(int(uint(gl_VertexIndex) % 6u), mirrored);
    bool left = casts(element.z, mirrored);
    vec4 p;
    if (element.x == kNoTriangle) {
        p = volumeCap(corner, pointOf(corners[3u * element.z]), pointOf(corners[3u * element.z + 1u]),
                      pointOf(corners[3u * element.z + 2u]), left, place);
    } else {
        p = volumeWall(corner, pointOf(element.x), pointOf(element.y), left, casts(element.w, mirrored), place);
    }
    // At infinity w is 0 for an orthographic eye: a lamp's dark caps would not be drawn, and some drivers drop triangles of
    // a sun's. So infinity is kFarTimes times the caster's distance from the lamp, or half the width that a sun's eye sees.
    const float kFarTimes = 65536.0;
    mat3 rows = transpose(mat3(clip_from_eye));
    bool orthographic = clip_from_eye[0].w == 0.0 && clip_from_eye[1].w == 0.0 && clip_from_eye[2].w == 0.0;
    if (orthographic && p.w == 0.0) {
        float least = min(length(rows[0]), min(length(rows[1]), length(rows[2])));
        p.w = (place.w != 0.0 ? 1.0 : least) / kFarTimes;
        p.xyz += place.xyz * place.w * p.w;
    }
    gl_Position = clip_from_eye * vec4(p.xyz * kVolumePush, p.w);
}
