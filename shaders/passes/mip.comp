#version 460
// SPDX-License-Identifier: Apache-2.0
// One mip level of a tile from the next finer one: the average of four texels.
#extension GL_GOOGLE_include_directive : require
#include "../lib/filter_pass.glsl"

layout(local_size_x = 32, local_size_y = 4) in;

vec4 sourceAt(ivec2 texel)
{
    return texelFetch(source_image, ivec3(place.source.xy + texel, place.source.z + int(gl_WorkGroupID.z)), 0);
}

void main()
{
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (texel.x >= place.size.x || texel.y >= place.size.y) {
        return;
    }
    ivec2 fine = 2 * texel;
    vec4 k = averageExponents(kFilter, momentRule());
    vec4 average = averageOfFour(sourceAt(fine), sourceAt(fine + ivec2(1, 0)), sourceAt(fine + ivec2(0, 1)),
                                 sourceAt(fine + ivec2(1, 1)), k, averagesLogs());
    imageStore(target_image, ivec3(place.target.xy + texel, place.target.z + int(gl_WorkGroupID.z)), average);
}
