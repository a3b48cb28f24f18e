// SPDX-License-Identifier: Apache-2.0
// Blocks bound a square of a map's texels without reading them: the nearest and the farthest depth, as two numbers of
// 16 bits in one of 32. Both are rounded outwards, so that they bound every texel. A block of level L has 2^L texels on
// a side and begins at a multiple of that on the map's page, across the tiles that lie there. The last level has one
// block.
#ifndef GNOMON_MAP_BLOCKS_H
#define GNOMON_MAP_BLOCKS_H
#include "portability.h"
GN_BEGIN

GN_CONST int kBlockLevelsOfPass = 2;
GN_CONST int kBlockGroup = 8; // threads of a group along x and y; each makes a block of the pass's coarser level
GN_CONST real kBlockSteps = real(65535.0);

// x: nearest, y: farthest depth. NaN gives no bounds: 0 and 1.
GN_FN real2 blockDepths(int both)
{
    return real2(real(both & 0xffff), real((both >> 16) & 0xffff)) / kBlockSteps;
}

GN_FN int blockOf(real nearest, real farthest)
{
    // A little more than single precision may be off.
    real slack = real(0.01);
    real low = nearest >= real(0.0) ? min(nearest, real(1.0)) : real(0.0);
    real high = farthest <= real(1.0) ? max(farthest, real(0.0)) : real(1.0);
    int from = int(max(floor(low * kBlockSteps - slack), real(0.0)));
    int to = int(min(ceil(high * kBlockSteps + slack), kBlockSteps));
    return from | (to << 16);
}

GN_FN int joinedBlocks(int a, int b)
{
    int from = (a & 0xffff) < (b & 0xffff) ? (a & 0xffff) : (b & 0xffff);
    int a_to = (a >> 16) & 0xffff;
    int b_to = (b >> 16) & 0xffff;
    return from | ((a_to > b_to ? a_to : b_to) << 16);
}

GN_END
#endif
