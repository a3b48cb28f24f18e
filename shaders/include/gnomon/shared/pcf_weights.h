// SPDX-License-Identifier: Apache-2.0
// Weights of the separable kernels of percentage-closer filtering.
// Based on: W. Reeves, D. Salesin, R. Cook, "Rendering Antialiased Shadows with Depth Maps", SIGGRAPH 1987; the
// Gaussian weighting as in P. Shastry, "Soft-Edged Shadows", 2005, but symmetric and normalised (the published taps are
// neither).
#ifndef GNOMON_PCF_WEIGHTS_H
#define GNOMON_PCF_WEIGHTS_H
#include "portability.h"
GN_BEGIN

// Widths that stand for kernels of nine point samples: a texel apart, and with offsets that are divided by the map's w.
GN_CONST int kBoxKernel = -3;
GN_CONST int kProjectedKernel = -4;

// The factor of the offsets of nine point samples. In the article of 2005 a texel is added to homogeneous coordinates,
// and the projective fetch divides it by w too: metres from a lamp along the map's axis, so that all nine samples
// nearly coincide. For a parallel light w is 1. Nearer than 1 m they would be farther apart than intended, so the
// factor is at most 1.
GN_FN real pointSpread(int width, real w)
{
    return width == kProjectedKernel ? real(1.0) / max(w, real(1.0)) : real(1.0);
}

// Weights of the taps at distance 0, 1, 2, 3 texels of a kernel `width` (1, 3, 5, 7) texels wide, normalised so that
// w0 + 2 (w1 + w2 + w3) = 1. sigma in texels; 0 picks width / 4.
GN_FN real4 gaussianWeights(int width, real sigma)
{
    real s = sigma > real(0.0) ? sigma : real(width) * real(0.25);
    real k = real(-0.5) / (s * s);
    real w1 = width > 2 ? exp(k) : real(0.0);
    real w2 = width > 4 ? exp(k * real(4.0)) : real(0.0);
    real w3 = width > 6 ? exp(k * real(9.0)) : real(0.0);
    real scale = real(1.0) / (real(1.0) + real(2.0) * (w1 + w2 + w3));
    return real4(scale, w1 * scale, w2 * scale, w3 * scale);
}

// Weight of tap `i` in 0 .. width - 1, 0 elsewhere.
GN_FN real tapWeight(real4 weights, int width, int i)
{
    int distance = abs(i - (width - 1) / 2);
    return i >= 0 && i < width ? weights[distance] : real(0.0);
}

// A tap is a bilinear blend of two texels (per axis). Adding those of all taps up, texel k in 0 .. width gets this
// weight, f being the receiver's place between two texel centres.
GN_FN real texelWeight(real4 weights, int width, int k, real f)
{
    return tapWeight(weights, width, k) * (real(1.0) - f) + tapWeight(weights, width, k - 1) * f;
}

GN_END
#endif
