// SPDX-License-Identifier: Apache-2.0
// depth-id: where another object is there is shadow; within an object its own depths are compared, which few bits hold.
// With the map's depth beside the id other objects are compared by it as well, but without a bias.
// Based on: T. Forsyth, "Extremely Practical Shadows", GDC 2006 (depth and ID buffers; bias by the object's radius);
// K. Pelzer, "Combined Depth and ID-Based Shadow Buffers", Game Programming Gems 4, 2004.
// Departure: without IdRule::bias an object is compared along its receiver's plane, as other filters have it.
#ifndef GNOMON_DEPTH_ID_GLSL
#define GNOMON_DEPTH_ID_GLSL
#include "id.glsl"
GN_BEGIN

GN_FN real referenceDepthAt(MapPoint point, real2 offset)
{
    real2 reference = referenceAt(point, offset);
    return reference.x / reference.y;
}

// The depths that the four texels of a gather are compared with, as they are stored. `part`: of the receiver, from the
// top left one's centre.
GN_FN real4 ownDepthsAround(MapPoint point, FilterInput f, IdRule rule, real2 part)
{
    real3 along = gradientOf(f.rows.metric);
    bool is_global = rule.steps < real(0.0);
    real m = dotRow(f.rows.metric, f.place);
    real extent = objectExtent(along, f.object_half);
    real per_metric = is_global ? real(1.0) : real(1.0) / max(real(2.0) * extent, real(1e-30));
    real own = is_global ? m : objectDepth(along, f.place - f.object_centre, extent);
    real4 reference = real4(own - rule.bias * length(f.object_half) * length(along) * per_metric);
    if (rule.bias < real(0.0)) {
        real4 planes = real4(referenceDepthAt(point, real2(real(0.0), real(1.0)) - part),
                             referenceDepthAt(point, real2(real(1.0)) - part),
                             referenceDepthAt(point, real2(real(1.0), real(0.0)) - part),
                             referenceDepthAt(point, real2(real(0.0)) - part));
        reference = real4(own) + (planes - real4(m)) * per_metric;
    }
    return min(reference - real4(real(1.0) / abs(rule.steps)), real4(real(1.0)));
}

GN_FN real filterDepthId(MapPoint point, FilterInput f)
{
    IdRule rule = idRuleOf(f);
    real2 shifted = point.texel - real2(real(0.5));
    real2 cell = floor(shifted);
    real2 part = shifted - cell;
    real2 corner = cell + real2(real(1.0));
    real4 ids = idsAround(corner, f, rule);
    real4 depths = mapGather(corner, f.layer, real(1.0));
    // Where nothing casts 0 is stored beside id 0, which no depth is asked of.
    real4 behind = step(ownDepthsAround(point, f, rule, part), depths);
    real4 lit = real4(ids.x == real(0.0) ? real(1.0) : behind.x, ids.y == real(0.0) ? real(1.0) : behind.y,
                      ids.z == real(0.0) ? real(1.0) : behind.z, ids.w == real(0.0) ? real(1.0) : behind.w);
    real4 others = real4(real(0.0));
    if (rule.steps < real(0.0)) { // which need no bias
        others = step(real4(min(dotRow(f.rows.metric, f.place) + real(1.0) / rule.steps, real(1.0))), depths);
    }
    return idVisibility(rule, f.id, f.lifted, ids, mix(others, lit, idsThatLight(f.id, ids)), part);
}

GN_END
#endif
