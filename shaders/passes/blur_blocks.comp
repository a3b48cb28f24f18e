#version 460
// SPDX-License-Identifier: Apache-2.0
// Which blocks the second direction of a blur has to work on. It reaches less than a block far, so that what it reads
// lies in a block and its neighbours.
#extension GL_GOOGLE_include_directive : require
#include "gnomon/lib/filter_pass.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

void main()
{
    ivec2 block = ivec2(gl_GlobalInvocationID.xy);
    if (block.x >= place.size.z || block.y >= place.size.w) {
        return;
    }
    bool in_reach = false;
    for (int y = max(block.y - 1, 0); y <= min(block.y + 1, place.size.w - 1); ++y) {
        in_reach = in_reach || (blocks[y * place.size.z + block.x] & kReachedAlongX) != 0u;
    }
    ivec2 texels = min(place.size.xy - block * kBlockTexels, ivec2(kBlockTexels));
    uint count = uint(texels.x * texels.y * place.target.w);
    if (in_reach) {
        atomicAdd(counts.blurred, count);
        // Neighbours look at kReachedAlongX alone, which stays as it is.
        atomicOr(blocks[block.y * place.size.z + block.x], kReached);
    } else {
        atomicAdd(counts.filled, count);
    }
}
