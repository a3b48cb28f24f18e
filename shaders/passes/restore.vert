#version 460
// SPDX-License-Identifier: Apache-2.0
// One triangle that covers the map, as far away as it goes.
void main()
{
    vec2 p = vec2(float((gl_VertexIndex << 1) & 2), float(gl_VertexIndex & 2));
    gl_Position = vec4(p * 2.0 - 1.0, 1.0, 1.0);
}
