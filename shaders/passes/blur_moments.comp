#version 460
// SPDX-License-Identifier: Apache-2.0
// Turns drawn depths into a filterable map's values, blurred along x, and notes which blocks a caster reaches so.
// Values that are not blurred yet are never written: a thread walks along a row of a block and has them in registers.
#extension GL_GOOGLE_include_directive : require
#define GN_FROM_DEPTHS
#include "gnomon/lib/blur_window.glsl"
#include "gnomon/lib/scratch.glsl"
#include "gnomon/lib/texel_moments.glsl"

layout(local_size_x = kBlockTexels) in;

void main()
{
    ivec2 block = ivec2(gl_WorkGroupID.xy);
    int layer = int(gl_WorkGroupID.z);
    ivec2 first = block * kBlockTexels + ivec2(0, int(gl_LocalInvocationID.x));
    if (first.y >= place.size.y) {
        return;
    }
    int columns = min(kBlockTexels, place.size.x - first.x);
    EncodeInput far_plane = litInput(layer);
    vec4 lit = encodeDepth(kFilter, far_plane, momentRule());
    ivec3 target = inScratch(first, layer);
    bool any_caster = false;
    startWindow();
    for (int i = -kRadius; i < kRadius; ++i) {
        TexelMoments moments = momentsOf(first + ivec2(i, 0), far_plane, lit);
        any_caster = any_caster || moments.has_caster;
        slideWindow(moments.value);
    }
    for (int i = 0; i < columns; ++i) {
        TexelMoments moments = momentsOf(first + ivec2(i + kRadius, 0), far_plane, lit);
        any_caster = any_caster || moments.has_caster;
        imageStore(target_image, target + ivec3(i, 0, 0), slideWindow(moments.value));
    }
    if (any_caster && layer == 0) {
        atomicOr(blocks[block.y * place.size.z + block.x], kReachedAlongX);
    }
}
