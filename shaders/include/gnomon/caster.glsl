// SPDX-License-Identifier: Apache-2.0
// For a host's own caster shaders: what a map's texel is to hold. A vertex shader writes gl_Position = clip_from_world *
// p, of a MapPass with a `placement` gnomonCasterPlaced() of that, and passes on gnomonCasterMetric(). What the fragment
// shader writes follows from MapPass::formats:
//   colour is not UNDEFINED   gnomonCasterTexel() to attachment 0; `holding` is 2 for R8G8B8A8_UNORM, else 0
//   ids                       gnomonCasterIdTexel() to attachment 0 instead; with `pieces` of gnomonCasterPieceId()
//   write_frag_depth          gnomonCasterDepth() to gl_FragDepth; with several samples the metric's input is `sample`
//   else                      nothing: the rasteriser's depth is the metric
// Of an object that clip planes cut the vertex shader writes gnomonCasterInside() to gl_ClipDistance, one for each plane;
// or passes them on, and the fragment shader discards where one is negative.
// Of ClassicFormats::paraboloid it writes gnomonCasterParaboloid() to gl_Position, passes on clip.xyz and
// gnomonCasterRim(), and the fragment shader takes the metric from gnomonCasterRadial().
// In a pass of several views (MapPass::view_count) the vertex shader also writes the view's number to gl_Layer.
// Every name that this declares begins with gnomon or GNOMON.
#ifndef GNOMON_PUBLIC_CASTER_GLSL
#define GNOMON_PUBLIC_CASTER_GLSL
#include "names_begin.glsl"
#include "lib/caster.glsl"

// `p_ws` world space; `metric_ws` MapPass::metric_ws. Affine in the point, so interpolation over a triangle is exact.
float gnomonCasterMetric(vec3 p_ws, vec4 metric_ws)
{
    return casterMetric(p_ws, metric_ws);
}

// `clip` by MapPass::clip_from_world; `place` is the vec4 at MapPass::placement_offset of MapPass::placement.
vec4 gnomonCasterPlaced(vec4 clip, vec4 place)
{
    return casterPlaced(clip, place);
}

// How far inside a clip plane a point is, negative where it is cut away: dot(clip_plane.xyz, p) + clip_plane.w, both in
// one space. Affine in the point as well.
float gnomonCasterInside(vec3 p, vec4 clip_plane)
{
    return casterInside(p, clip_plane);
}

// `clip` by MapPass::clip_from_world, of a pass with ClassicFormats::paraboloid: gl_Position, and what is to be
// interpolated for gnomonCasterRadial().
vec4 gnomonCasterParaboloid(vec4 clip)
{
    return casterParaboloid(clip);
}
// Of the same `clip`, to be interpolated for gnomonCasterRadial().
vec3 gnomonCasterRim(vec4 clip)
{
    return casterRim(clip);
}

// The metric there; discard the fragment where it is less than 0. `rim` and `q`: gnomonCasterRim() and clip.xyz,
// interpolated; `right`, `below`: dFdx(q), dFdy(q), taken before anything is discarded; `metric_ws`: the pass's.
float gnomonCasterRadial(vec3 rim, vec3 q, vec3 right, vec3 below, vec4 metric_ws)
{
    return casterRadial(rim, q, right, below, metric_ws.w);
}

// The depth that is stored, 0 .. 1.
float gnomonCasterDepth(float metric)
{
    return casterStored(metric);
}

// For all channels of a colour attachment; MapPass::colour_mask says which are written.
vec4 gnomonCasterTexel(int holding, float metric)
{
    return casterTexel(holding, metric);
}

// Of a pass with ClassicFormats::ids, to attachment 0 instead. `id`: CasterId::id (gnomon/pack/caster_rows.h), the same
// all over an object; `depth`: dot(CasterId::depth_ws, (p, 1)), affine in the point as the metric is.
vec4 gnomonCasterIdTexel(float id, float depth)
{
    return casterIdTexel(id, depth);
}

// Of a pass with ClassicFormats::pieces: what goes there as `id`. `first`: CasterId::id; `piece`: of the vertex or the
// triangle, counted from 0 in its object, as the mask's pixels have it; `ids`: CasterId::ids.
float gnomonCasterPieceId(float first, uint piece, float ids)
{
    return casterPieceId(first, float(piece & uint(kMostPieces - 1)), ids);
}

// Of a pass with ClassicFormats::behind_first: discard the fragment where this is false. `stored`: gnomonCasterDepth()
// of the metric, or of gl_FragCoord.z where nothing is written to gl_FragDepth; `first`: ClassicPass::first_surface at
// gl_FragCoord.xy; `quantum`: MapPass::first_quantum.
bool gnomonCasterBehind(float stored, float first, float quantum)
{
    return casterBehind(stored, first, quantum);
}

#include "names_end.glsl"
#endif
