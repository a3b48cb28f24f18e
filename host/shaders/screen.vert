// SPDX-License-Identifier: Apache-2.0
// fullscreen.vert, with numbers of the frame for fragment shaders. OVER_SURFACE: on a surface of the scene instead, with
// the share that its vertices' alpha leaves to what is behind it.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "by_vertex.glsl"
#include "frame.glsl"
#ifdef OVER_SURFACE
#include "scene_position.glsl"
layout(location = 4) in vec4 colour;
layout(location = kScreenShare) out float share;
#endif

layout(location = 0) flat out vec4 numbers[kScreenNumberCount];
layout(location = kScreenPixel) out vec2 place;

void main()
{
#ifdef OVER_SURFACE
    placeVertex();
    place = vec2(0.0);
    share = 1.0 - colour.a;
#else
    vec2 p = vec2((gl_VertexIndex << 1) & 2, gl_VertexIndex & 2);
    gl_Position = vec4(p * 2.0 - 1.0, 0.0, 1.0);
    place = p;
#endif
    if (kInSoftware) {
        numbers[kScreenRayX] = frame.ray_x;
        numbers[kScreenRayY] = frame.ray_y;
        numbers[kScreenRay0] = frame.ray_0;
        numbers[kScreenDepth] = frame.depth;
        for (int i = 0; i < 7; ++i) {
            numbers[kScreenSky + i] = kDrawsSky ? frame.sky[i] : frame.skylight[i];
        }
        numbers[kScreenPlace] = frame.lights[0].place;
        numbers[kScreenColour] = frame.lights[0].colour;
        numbers[kScreenRight] = frame.lights[0].right;
    }
}
