// SPDX-License-Identifier: Apache-2.0
// The curve from linear radiance to a screen's values, and the noise that hides the steps between them. Both GLSL and
// C++.
#ifndef GNOMON_TONE_CURVE_H
#define GNOMON_TONE_CURVE_H
#include "gnomon/shared/portability.h"
GN_BEGIN

// ToneCurve::filmic: K. Narkowicz, "ACES Filmic Tone Mapping Curve", 2015, of each channel by itself.
GN_FN real3 filmicTone(real3 x)
{
    real3 curve = (x * (real(2.51) * x + real(0.03))) / (x * (real(2.43) * x + real(0.59)) + real(0.14));
    return clamp(curve, real(0.0), real(1.0));
}

GN_CONST real kNeutralGain = real(1.3);   // brings a lit grey to where filmicTone() has it
GN_CONST real kNeutralToe = real(0.02);   // subtracted, so that haze does not make shade grey
GN_CONST real kNeutralStart = real(0.76); // where the compression starts
GN_CONST real kNeutralPale = real(0.15);  // how fast too bright light loses its colour

// ToneCurve::neutral: Khronos Group, "Khronos PBR Neutral Tone Mapper", 2024. The largest channel goes through a curve
// and takes the others along, so hues stay; very bright light goes to white. Two departures: the gain, and half of the
// toe, which is 0.04 there for rooms of white light and makes colours garish in the shade of a scene with a sun.
GN_FN real3 neutralTone(real3 light)
{
    real3 x = light * kNeutralGain;
    real least = min(x.x, min(x.y, x.z));
    x -= least < real(2.0) * kNeutralToe ? least - least * least / (real(4.0) * kNeutralToe) : kNeutralToe;
    real peak = max(x.x, max(x.y, x.z));
    if (peak < kNeutralStart) {
        return x;
    }
    real room = real(1.0) - kNeutralStart;
    real shown = real(1.0) - room * room / (peak + room - kNeutralStart);
    real pale = real(1.0) - real(1.0) / (kNeutralPale * (peak - shown) + real(1.0));
    return mix(x * (shown / peak), real3(shown), pale);
}

// In [0, 1), the same for ever at a pixel: interleaved gradient noise, J. Jimenez, "Next Generation Post Processing in
// Call of Duty: Advanced Warfare", SIGGRAPH 2014.
GN_FN real gradientNoise(real2 pixel)
{
    return fract(real(52.9829189) * fract(real(0.06711056) * pixel.x + real(0.00583715) * pixel.y));
}

// Evenly spread numbers to a triangle over [-1, 1], by the inverse of its distribution.
GN_FN real triangular(real even)
{
    real x = real(2.0) * even - real(1.0);
    return sign(x) * (real(1.0) - sqrt(max(real(1.0) - abs(x), real(0.0))));
}

// An encoded value with noise of up to one of 255 steps, so that its rounding has no pattern. Less near black and
// white, which stay what they are.
GN_FN real dithered(real encoded, real even)
{
    real room = min(encoded, real(1.0) - encoded) * real(255.0);
    return encoded + triangular(even) * clamp(room, real(0.0), real(1.0)) / real(255.0);
}

GN_END
#endif
