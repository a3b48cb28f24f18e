// SPDX-License-Identifier: Apache-2.0
// Where a vertex of the scene is drawn, the same bit for bit in every pass: depths are compared for equality.
#ifndef HOST_SCENE_POSITION_GLSL
#define HOST_SCENE_POSITION_GLSL
#ifdef CLIPPED
#include "gnomon/lib/caster.glsl"
#endif

layout(location = 0) in vec3 position;
layout(location = 6) in vec4 row_x; // eye-relative from object
layout(location = 7) in vec4 row_y;
layout(location = 8) in vec4 row_z;
invariant gl_Position;
#ifdef CLIPPED
layout(push_constant) uniform Cut { vec4 clip_planes[2]; };
out float gl_ClipDistance[2];
#endif

// Returns its place, eye-relative.
vec3 placeVertex()
{
    vec4 p = vec4(position, 1.0);
    vec4 q = vec4(dot(row_x, p), dot(row_y, p), dot(row_z, p), 1.0);
    gl_Position = frame.clip_from_eye * q;
#ifdef CLIPPED
    gl_ClipDistance[0] = casterInside(position, clip_planes[0]);
    gl_ClipDistance[1] = casterInside(position, clip_planes[1]);
#endif
    return q.xyz;
}

#endif
