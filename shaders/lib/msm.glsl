// SPDX-License-Identifier: Apache-2.0
// msm: the least shadow that four moments of depth allow.
// Based on: C. Peters, R. Klein, "Moment Shadow Mapping", I3D 2015; C. Peters, C. Muenstermann, N. Wetzstein, R. Klein,
// "Improved Moment Shadow Maps for Translucent Occluders, Soft Shadows and Single Scattering", JCGT 6(1), 2017.
#ifndef GNOMON_MSM_GLSL
#define GNOMON_MSM_GLSL
#include "../shared/moments.h"
#include "../shared/moments_four.h"
#include "moment_sampling.glsl"
GN_BEGIN

GN_FN real filterMsm(MapPoint point, FilterInput f)
{
    int flags = f.moments.flags;
    real t = momentCoordinate(receiverDepth(point.depth, flags, f.near_over_far), flags);
    return shapeVisibility(msmVisibility(sampleMoments(point, f, f.layer), t, f.moments), f.moments);
}

GN_END
#endif
