// SPDX-License-Identifier: Apache-2.0
// Alpha-masked surfaces to depth alone.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "scene_numbers.glsl"
#include "material.glsl"

layout(location = 1) in vec4 uvs;
layout(location = 3) in vec4 colour;

void main()
{
    if (baseColour(uvs, colour).a < MATERIAL_NUMBERS.w) {
        discard;
    }
}
