#version 460
// SPDX-License-Identifier: Apache-2.0
// The second direction of a blur, along y, from the scratch image into the map. A thread walks down a column of a block.
// The tile's outermost texels hold what is lit, and so does everything outside: reads are clamped.
#extension GL_GOOGLE_include_directive : require
#include "gnomon/lib/blur_window.glsl"
#include "gnomon/lib/encoders.glsl"
#include "gnomon/lib/scratch.glsl"

layout(local_size_x = kBlockTexels) in;

void main()
{
    ivec2 block = ivec2(gl_WorkGroupID.xy);
    int layer = int(gl_WorkGroupID.z);
    ivec2 first = block * kBlockTexels + ivec2(int(gl_LocalInvocationID.x), 0);
    if (first.x >= place.size.x) {
        return;
    }
    int rows = min(kBlockTexels, place.size.y - first.y);
    ivec3 target = ivec3(place.target.xy + first, place.target.z + layer);
    if ((blocks[block.y * place.size.z + block.x] & kReached) == 0u) {
        vec4 lit = encodeDepth(kFilter, litInput(layer), momentRule());
        for (int i = 0; i < rows; ++i) {
            imageStore(target_image, target + ivec3(0, i, 0), lit);
        }
        return;
    }
    ivec3 column = inScratch(ivec2(first.x, 0), layer);
    int last = place.size.y - 1;
    startWindow();
    for (int i = -kRadius; i < kRadius; ++i) {
        int y = clamp(first.y + i, 0, last);
        slideWindow(storedPart(texelFetch(source_image, column + ivec3(0, y, 0), 0)));
    }
    for (int i = 0; i < rows; ++i) {
        int y = min(first.y + i + kRadius, last);
        vec4 value = storedPart(texelFetch(source_image, column + ivec3(0, y, 0), 0));
        imageStore(target_image, target + ivec3(0, i, 0), slideWindow(value));
    }
}
