// SPDX-License-Identifier: Apache-2.0
// esm: how far the receiver lies behind the average of an exponential of depth.
// Based on: T. Annen, T. Mertens, H.-P. Seidel, E. Flerackers, J. Kautz, "Exponential Shadow Maps", Graphics Interface
// 2008; M. Salvi, "Rendering Filtered Shadows with Exponential Shadow Maps", ShaderX6, 2008.
#ifndef GNOMON_ESM_GLSL
#define GNOMON_ESM_GLSL
#include "../shared/exponential.h"
#include "moment_sampling.glsl"
GN_BEGIN

GN_FN real filterEsm(MapPoint point, FilterInput f)
{
    int flags = f.moments.flags;
    real t = momentCoordinate(receiverDepth(point.depth, flags, f.near_over_far), flags);
    real4 stored = sampleMoments(point, f, f.layer);
    return shapeVisibility(esmVisibility(esmExcess(stored.x, t, f.moments)), f.moments);
}

GN_END
#endif
