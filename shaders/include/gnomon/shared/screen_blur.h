// SPDX-License-Identifier: Apache-2.0
// soften=blur: the weights by which a pixel of the mask takes from those around it.
// Based on: A. S. Shastry, "Soft-Edged Shadows", 2005 (a separable Gaussian of 15 taps over the visibility of the
// screen); G. Petschnig et al., "Digital Photography with Flash and No-Flash Image Pairs", SIGGRAPH 2004 (weights by
// another image's edges; ours are depth and normal).
// Departures: taps are symmetric and their weights are divided by their sum. The published ones are here too, to show
// what they do: publishedPlace(), publishedWeight().
#ifndef GNOMON_SCREEN_BLUR_H
#define GNOMON_SCREEN_BLUR_H
#include "portability.h"
GN_BEGIN

// gnomon::ScreenKernel; then the published Gaussian.
GN_CONST int kScreenGaussian = 0;
GN_CONST int kScreenBox = 1;
GN_CONST int kScreenPoisson = 2;
GN_CONST int kScreenPublished = 3;

// Places and widths are in tap distances at full size: 1 is ScreenBlurOptions::strength_px pixels of the picture.
GN_CONST real kScreenSigma = real(3.0); // the published width, of all taps but the middle one
GN_CONST int kScreenReach = 7;          // taps to each side: 15
GN_CONST int kPublishedTaps = 15;
// A disc's points have a standard deviation along x of half its radius.
GN_CONST real kScreenDiscRadius = real(6.0);

// Images of 1 / scale of the picture's size need fewer taps for the same width: 7, 4 or 2 to each side of the middle.
GN_FN int screenTapsAside(int scale)
{
    return (kScreenReach + scale - 1) / scale;
}
// The place of tap i in -aside .. aside.
GN_FN real screenTapPlace(int i, int scale)
{
    return real(i * scale);
}
// Not divided by the sum over all taps. The box reaches from -7.5 to 7.5, and a tap counts as far as the `scale`
// places around it lie inside.
GN_FN real screenTapWeight(int kernel, int i, int scale)
{
    real place = abs(screenTapPlace(i, scale));
    if (kernel == kScreenBox) {
        real inside = real(kScreenReach) + real(0.5) - place + real(0.5) * real(scale);
        return clamp(inside / real(scale), real(0.0), real(1.0));
    }
    return exp(real(-0.5) * place * place / (kScreenSigma * kScreenSigma));
}

// The article's GetGaussianDistribution().
GN_FN real publishedDistribution(real x, real rho)
{
    return exp(-(x * x) / (real(2.0) * rho * rho)) / sqrt(real(2.0) * real(3.141592654) * rho * rho);
}
// Tap i in 0 .. 14: the middle, then pairs at odd offsets.
GN_FN real publishedPlace(int i)
{
    return (i & 1) != 0 ? real(i) : (i == 0 ? real(0.0) : real(1 - i));
}
// The two of a pair are weighed by different offsets, and the middle by another width. They sum to 1.067.
GN_FN real publishedWeight(int i)
{
    return i == 0 ? publishedDistribution(real(0.0), real(2.0)) : real(2.0) * publishedDistribution(real(i), real(3.0));
}

// The weight of a pixel's neighbour. `off_px`: how far its surface lies from the plane of the pixel's own, in widths of
// a pixel there. Within one width it is the same surface, beyond two another one, so every visible step separates
// surfaces.
GN_FN real screenDepthShare(real off_px)
{
    return clamp(real(2.0) - off_px, real(0.0), real(1.0));
}
// `cosine`: cosine of the angle between both surfaces' normals. 1 up to 18 degrees, 0 from 37 on.
GN_FN real screenNormalShare(real cosine)
{
    return clamp((cosine - real(0.8)) / real(0.15), real(0.0), real(1.0));
}

// The whole number nearest to a place, the same to both sides of 0.
GN_FN real nearestPixel(real place)
{
    return sign(place) * floor(abs(place) + real(0.5));
}

// The pixel of the picture that a texel of an image of 1 / scale of its size stands for, where edges count.
GN_FN int pixelOfTexel(int texel, int scale)
{
    return texel * scale + scale / 2;
}

GN_END
#endif
