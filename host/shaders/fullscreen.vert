// SPDX-License-Identifier: Apache-2.0
// One triangle over the whole picture, at the far plane: depth LESS passes where there is a surface, EQUAL where not.
#version 460

void main()
{
    vec2 p = vec2((gl_VertexIndex << 1) & 2, gl_VertexIndex & 2);
    gl_Position = vec4(p * 2.0 - 1.0, 0.0, 1.0);
}
