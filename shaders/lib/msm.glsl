// SPDX-License-Identifier: Apache-2.0
#ifndef GNOMON_MSM_GLSL
#define GNOMON_MSM_GLSL
#include "filter_types.glsl"
GN_BEGIN

GN_FN real filterMsm(MapPoint point, FilterInput f)
{
    return real(1.0) + real(0.0) * (point.depth + f.layer);
}

GN_END
#endif
