// SPDX-License-Identifier: Apache-2.0
// vsm: the share of the filtered depths that may lie beyond the receiver, from their mean and variance.
// Based on: W. Donnelly, A. Lauritzen, "Variance Shadow Maps", I3D 2006.
#ifndef GNOMON_VSM_GLSL
#define GNOMON_VSM_GLSL
#include "../shared/moments.h"
#include "moment_sampling.glsl"
GN_BEGIN

// `m`: sampleMoments() at the point; here and below.
GN_FN Occluders vsmOccluders(MapPoint point, FilterInput f, real4 m)
{
    real t = momentCoordinate(receiverDepth(point.depth, f.moments.flags, f.near_over_far), f.moments.flags);
    real least = leastVariance(f.moments, point.texel_depth, real(1.0));
    return chebyshevOccluders(m.x, m.y, t, least, momentScale(f.moments.flags));
}

GN_FN real filterVsm(MapPoint point, FilterInput f, real4 m)
{
    real d = receiverDepth(point.depth, f.moments.flags, f.near_over_far);
    real stretch = metricStretch(point.depth, f.moments.flags, f.near_over_far);
    real least = leastVariance(f.moments, point.texel_depth, stretch);
    return shapeVisibility(chebyshevBound(m.x, m.y, momentCoordinate(d, f.moments.flags), least), f.moments);
}

GN_END
#endif
