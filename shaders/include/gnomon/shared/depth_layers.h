// SPDX-License-Identifier: Apache-2.0
// Layered variance shadow maps: where one layer of depth ends and the next begins. Depths here are those that are
// stored, as momentDepth() returns them: with z / w stored, layers are placed in z / w. Based on: A. Lauritzen, M.
// McCool, "Layered Variance Shadow Maps", Graphics Interface 2008 (layers, overlap, Lloyd relaxation); A. Marinescu,
// "Achieving real-time soft shadows using LVSM in an RTS game", 2011, eq. 5; S. Lloyd, "Least Squares Quantization in
// PCM", 1982.
//
// Layer i takes receivers from begins(i) to begins(i + 1); begins(0) = 0, and the last one ends at 1. Lloyd relaxation:
//   1. histogram of the map's depths (binOf), without texels that nothing was drawn to
//   2. means: lloydStart(i, count, lowest, highest) over the range that has depths
//   3. splits: for i = 1 .. count - 1: begins(i) = lloydSplit(i, count, mean(i - 1), mean(i), begins(i - 1))
//   4. mean(i) = lloydMean(depths in the layer, their sum, mean(i)); a bin belongs to the layer that holds its centre
//   5. again from 3, as often as wanted, ending with 3; then layerBetween() adds the overlap.
// In maps that stand still from frame to frame layers do so too, until a split is off: isSplitOff().
#ifndef GNOMON_DEPTH_LAYERS_H
#define GNOMON_DEPTH_LAYERS_H
#include "moment_rule.h"
GN_BEGIN

// No layer is narrower, so that its metric magnifies rounding and slopes at most so much.
GN_CONST real kLeastLayerWidth = real(0.015625); // 1 / 64
// The value in GpuDepthLayers beyond the last layer: no receiver is ever there.
GN_CONST real kNoLayerBegins = real(2.0);

// (1) A layer's own metric: d'' = clamp((d - near) / (far - near), 0, 1). `layer` as in GpuDepthLayers: near, far,
// begins, mean or begins. NaN becomes the far end: lit.
GN_FN real layerMetric(real d, real4 layer)
{
    real x = (d - layer.x) / max(layer.y - layer.x, real(1e-6));
    return x <= real(1.0) ? max(x, real(0.0)) : real(1.0);
}

GN_FN real4 noLayer()
{
    return real4(real(0.0), real(1.0), kNoLayerBegins, real(1.0));
}
GN_FN bool isLayer(real4 layer)
{
    return layer.z < real(1.5);
}

// The layer that takes receivers from `begins` to `ends`; (2) it reaches `overlap` of its width into its neighbours, so
// that what a filter mixes in from beyond a split still has its own depth. Clamped to [0, 1].
GN_FN real4 layerBetween(real begins, real ends, real mean, real overlap)
{
    real reach = overlap * max(ends - begins, real(0.0));
    return real4(max(begins - reach, real(0.0)), min(ends + reach, real(1.0)), begins, mean);
}

GN_FN real uniformBegin(int i, int count)
{
    return real(i) / real(count);
}
GN_FN real4 uniformLayer(int i, int count, real overlap)
{
    real begins = uniformBegin(i, count);
    real ends = uniformBegin(i + 1, count);
    return layerBetween(begins, ends, real(0.5) * (begins + ends), overlap);
}

// By hand: split_before is where layer i meets i - 1, split_after where it meets i + 1; the outer ones do not matter.
GN_FN real4 layerByHand(int i, int count, real split_before, real split_after, real overlap)
{
    real begins = i == 0 ? real(0.0) : split_before;
    real ends = i == count - 1 ? real(1.0) : split_after;
    return layerBetween(begins, ends, real(0.5) * (begins + ends), overlap);
}

// (1) A layer of the world, Marinescu 2011, eq. 5: near and far as they are, in the view's depths. Receivers between
// two layers, or in both, are parted halfway between the end of the one and the beginning of the other; `far_before` is
// that of the layer before, `first`: there is none. No receiver is beyond 1, so what begins there begins short of
// noLayer().
GN_CONST real kBeyondAll = real(1.25);
GN_FN real4 layerOfWorld(bool first, real far_before, real near, real far)
{
    real begins = first ? real(0.0) : min(real(0.5) * (far_before + near), kBeyondAll);
    return real4(near, far, begins, begins);
}

// A receiver is in the last layer for which this holds. NaN is in none.
GN_FN bool beginsBefore(real4 layer, real d)
{
    return layer.z <= d;
}

// Bins of the histogram; NaN is in the last one.
GN_FN int binOf(real d, int bins)
{
    real x = d < real(1.0) ? max(d, real(0.0)) : real(1.0);
    int bin = int(x * real(bins));
    return bin < bins ? bin : bins - 1;
}
GN_FN real binCentre(int bin, int bins)
{
    return (real(bin) + real(0.5)) / real(bins);
}
GN_FN bool layerHoldsBin(int bin, int bins, real begins, real ends)
{
    real centre = binCentre(bin, bins);
    return centre >= begins && centre < ends;
}

// Spread over the range that has depths, so that no layer starts out empty where another has much to hold.
GN_FN real lloydStart(int i, int count, real lowest, real highest)
{
    return lowest + (highest - lowest) * (real(i) + real(0.5)) / real(count);
}

// (3) The middle between the means of the two layers that meet at begins(i); each layer keeps its least width.
GN_FN real lloydSplit(int i, int count, real mean_before, real mean_after, real begins_before)
{
    real lowest = begins_before + kLeastLayerWidth;
    real highest = real(1.0) - real(count - i) * kLeastLayerWidth;
    real split = real(0.5) * (mean_before + mean_after);
    return split >= lowest ? min(split, highest) : lowest;
}

// (4) The mean of what a layer holds; an empty one keeps its place.
GN_FN real lloydMean(real depths, real sum, real mean_before)
{
    return depths > real(0.0) ? clamp(sum / depths, real(0.0), real(1.0)) : mean_before;
}

// A split does its work while it lies well between the depths that it parts, however they change. So one that is held
// is off only when it lies elsewhere than where it would rest by more than this share of the way between the two means
// that it parts; halfway between them is where it came to rest.
GN_CONST real kHeldShare = real(0.125);
GN_FN bool isSplitOff(real held, real rest, real mean_before, real mean_after)
{
    return abs(rest - held) > kHeldShare * (mean_after - mean_before);
}

GN_END
#endif
