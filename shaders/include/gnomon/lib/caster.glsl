// SPDX-License-Identifier: Apache-2.0
// For caster shaders, ours and hosts': the value that a map's texel must hold. The vertex shader writes gl_Position =
// clip_from_world * p (casterPlaced() of that for a MapPass with a `placement`) and passes on casterMetric(). The
// fragment shader of a map with a colour format writes casterTexel() to it, with kDepthBytes for R8G8B8A8_UNORM and
// kDepthAlone for all others. For a depth-only map with MapPassFormats::write_frag_depth it writes casterStored() to
// gl_FragDepth, and for any other nothing, because the rasteriser's depth is the metric then. In a pass of several
// views (MapPass::view_count) the vertex shader also writes the view's number to gl_Layer.
// In a paraboloid's map (ClassicFormats::paraboloid) edges are straight from vertex to vertex, where they should be
// bent. Depths are exact: each texel's ray of light is intersected with the triangle's plane.
#ifndef GNOMON_CASTER_GLSL
#define GNOMON_CASTER_GLSL
#include "../shared/depth_metric.h"
#include "../shared/object_ids.h"
#include "../shared/paired_depth.h"
#include "../shared/paraboloid.h"
GN_BEGIN

// Affine in the point, so interpolation over a triangle is exact.
GN_FN real casterMetric(real3 p_ws, real4 metric_ws)
{
    return depthMetricPlane(p_ws, metric_ws);
}

// For a view that the GPU has fitted to a part of its base map: takes the base map's clip space to the view's own.
// `place` is the vec4 in MapPass::placement. Depth stays as it is.
GN_FN real4 casterPlaced(real4 clip, real4 place)
{
    return real4((clip.x - place.z * clip.w) * place.x, (clip.y - place.w * clip.w) * place.y, clip.z, clip.w);
}

// How far inside a clip plane a point is, both in one space; in metres where the plane's normal is a unit. Negative: the
// point is not there. Affine as well: write it to gl_ClipDistance, or pass it on and discard the fragment where it is
// negative. A caster that is cut has to be cut in the same way where the camera sees it.
GN_FN real casterInside(real3 p, real4 clip_plane)
{
    return dot(real3(clip_plane.x, clip_plane.y, clip_plane.z), p) + clip_plane.w;
}

// The second interpolated input of a paraboloid's fragment shader, besides clip.xyz. xy: the place in the disc; z: less
// than 0 farther behind the light than the map's border shows.
GN_FN real3 casterRim(real4 clip)
{
    real3 q = real3(clip.x, clip.y, clip.z);
    real rim = real(2.0) * clip.w - real(1.0); // twice the border
    real behind = (rim * rim - real(1.0)) / (rim * rim + real(1.0));
    return real3(paraboloidPlace(q), q.z / max(length(q), real(1e-30)) + behind);
}

// gl_Position for a paraboloid; `clip` is clip_from_world * p. Its z puts the near plane at the border's end, so the
// rasteriser cuts off everything farther behind.
GN_FN real4 casterParaboloid(real4 clip)
{
    real3 rim = casterRim(clip);
    return real4(rim.x / clip.w, rim.y / clip.w, real(0.5) * rim.z, real(1.0));
}

// The metric of a fragment of a paraboloid; less than 0: discard it. `rim`: casterRim() and `q`: clip.xyz, interpolated,
// `right` and `below` how q changes to the next fragments (dFdx, dFdy); `near`: DepthMetric::metric_ws.w. Where q is on
// the triangle's plane, the texel's own ray may meet the plane elsewhere, or only behind the light.
GN_FN real casterRadial(real3 rim, real3 q, real3 right, real3 below, real near)
{
    real3 normal = cross(right, below);
    real l = dot(normal, q) / dot(normal, paraboloidDirection(real2(rim.x, rim.y)));
    return rim.z >= real(0.0) && l > real(0.0) ? l + near : real(-1.0);
}

GN_FN real casterStored(real metric)
{
    return depthMetricStored(metric);
}

// The texel of a map with a colour format. All channels hold the depth, so that a target with two maps needs only the
// write mask of MapPass::colour_mask.
GN_FN real4 casterTexel(int holding, real metric)
{
    return pairedTexel(holding, casterStored(metric));
}

// The texel of a map of ids (ClassicFormats::ids): the object's id, and beside it a depth, where the format has room.
GN_FN real4 casterIdTexel(real id, real depth)
{
    return real4(id, casterStored(depth), real(0.0), real(0.0));
}

// The stored id of a piece of an object. `first`: the stored id of its first piece; `ids`: how many ids there are.
GN_FN real casterPieceId(real first, real piece, real ids)
{
    return idOfPiece(idOfTexel(first, ids), piece, ids) / ids;
}

// The midpoint of a caster's first two surfaces: A. Woo, "The Shadow Depth Map Revisited", Graphics Gems III, 1992.
// A stored depth is 1 where there is no surface. Departure: where there is no second one Woo's midpoint is far away; ours
// is the first one, so that what is thin or open casts.
GN_FN real casterMidpoint(real first, real second)
{
    return second < real(1.0) ? real(0.5) * (first + second) : first;
}

// Does a depth lie behind a stored one, which was rounded by at most `quantum`? One that does not belongs to the same
// surface.
GN_FN bool casterBehind(real stored, real first, real quantum)
{
    return stored > first + quantum;
}

GN_END
#endif
