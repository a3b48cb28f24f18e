// SPDX-License-Identifier: Apache-2.0
// How much of the light goes on behind a blended surface.
// Based on: T. Porter, T. Duff, "Compositing Digital Images", SIGGRAPH 1984: alpha is the share of the surface that is
// covered. Covered parts let nothing through, or, stained, the share that is their colour.
#ifndef GNOMON_BLENDED_TINT_H
#define GNOMON_BLENDED_TINT_H
#include "portability.h"
GN_BEGIN

// The share of red, green and blue light that goes on, [0, 1]. `colour`: linear, its alpha the coverage, all [0, 1].
// `stained`: 1 where it takes from the light what its colour does not have, 0 where it takes all.
GN_FN real3 blendedTint(real4 colour, real stained)
{
    real3 kept = stained * real3(colour.x, colour.y, colour.z);
    return real3(real(1.0)) - colour.w * (real3(real(1.0)) - kept);
}

GN_END
#endif
