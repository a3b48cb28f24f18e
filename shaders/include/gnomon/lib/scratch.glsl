// SPDX-License-Identifier: Apache-2.0
// GLSL only: where a texel of a tile is in the scratch image between the two directions of a blur.
#ifndef GNOMON_SCRATCH_GLSL
#define GNOMON_SCRATCH_GLSL
#include "filter_pass.glsl"

// The image is cut into strips of few blocks' width, each in a layer, so that a walk down a column stays within few
// pages of memory.
ivec3 inScratch(ivec2 texel, int layer)
{
    int strip = texel.x / place.strips.x;
    return ivec3(texel.x - strip * place.strips.x, texel.y, strip + layer * place.strips.y);
}

#endif
