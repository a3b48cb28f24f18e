// SPDX-License-Identifier: Apache-2.0
// evsm: Chebyshev's bound, as of vsm, in an exponential warp of depth, which keeps it from bleeding where occluders
// overlap; with four channels in a second warp too, which bounds what is before the mean.
// Based on: A. Lauritzen, M. McCool, "Layered Variance Shadow Maps", Graphics Interface 2008, section 5.
#ifndef GNOMON_EVSM_GLSL
#define GNOMON_EVSM_GLSL
#include "../shared/exponential.h"
#include "moment_sampling.glsl"
GN_BEGIN

// Texels' slopes ask for a least variance that grows with the square of the exponent. So much of the warp at the receiver
// is the most that a texel's depth counts for: beyond, an allowance of half of it would light deep shadow by more than
// 1 %, and by everything at last; and slopes need it no more, for the kernel's own variance of them has grown as fast.
GN_CONST real kMostWarpOfTexel = real(0.2);

GN_FN real filterEvsm(MapPoint point, FilterInput f)
{
    int flags = f.moments.flags;
    real t = momentCoordinate(receiverDepth(point.depth, flags, f.near_over_far), flags);
    real4 stored = sampleMoments(point, f, f.layer);
    real c = max(evsmExponents(f.moments).x * momentScale(flags), real(1e-6));
    real texel_depth = min(point.texel_depth * metricStretch(point.depth, flags, f.near_over_far), kMostWarpOfTexel / c);
    real least = leastVariance(f.moments, texel_depth, real(1.0));
    return shapeVisibility(evsmVisibility(stored, t, least, f.moments), f.moments);
}

GN_END
#endif
