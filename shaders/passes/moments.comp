#version 460
// SPDX-License-Identifier: Apache-2.0
// Turns drawn depths into a filterable map that is not blurred.
#extension GL_GOOGLE_include_directive : require
#define GN_FROM_DEPTHS
#include "gnomon/lib/texel_moments.glsl"

layout(local_size_x = 32) in; // a thread walks down a column

void main()
{
    int layer = int(gl_WorkGroupID.z);
    ivec2 first = ivec2(int(gl_GlobalInvocationID.x), int(gl_WorkGroupID.y) * kWalkTexels);
    if (first.x >= place.size.x) {
        return;
    }
    int rows = min(kWalkTexels, place.size.y - first.y);
    ivec3 target = ivec3(place.target.xy + first, place.target.z + layer);
    EncodeInput far_plane = litInput(layer);
    vec4 lit = encodeDepth(kFilter, far_plane, momentRule());
    for (int i = 0; i < rows; ++i) {
        TexelMoments moments = momentsOf(first + ivec2(0, i), far_plane, lit);
        imageStore(target_image, target + ivec3(0, i, 0), moments.value);
    }
}
