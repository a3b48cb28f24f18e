// SPDX-License-Identifier: Apache-2.0
// Based on: J. Jimenez, "Next Generation Post Processing in Call of Duty: Advanced Warfare", SIGGRAPH 2014: a chain of
// halvings, each the weighted mean of five overlapping boxes of 4 x 4 texels (thirteen bilinear taps), enlarged again
// by tents of 3 x 3 taps; the first halving weighs each box by 1 / (1 + brightness), after B. Karis, "Tone Mapping",
// 2013, so that a single sparkling pixel does not light up its surroundings. Both GLSL and C++.
//
// Every texel's weights sum to 1 over all that read it (times 4 where a level is enlarged), so light is only moved. All
// levels have the same share, so the sum over the chain is divided by their number.
#ifndef GNOMON_BLOOM_WEIGHTS_H
#define GNOMON_BLOOM_WEIGHTS_H
#include "gnomon/shared/portability.h"
GN_BEGIN

GN_CONST real kBloomCentre = real(0.5);   // weight of the box around the middle
GN_CONST real kBloomCorner = real(0.125); // weight of each of the four boxes two texels apart
GN_CONST real kBloomMost = real(60000.0); // brightest value that counts; half floats hold it

// How much of a brightness lies above the threshold. A parabola joins "nothing" below the knee to "all that exceeds"
// above it, with the slopes of both: (b - (t - h))^2 / 4h between t - h and t + h.
GN_FN real bloomExcess(real brightness, real threshold, real knee)
{
    real h = max(threshold * knee, real(1e-5));
    real s = clamp(brightness - threshold + h, real(0.0), real(2.0) * h);
    return max(s * s / (real(4.0) * h), brightness - threshold);
}

// The light of a pixel that glows, in its own hue.
GN_FN real3 bloomLight(real3 colour, real threshold, real knee)
{
    real3 c = min(max(colour, real3(real(0.0))), real3(kBloomMost));
    real brightness = max(c.x, max(c.y, c.z));
    return c * (max(bloomExcess(brightness, threshold, knee), real(0.0)) / max(brightness, real(1e-5)));
}

// Weight of a box of the first halving from its mean, beside its place's.
GN_FN real bloomCalm(real3 mean)
{
    return real(1.0) / (real(1.0) + max(mean.x, max(mean.y, mean.z)));
}

// The weight of a halving's bilinear tap `x`, `y` texels from its middle. Each box of 4 x 4 is four taps. Even
// distances (0, 2) belong to the corner boxes, odd ones to the centre's.
GN_FN real bloomTap(int x, int y)
{
    if (x == 1 || x == -1) {
        return kBloomCentre / real(4.0);
    }
    real along_x = x == 0 ? real(2.0) : real(1.0);
    real along_y = y == 0 ? real(2.0) : real(1.0);
    return kBloomCorner / real(4.0) * along_x * along_y;
}

// The weights of the tent's 3 x 3 taps; `x`, `y` in -1 .. 1.
GN_FN real bloomTent(int x, int y)
{
    real along_x = x == 0 ? real(2.0) : real(1.0);
    real along_y = y == 0 ? real(2.0) : real(1.0);
    return along_x * along_y / real(16.0);
}

GN_END
#endif
