// SPDX-License-Identifier: Apache-2.0
// GLSL only: what both stages that draw fins have in common.
#ifndef GNOMON_FIN_PASS_GLSL
#define GNOMON_FIN_PASS_GLSL
#include "../shared/smoothie_fins.h"
layout(push_constant) uniform Push
{
    vec4 row_x; // these take the object's own points to clip space and to the map's depth
    vec4 row_y;
    vec4 row_w;
    vec4 row_depth;
    vec4 tile; // the view's, texels: xy its first corner, zw half its size
    vec4 rule; // x: texels that fins reach, y: what stored depths may be off by, z: the map's layer, w: 1 where the map cuts what is before its near
               // plane, 0 where it clamps it
};

#endif
