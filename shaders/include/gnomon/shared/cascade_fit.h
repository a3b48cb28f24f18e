// SPDX-License-Identifier: Apache-2.0
// Where the camera's depth is cut into cascades, and which rectangle of a light's one map each of them gets.
// Based on: F. Zhang, H. Sun, L. Xu, L. K. Lun, "Parallel-split shadow maps for large-scale virtual environments",
// 2006, eq. 3 to 5; A. Lauritzen, M. Salvi, A. Lefohn, "Sample Distribution Shadow Maps", 2011.
#ifndef GNOMON_CASCADE_FIT_H
#define GNOMON_CASCADE_FIT_H
#include "portability.h"
GN_BEGIN

// Where the i-th of `count` slices begins, metres from the eye: near_m for 0, far_m for `count`. 0 < near_m <= far_m.
GN_FN real practicalSplit(real near_m, real far_m, real lambda, int i, int count)
{
    real share = real(i) / real(count);
    real logarithmic = near_m * pow(far_m / near_m, share);    // eq. 3
    real even = near_m + (far_m - near_m) * share;             // eq. 4
    return lambda * logarithmic + (real(1.0) - lambda) * even; // eq. 5
}

// A logarithm has to start somewhere: no split is nearer than this share of the far end.
GN_CONST real kNearestSplit = real(1e-4);

// The least length of the divided range, as a share of its near end.
GN_CONST real kLeastRange = real(1e-6);

// The range to divide: depths along the camera's view, metres.
struct SplitRange {
    real near_m;
    real far_m;
    real lambda;
};

// An orthographic camera's depths may be negative, and it sees near and far alike: its slices are even.
GN_FN SplitRange splitRange(real near_m, real far_m, real lambda, bool perspective)
{
    SplitRange range;
    range.far_m = max(far_m, near_m + max(kLeastRange * abs(near_m), real(1e-30)));
    range.near_m = near_m;
    range.lambda = real(0.0);
    if (perspective) {
        range.near_m = max(near_m, kNearestSplit * range.far_m);
        range.lambda = lambda;
    }
    return range;
}

GN_FN real splitAt(SplitRange range, int i, int count)
{
    return range.lambda > real(0.0) ? practicalSplit(range.near_m, range.far_m, range.lambda, i, count)
                                    : range.near_m + (range.far_m - range.near_m) * (real(i) / real(count));
}

// How long before its own begin a slice fades in: a share of the slice before it.
GN_FN real blendWidth(real blend, real before_m, real begin_m)
{
    return max(blend * (begin_m - before_m), real(0.0));
}

// Depths are rounded, in each pass its own way. A point so near to a slice's end counts for both sides of it.
GN_CONST real kDepthRounding = real(1e-5);

GN_FN bool sliceCounts(real depth_m, real begin_m, real end_m)
{
    real pad = kDepthRounding * abs(depth_m);
    return depth_m >= begin_m - pad && depth_m <= end_m + pad;
}

// A cascade covers at least this share of the base map's side along each axis. Its places are single precision numbers
// of the base map, up to 2^-24 apart, which is 1/64 of a texel then where a map has 1024 of them on a side.
GN_CONST real kFinestShare = real(1.0 / 512.0);

// On all sides of what a map shows it has room for rays to the rest of the light, but no more than this share of the
// longer side: its texels grow by half at most.
GN_CONST real kMostRoom = real(0.25);

// Rectangles are low x, y, high x, y. Limits the room of `wanted`, which is `seen` with room on all sides, to what a
// map can spare. `reach` is the length of one and the same ray along both axes; 0: there are no rays.
GN_FN real4 spareRoom(real4 seen, real4 wanted, real2 reach)
{
    if (min(reach.x, reach.y) <= real(0.0)) {
        return seen;
    }
    real rays = max((seen.z - seen.x) / reach.x, (seen.w - seen.y) / reach.y);
    real2 most = reach * (kMostRoom * rays);
    return real4(max(wanted.x, seen.x - most.x), max(wanted.y, seen.y - most.y), min(wanted.z, seen.z + most.x),
                 min(wanted.w, seen.w + most.y));
}

// Maps `low` to `high` on an axis of the base map, in [-1, 1], to all of the cascade's map inside the filter's border.
// `widen` is texels / (texels - 2 border). x: scale, 1 to 1/kFinestShare; y: centre. A place then becomes (place - y)
// x. An empty range (low > high) gets the whole base map, and so does one that would be coarser than that.
GN_FN real2 axisPlace(real low, real high, real widen)
{
    real half_size = max((high - low) * real(0.5) * widen, kFinestShare);
    if (low > high || half_size >= real(1.0)) {
        return real2(real(1.0), real(0.0));
    }
    return real2(real(1.0) / half_size, (low + high) * real(0.5));
}

GN_END
#endif
