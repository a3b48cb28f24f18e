#version 460
// SPDX-License-Identifier: Apache-2.0
// One mip level of a tile from the next finer one: the average of four texels.
#extension GL_GOOGLE_include_directive : require
#include "gnomon/lib/filter_pass.glsl"

layout(local_size_x = 32) in; // a thread walks down a column

void main()
{
    int layer = int(gl_WorkGroupID.z);
    ivec2 first = ivec2(int(gl_GlobalInvocationID.x), int(gl_WorkGroupID.y) * kWalkTexels);
    if (first.x >= place.size.x) {
        return;
    }
    int rows = min(kWalkTexels, place.size.y - first.y);
    ivec3 source = ivec3(place.source.xy + 2 * first, place.source.z + layer);
    ivec3 target = ivec3(place.target.xy + first, place.target.z + layer);
    vec4 k = averageExponents(kFilter, momentRule());
    for (int i = 0; i < rows; ++i) {
        ivec3 fine = source + ivec3(0, 2 * i, 0);
        vec4 a = storedPart(texelFetch(source_image, fine, 0));
        vec4 b = storedPart(texelFetch(source_image, fine + ivec3(1, 0, 0), 0));
        vec4 c = storedPart(texelFetch(source_image, fine + ivec3(0, 1, 0), 0));
        vec4 d = storedPart(texelFetch(source_image, fine + ivec3(1, 1, 0), 0));
        imageStore(target_image, target + ivec3(0, i, 0), averageOfFour(a, b, c, d, k, averagesLogs()));
    }
}
