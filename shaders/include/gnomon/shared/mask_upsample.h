// SPDX-License-Identifier: Apache-2.0
// How a pixel takes from an image of a smaller size: from the texels around it, by how near they are and by whether
// they stand for pixels of its surface (screen_blur.h); and for mask-size=half, whether what it gets is to be believed.
// Based on: J. Kopf, M. Cohen, D. Lischinski, M. Uyttendaele, "Joint Bilateral Upsampling", SIGGRAPH 2007.
// Departures: the spatial weights are bilinear, of four texels. A texel is a pixel's own value, and no average.
#ifndef GNOMON_MASK_UPSAMPLE_H
#define GNOMON_MASK_UPSAMPLE_H
#include "portability.h"
GN_BEGIN

// For a mask of half the size: the least share of the weights that must lie on the pixel's surface. Between two texels
// one is enough, between four two.
GN_CONST real kUpsampleLeast = real(0.45);
// Texels of one surface whose visibility differs by more have an edge of a shadow between them.
GN_CONST real kUpsampleApart = real(0.1);

// The bilinear weight of corner 0 .. 3: bit 0 is the right one, bit 1 the lower one. `part`: the place between them.
GN_FN real cornerShare(real2 part, int corner)
{
    real x = (corner & 1) != 0 ? part.x : real(1.0) - part.x;
    real y = (corner & 2) != 0 ? part.y : real(1.0) - part.y;
    return x * y;
}

// Between what texels a pixel lies, for one that is pixel `place` of the picture: pixelOfTexel() is on a texel.
GN_FN real texelOfPixel(int place, int scale)
{
    return (real(place) - real(scale / 2)) / real(scale);
}

// Is what the texels around a pixel say what it would have seen? `weights`: their sum. `apart`: how far apart those
// are that count.
GN_FN bool upsampleHolds(real weights, real apart)
{
    return weights >= kUpsampleLeast && apart <= kUpsampleApart;
}

GN_END
#endif
