// SPDX-License-Identifier: Apache-2.0
// Unit vectors in two numbers, for the geometric and the shading normal of a pixel.
#ifndef HOST_OCTAHEDRAL_PAIR_GLSL
#define HOST_OCTAHEDRAL_PAIR_GLSL
#include "shared/octahedral.h"

vec4 encodeNormals(vec3 geometric, vec3 shading)
{
    return vec4(octahedralEncode(geometric), octahedralEncode(shading));
}

#endif
