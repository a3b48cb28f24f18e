// SPDX-License-Identifier: Apache-2.0
// The brightness of a picture to an eye adapted to its light. Both GLSL and C++. Based on: G. Krawczyk, K. Myszkowski,
// H.-P. Seidel, "Perceptual Effects in Real-time Tone Mapping", 2005, equation 11.
#ifndef HOST_ADAPTATION_H
#define HOST_ADAPTATION_H
#include "gnomon/shared/portability.h"
GN_BEGIN

// The key of a picture whose mean luminance is `luminance`, candela per square metre: 0.03 in the dark, 0.69 on a sunny
// day. A full moon's light comes out at a twentieth of the sun's.
GN_FN real adaptedKey(real luminance)
{
    return real(1.03) - real(2.0) / (real(2.0) + log(luminance + real(1.0)) / real(2.302585092994046));
}

GN_END
#endif
