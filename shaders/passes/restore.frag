#version 460
// SPDX-License-Identifier: Apache-2.0
// Puts the kept map of what stands still back under what moves. DEPTH_OF_COLOUR: of two maps a texel under a parallel
// light, whose depths are what their colours say. Rounding keeps the order of depths, and what it makes one is one in
// the map, too: so whichever of the two is taken for nearer, the map holds the same.
#extension GL_GOOGLE_include_directive : require
#include "gnomon/shared/paired_depth.h"

#ifndef DEPTH_OF_COLOUR
layout(set = 0, binding = 0) uniform sampler2DArray kept_depths;
#endif
#ifdef WRITE_COLOUR
layout(set = 0, binding = 1) uniform sampler2DArray kept_colours;
layout(location = 0) out vec4 stored;
#endif
layout(push_constant) uniform Kept
{
    int layer;
    int holding; // DEPTH_OF_COLOUR: a kDepth constant of paired_depth.h
    float part;  // DEPTH_OF_COLOUR: the part that pairedDepth() takes
};

void main()
{
    ivec3 texel = ivec3(ivec2(gl_FragCoord.xy), layer);
#ifdef WRITE_COLOUR
    stored = texelFetch(kept_colours, texel, 0);
#endif
#ifdef DEPTH_OF_COLOUR
    gl_FragDepth = pairedDepth(holding, stored, part);
#else
    gl_FragDepth = texelFetch(kept_depths, texel, 0).r;
#endif
}
