// SPDX-License-Identifier: Apache-2.0
// Where layers of lvsm meet so that little light is expected to bleed. Two casters at depths a < b in one kernel look,
// from a receiver at c > b, like one that lets light through: by Chebyshev's bound (moments.h), each over half of the
// kernel,
//   (1) V(a, b, c) = g^2 / (g^2 + (2 h + g)^2), g = b - a, h = c - b.
// In a layer whose near end n lies beyond a, g is b - n, and from b on nothing bleeds. A map does not hold what lies
// below b, but surfaces seldom end there: so we look at pairs of depths within a kernel, and take the depths around
// them for receivers that they may hide. A pair loses V^2 h, as errors are squared and as what can be seen below b is
// about as high as h. The sum over all of them is
//   (2) lost(n, c): what near end n leaves for receivers in bin c,
// and a layer from s to e with near end n loses lost(n, c) over the bins c from s to e, and a little for its width:
// rounding grows with it, and layers that have nothing to part should be of one width.
// Layers are parted one by one, each time where the whole loses most: so more layers have all the splits of fewer, and
// do not bleed where these do not. A split then goes to the middle of where it may lie for next to the same loss.
// A map does not hold the walls below its casters, nor the floors below its roofs, and a split that parts what it holds
// leaves these in the wide layer before it. So layers are of one width unless the splits are expected to leave a small
// share of what those leave: savesEnough().
#ifndef GNOMON_LAYER_GAPS_H
#define GNOMON_LAYER_GAPS_H
#include "depth_layers.h"
GN_BEGIN

GN_CONST int kGapBins = 256; // bins of depth, from 0 to 1
GN_CONST int kLeastBins = 4; // least bins of a layer: kLeastLayerWidth
GN_CONST int kGapColumns = kGapBins + 1;

// V^2 h of (1), in 1/16384, at most 256 and mostly far less: sums of 2^20 fit 32 bits. Receivers right behind b are
// taken for the same surface as b.
GN_FN int gapWeight(real a, real b, real c)
{
    real g = b - a;
    real h = c - b;
    real beyond = real(2.0) * h + g;
    real v = g * g / max(g * g + beyond * beyond, real(1e-30));
    return h > kLeastLayerWidth ? int(v * v * h * real(16384.0) + real(0.5)) : 0;
}

// The bin that holds the near end of a layer of the bins begins .. ends - 1.
GN_FN int nearBin(int begins, int ends, real overlap)
{
    return max(int(floor(real(begins) - overlap * real(ends - begins))), 0);
}

// The loss of a layer. `left`: its loss by (2); `all`: the loss by (2) of a single layer over all; `bins`: the layer's
// width.
GN_FN real layerLoss(real left, real all, int bins)
{
    real width = real(bins) / real(kGapBins);
    return left + (real(0.001) * all + real(1.0)) * width * width;
}

// Are two losses nearly the same? Splits stay where they are while their loss is nearly the least. `all` is the loss by
// (2) of a single layer over all. Layers lose up to 0.001 of it by their widths alone, so that much more is alike.
GN_FN bool isLossAlike(real loss, real least, real all)
{
    return loss <= real(1.125) * least + real(0.001) * all;
}

// The bin where layer i of `count` of one width begins.
GN_FN int uniformBin(int i, int count)
{
    return (i * kGapBins + count / 2) / count;
}

// Do splits save enough of what `count` layers of one width lose? They do if they leave no more than a share of it over
// the square of the count: what narrow layers leave is little, and what a map does not hold weighs more. Layers that
// were there before may leave twice the share, so that they do not go to and fro.
GN_CONST real kConvincingShare = real(0.25);
GN_CONST real kHeldGapsShare = real(0.5);
GN_FN bool savesEnough(real loss, real of_uniform, int count, real share)
{
    return loss * real(count * count) <= share * of_uniform;
}

GN_END
#endif
