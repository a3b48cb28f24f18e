#version 460
// SPDX-License-Identifier: Apache-2.0
// Two levels of a map's blocks (gnomon/shared/map_blocks.h), from its texels (FROM_MAP) or from a level of blocks. A thread
// makes four blocks of the finer level and the one of the coarser level that they are parts of: without a word to other
// threads, for which some devices have to wait long.
#extension GL_GOOGLE_include_directive : require
#include "gnomon/shared/map_blocks.h"
layout(local_size_x = kBlockGroup, local_size_y = kBlockGroup) in;
#ifdef FROM_MAP
layout(set = 0, binding = 0) uniform sampler2DArray source;
#else
layout(set = 0, binding = 0, r32ui) readonly uniform uimage2DArray source;
#endif
layout(set = 0, binding = 1, r32ui) writeonly uniform uimage2DArray finer;
layout(set = 0, binding = 2, r32ui) writeonly uniform uimage2DArray coarser;
layout(push_constant) uniform Push
{
    ivec4 first; // x, y: group; z: layer; w: levels to make
    ivec4 last;  // texels or blocks of the source to read at most: x, y
};

#ifdef FROM_MAP
// Of the four texels from `at` on; beyond the map its last ones go on. Software gathers four in half the time that it
// fetches them one by one.
int blockFrom(ivec2 at)
{
    vec4 depths = textureGather(source, vec3((vec2(at) + 1.0) / vec2(last.xy + 1), float(first.z)));
    // min() and max() may leave out a NaN, but a sum does not.
    float any = (depths.x + depths.y) + (depths.z + depths.w);
    float nearest = min(min(depths.x, depths.y), min(depths.z, depths.w));
    float farthest = max(max(depths.x, depths.y), max(depths.z, depths.w));
    return any == any ? blockOf(nearest, farthest) : blockOf(any, any);
}
#else
int blockAt(ivec2 at)
{
    return int(imageLoad(source, ivec3(min(at, last.xy), first.z)).x);
}

int blockFrom(ivec2 at)
{
    return joinedBlocks(joinedBlocks(blockAt(at), blockAt(at + ivec2(1, 0))),
                        joinedBlocks(blockAt(at + ivec2(0, 1)), blockAt(at + ivec2(1, 1))));
}
#endif

void main()
{
    ivec2 me = first.xy * kBlockGroup + ivec2(gl_GlobalInvocationID.xy);
    int whole = 0;
    for (int i = 0; i < 4; ++i) {
        ivec2 part = 2 * me + ivec2(i & 1, i >> 1);
        int block = blockFrom(2 * part);
        if (all(lessThan(part, imageSize(finer).xy))) {
            imageStore(finer, ivec3(part, first.z), uvec4(uint(block)));
        }
        whole = i == 0 ? block : joinedBlocks(whole, block);
    }
    if (first.w > 1 && all(lessThan(me, imageSize(coarser).xy))) {
        imageStore(coarser, ivec3(me, first.z), uvec4(uint(whole)));
    }
}
