// SPDX-License-Identifier: Apache-2.0
// The depth metric: what a shadow map stores, whatever the rasteriser's own z is.
// Based on: A. Marinescu, "Achieving real-time soft shadows using layered variance shadow maps (LVSM) in a real-time
// strategy (RTS) game", 2011, eq. 1 and 5; W. Donnelly, A. Lauritzen, "Variance Shadow Maps", 2006.
#ifndef GNOMON_DEPTH_METRIC_H
#define GNOMON_DEPTH_METRIC_H
#include "portability.h"
GN_BEGIN

// (1) d' = (d - near) / (far - near), d in metres along the light's axis. Unclamped; strictly increasing in d.
GN_FN real depthMetricLinear(real d_m, real near_m, real far_m)
{
    return (d_m - near_m) / (far_m - near_m);
}

// The same for a point, with (1) folded into a plane: dot(metric, (p, 1)). The distance to the light's plane is affine
// in p, so this may be evaluated per vertex and interpolated exactly (Marinescu 2011, section 4).
GN_FN real depthMetricPlane(real3 p, real4 metric)
{
    return dot(real3(metric.x, metric.y, metric.z), p) + metric.w;
}

// The depth that a map holds: casters nearer than the near plane are clamped onto it ("pancaked"), so they still cast.
GN_FN real depthMetricStored(real d)
{
    return clamp(d, real(0.0), real(1.0));
}

GN_END
#endif
