// SPDX-License-Identifier: Apache-2.0
#ifndef GNOMON_ESM_GLSL
#define GNOMON_ESM_GLSL
#include "filter_types.glsl"
GN_BEGIN

GN_FN real filterEsm(MapPoint point, FilterInput f)
{
    return real(1.0) + real(0.0) * (point.depth + f.layer);
}

GN_END
#endif
