// SPDX-License-Identifier: Apache-2.0
// hard: one texel, in or out.
// Based on: L. Williams, "Casting curved shadows on curved surfaces", SIGGRAPH 1978; A. Marinescu, "Achieving real-time
// soft shadows using LVSM in an RTS game", 2011, fig. 3.
#ifndef GNOMON_HARD_GLSL
#define GNOMON_HARD_GLSL
#include "filter_types.glsl"
GN_BEGIN

GN_FN real filterHard(MapPoint point, FilterInput f)
{
    real2 texel = floor(point.texel);
    real stored = storedMetric(f, real4(mapTexel(texel, f.layer, f.part))).x;
    return compareTexel(point, texel + real2(real(0.5)) - point.texel, stored);
}

GN_END
#endif
