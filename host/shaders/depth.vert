// SPDX-License-Identifier: Apache-2.0
// Opaque surfaces to depth alone, before they are shaded. CLIPPED: as scene.vert.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "scene_position.glsl"

void main()
{
    placeVertex();
}
