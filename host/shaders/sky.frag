// SPDX-License-Identifier: Apache-2.0
// The sky where there is nothing else.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "screen_numbers.glsl"
#include "ray.glsl"
#define FRAME_SKY(I) SCREEN_NUMBER(kScreenSky + (I), sky[I])
#include "sky.glsl"
#include "shown.glsl"

layout(location = 0) out vec4 out_light;

void main() { out_light = shown(plainSky(normalize(rayOf(gl_FragCoord.xy))), 1.0); }
