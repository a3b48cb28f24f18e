// SPDX-License-Identifier: Apache-2.0
// id: lit where the map has the receiver's own object. No depths, and so no bias.
// Based on: T. Forsyth, "Extremely Practical Shadows", GDC 2006 (ID buffers).
#ifndef GNOMON_ID_GLSL
#define GNOMON_ID_GLSL
#include "../shared/object_ids.h"
#include "filter_types.glsl"
GN_BEGIN

GN_FN IdRule idRuleOf(FilterInput f)
{
    IdRule rule;
    rule.test = f.kernel.x;
    rule.ids = abs(f.kernel.y);
    rule.order = f.kernel.y < real(0.0) ? real(1.0) : real(0.0);
    rule.bias = f.kernel.z;
    rule.steps = f.kernel.w;
    return rule;
}

// The ids of the texels that meet at a corner.
GN_FN real4 idsAround(real2 corner, FilterInput f, IdRule rule)
{
    real4 stored = mapGather(corner, f.layer, real(0.0));
    return floor(stored * rule.ids + real4(real(0.5)));
}

// 1 for those of no other object.
GN_FN real4 idsThatLight(real own, real4 ids)
{
    return real4(idLights(own, ids.x) ? real(1.0) : real(0.0), idLights(own, ids.y) ? real(1.0) : real(0.0),
                 idLights(own, ids.z) ? real(1.0) : real(0.0), idLights(own, ids.w) ? real(1.0) : real(0.0));
}

GN_FN real filterId(MapPoint point, FilterInput f)
{
    IdRule rule = idRuleOf(f);
    real2 shifted = point.texel - real2(real(0.5));
    real2 cell = floor(shifted);
    real4 ids = idsAround(cell + real2(real(1.0)), f, rule);
    return idVisibility(rule, f.id, f.lifted, ids, idsThatLight(f.id, ids), shifted - cell);
}

GN_END
#endif
