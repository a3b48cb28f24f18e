#version 460
// SPDX-License-Identifier: Apache-2.0
// Fins of casters' silhouettes (gnomon/shared/smoothie_fins.h) into a map of smoothies. Six corners for each edge of a mesh,
// which come to nothing where it is no silhouette. Corners are pulled from buffers, because an edge asks for two
// triangles; so they are where skinning has put them.
// firstVertex: six times the mesh's first element; firstInstance: the vertex that the mesh's indices count from.
// PLACED: the GPU has fitted the view to a part of its base map.
#extension GL_GOOGLE_include_directive : require
#include "gnomon/lib/caster.glsl"
#include "gnomon/lib/fin_pass.glsl"
#include "gnomon/shared/shadow_volume.h"

layout(set = 0, binding = 0, std430) restrict readonly buffer Elements
{
    uvec4 elements[]; // an edge: two vertices, the triangles on its left and right; caps of volumes are none
};
layout(set = 0, binding = 1, std430) restrict readonly buffer Triangles
{
    uint corners[]; // three vertices each
};
layout(set = 0, binding = 2, std430) restrict readonly buffer Positions
{
    float positions[];
};
#ifdef PLACED
layout(location = 0) in vec4 place; // the same for all
#endif
layout(location = 0) flat out vec4 ends; // texels
layout(location = 1) flat out vec4 depths; // and w
layout(location = 2) flat out vec2 outward;

vec3 pointOf(uint vertex)
{
    uint i = 3u * (vertex + uint(gl_InstanceIndex));
    return vec3(positions[i], positions[i + 1u], positions[i + 2u]);
}

// x, y and w of clip space; of a direction with `is_point` 0.
vec3 clipOf(vec3 p, float is_point)
{
    vec4 q = vec4(p, is_point);
    vec4 clip = vec4(dot(row_x, q), dot(row_y, q), 0.0, dot(row_w, q));
#ifdef PLACED
    clip = casterPlaced(clip, place);
#endif
    return clip.xyw;
}

// The side of the triangle's corner that is not on the edge.
float sideOf(uint triangle, uvec2 edge, vec3 from, vec3 from_clip, vec3 along_clip)
{
    uint third = corners[3u * triangle];
    for (uint k = 1u; k < 3u; ++k) {
        third = third == edge.x || third == edge.y ? corners[3u * triangle + k] : third;
    }
    return finSide(from_clip, along_clip, clipOf(pointOf(third) - from, 0.0));
}

vec2 texelOf(vec3 clip)
{
    return tile.xy + (clip.xy / clip.z + 1.0) * tile.zw;
}

void main()
{
    uvec4 element = elements[uint(gl_VertexIndex) / 6u];
    gl_Position = vec4(2.0, 2.0, 0.0, 1.0); // nothing
    ends = depths = vec4(0.0);
    outward = vec2(0.0);
    if (element.x == kNoTriangle) {
        return;
    }
    vec3 from = pointOf(element.x);
    vec3 to = pointOf(element.y);
    vec3 a = clipOf(from, 1.0);
    vec3 along = clipOf(to - from, 0.0);
    vec3 b = a + along;
    float left = sideOf(element.z, element.xy, from, a, along);
    float right = element.w == kNoTriangle ? left : sideOf(element.w, element.xy, from, a, along);
    if (!isSilhouette(left, right) || max(a.z, b.z) <= 0.0) {
        return;
    }
    vec2 depth = vec2(dot(row_depth, vec4(from, 1.0)), dot(row_depth, vec4(to, 1.0)));
    vec2 near = depth * rule.w;
    float begin = max(finCut(a.z, b.z), finBeforeNear(near.x, near.y));
    float end = 1.0 - max(finCut(b.z, a.z), finBeforeNear(near.y, near.x));
    if (begin >= end) {
        return;
    }
    vec3 first = a + along * begin;
    vec3 last = a + along * end;
    ends = vec4(texelOf(first), texelOf(last));
    depths = vec4(mix(depth.x, depth.y, begin), mix(depth.x, depth.y, end), first.z, last.z);
    outward = finOutward(ends.xy, ends.zw, left + right);
    vec2 corner = finCorner(int(uint(gl_VertexIndex) % 6u), ends.xy, ends.zw, outward, rule.x);
    gl_Position = vec4((corner - tile.xy) / tile.zw - 1.0, 0.0, 1.0);
}
