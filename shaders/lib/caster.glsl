// SPDX-License-Identifier: Apache-2.0
// For caster shaders, ours and hosts': what a map's texel is to hold. In the vertex shader, write gl_Position =
// clip_from_world * p and pass on casterMetric(); in the fragment shader of a map with a colour format write
// casterStored() to it; of a depth-only map that says MapPassFormats::write_frag_depth, to gl_FragDepth; else nothing,
// because the rasteriser's depth is the metric then.
#ifndef GNOMON_CASTER_GLSL
#define GNOMON_CASTER_GLSL
#include "../shared/depth_metric.h"
GN_BEGIN

// Affine in the point, so interpolation over a triangle is exact.
GN_FN real casterMetric(real3 p_ws, real4 metric_ws)
{
    return depthMetricPlane(p_ws, metric_ws);
}

GN_FN real casterStored(real metric)
{
    return depthMetricStored(metric);
}

GN_END
#endif
