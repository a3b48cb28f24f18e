// SPDX-License-Identifier: Apache-2.0
// From which alpha on a masked surface is solid.
// Based on: Khronos Group, "glTF 2.0 specification", 3.9.4: solid where alpha is equal to the cutoff or above.
// Departure: alpha that a device has sampled and interpolated is off by its last bits, even where it is the same at all
// vertices, and would be solid in some pixels and clear in others. So it may be a little less.
#ifndef GNOMON_ALPHA_CUTOFF_H
#define GNOMON_ALPHA_CUTOFF_H
#include "portability.h"
GN_BEGIN

// A step of 16 bits, which vertex colours may be stored as; half of it is what they are off by.
GN_CONST real kAlphaStep = real(1.0 / 65536.0);

// The limit that alpha is compared with for this cutoff, 0 or above. Quite clear alpha stays so: the limit is above 0
// where the cutoff is.
GN_FN real alphaLimit(real cutoff)
{
    return cutoff - min(kAlphaStep, real(0.5) * cutoff);
}

GN_END
#endif
