#version 460
// SPDX-License-Identifier: Apache-2.0
#extension GL_GOOGLE_include_directive : require
#include "forward.glsl"

layout(location = 0) in vec3 position;
layout(location = 0) out vec3 p_eye;
layout(location = 1) out vec3 point;

void main()
{
    p_eye = draw.centre.xyz + draw.half_size.xyz * position;
    gl_Position = draw.clip_from * vec4(p_eye, 1.0);
    point = position;
}
