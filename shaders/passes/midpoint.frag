#version 460
// SPDX-License-Identifier: Apache-2.0
// Midway between the first two surfaces of the casters: what the map holds.
#extension GL_GOOGLE_include_directive : require
#include "gnomon/lib/caster.glsl"

layout(set = 0, binding = 0) uniform sampler2D first_surface;
layout(set = 0, binding = 1) uniform sampler2D second_surface;

void main()
{
    ivec2 texel = ivec2(gl_FragCoord.xy);
    gl_FragDepth = casterMidpoint(texelFetch(first_surface, texel, 0).r, texelFetch(second_surface, texel, 0).r);
}
