// SPDX-License-Identifier: Apache-2.0
// evsm: Chebyshev's bound, as of vsm, in an exponential warp of depth, which keeps it from bleeding where occluders
// overlap; with four channels in a second warp too, which bounds what is before the mean.
// Based on: A. Lauritzen, M. McCool, "Layered Variance Shadow Maps", Graphics Interface 2008, section 5.
#ifndef GNOMON_EVSM_GLSL
#define GNOMON_EVSM_GLSL
#include "../shared/exponential.h"
#include "moment_sampling.glsl"
GN_BEGIN

GN_FN real filterEvsm(MapPoint point, FilterInput f)
{
    int flags = f.moments.flags;
    real t = momentCoordinate(receiverDepth(point.depth, flags, f.near_over_far), flags);
    real4 stored = sampleMoments(point, f, f.layer);
    real least = leastVariance(f.moments, point.texel_depth, metricStretch(point.depth, flags, f.near_over_far));
    return shapeVisibility(evsmVisibility(stored, t, least, f.moments), f.moments);
}

GN_END
#endif
