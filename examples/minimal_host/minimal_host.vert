#version 460
// SPDX-License-Identifier: Apache-2.0
layout(location = 0) in vec3 position;
layout(push_constant) uniform Object
{
    mat4 clip_from_object;
};

void main()
{
    gl_Position = clip_from_object * vec4(position, 1.0);
}
