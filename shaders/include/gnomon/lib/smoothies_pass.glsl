// SPDX-License-Identifier: Apache-2.0
// GLSL only: what the passes that make smoothies have in common.
#ifndef GNOMON_SMOOTHIES_PASS_GLSL
#define GNOMON_SMOOTHIES_PASS_GLSL
#include "../shared/smoothies.h"
layout(local_size_x = 8, local_size_y = 8) in;
layout(push_constant) uniform Push
{
    ivec4 tile; // first and last texel of the view's tile: x0, y0, x1, y1
    ivec4 area; // xy: the first texel to be made; z: layer; w: texels that edges are widened by
    vec4 rule;  // x: what stored depths may be off by
};
// Layers of the image between the passes.
const int kEdgeLayer = 0;
const int kRowLayer = 1;

#endif
