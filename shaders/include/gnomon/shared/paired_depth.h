// SPDX-License-Identifier: Apache-2.0
// Two maps in one colour target: each has a part of a texel's channels, and the pipeline's colour write mask keeps the
// other map's.
// Based on: P. Fortier, "Shadow maps for moving light sources", IceFall Games, 2010 (EncodeShadowDepth).
// Departure: there a depth is floor(255 d) and the fraction of 255 d, which share their last value: 65,025 steps, two
// codes for each 255th of them, and a low byte that is never more than 0 where the high one is 255. Here the two bytes
// are one number of 16 bits, so that every code is a depth of its own, as in D16.
#ifndef GNOMON_PAIRED_DEPTH_H
#define GNOMON_PAIRED_DEPTH_H
#include "portability.h"
GN_BEGIN

// How a texel holds depths.
GN_CONST int kDepthAlone = 0;     // one map: its first channel
GN_CONST int kDepthChannel = 1;   // two maps, a channel each
GN_CONST int kDepthBytes = 2;     // two maps, two channels of 8 bits each, the high byte first
GN_CONST int kDepthSmoothies = 3; // as kDepthAlone, with smoothies beside the map (smoothies.h)

// The two bytes of a depth in [0, 1], as the numbers in [0, 1] that a channel of 8 bits takes. The depth that they
// stand for is at most 0.5 / 65535 away, and never less for a greater depth.
GN_FN real2 depthToBytes(real depth)
{
    real code = floor(depth * real(65535.0) + real(0.5));
    real high = floor(code / real(256.0));
    return real2(high, code - real(256.0) * high) / real(255.0);
}

GN_FN real depthFromBytes(real high, real low)
{
    return (real(65280.0) * high + real(255.0) * low) / real(65535.0);
}

// The value that a caster writes to all channels. `depth` in [0, 1].
GN_FN real4 pairedTexel(int holding, real depth)
{
    real4 texel = real4(depth);
    if (holding == kDepthBytes) {
        real2 bytes = depthToBytes(depth);
        texel = real4(bytes.x, bytes.y, bytes.x, bytes.y);
    }
    return texel;
}

// The depth of the first map (part 0) or the second (part 1) of a texel; of a map alone part does not count.
GN_FN real pairedDepth(int holding, real4 texel, real part)
{
    bool second = part > real(0.5);
    if (holding == kDepthBytes)
        return second ? depthFromBytes(texel.z, texel.w) : depthFromBytes(texel.x, texel.y);
    if (holding == kDepthChannel)
        return second ? texel.y : texel.x;
    return texel.x;
}

GN_END
#endif
