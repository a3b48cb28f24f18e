#version 460
// SPDX-License-Identifier: Apache-2.0
// Turns drawn depths into a filterable map that is not blurred.
#extension GL_GOOGLE_include_directive : require
#define GN_FROM_DEPTHS
#include "../lib/texel_moments.glsl"

layout(local_size_x = 32, local_size_y = 4) in;

void main()
{
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    int layer = int(gl_WorkGroupID.z);
    if (texel.x >= place.size.x || texel.y >= place.size.y) {
        return;
    }
    EncodeInput far_plane = litInput(layer);
    vec4 lit = encodeDepth(kFilter, far_plane, momentRule());
    TexelMoments moments = momentsOf(texel, far_plane, lit);
    imageStore(target_image, ivec3(place.target.xy + texel, place.target.z + layer), moments.value);
}
