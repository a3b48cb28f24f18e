#version 460
// SPDX-License-Identifier: Apache-2.0
// Which blocks a blur has to work on, from which blocks have casters. A blur reaches less than a block far, so that what
// it reads lies in a block and its neighbours.
#extension GL_GOOGLE_include_directive : require
#include "../lib/filter_pass.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

bool rowHasCaster(ivec2 block)
{
    if (block.y < 0 || block.y >= place.size.w) {
        return false;
    }
    bool any_caster = false;
    for (int x = max(block.x - 1, 0); x <= min(block.x + 1, place.size.z - 1); ++x) {
        any_caster = any_caster || (blocks[block.y * place.size.z + x] & kHasCaster) != 0u;
    }
    return any_caster;
}

void main()
{
    ivec2 block = ivec2(gl_GlobalInvocationID.xy);
    if (block.x >= place.size.z || block.y >= place.size.w) {
        return;
    }
    bool in_row = rowHasCaster(block);
    bool in_reach = in_row || rowHasCaster(block + ivec2(0, -1)) || rowHasCaster(block + ivec2(0, 1));
    // A blur along y reads the next block's rows, whatever the reason why it is done.
    bool is_read = in_reach || rowHasCaster(block + ivec2(0, -2)) || rowHasCaster(block + ivec2(0, 2));
    if (!is_read) {
        return;
    }
    ivec2 texels = min(place.size.xy - block * kBlockTexels, ivec2(kBlockTexels));
    uint count = uint(texels.x * texels.y * place.target.w);
    if (in_reach) {
        atomicAdd(counts.blurred_y, count);
    }
    if (in_row) {
        atomicAdd(counts.blurred_x, count);
    } else {
        atomicAdd(counts.filled, count);
    }
    uint work = (in_row ? kBlurX : kFillX) | (in_reach ? kBlurY : 0u);
    // Neighbours look at kHasCaster alone, which stays as it is.
    atomicOr(blocks[block.y * place.size.z + block.x], work);
}
