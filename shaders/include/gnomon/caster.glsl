// SPDX-License-Identifier: Apache-2.0
// For a host's own caster shaders: the value that a map's texel must hold. A vertex shader writes gl_Position =
// clip_from_world * p, or gnomonCasterPlaced() of that for a MapPass with a `placement`, and passes on
// gnomonCasterMetric(). The fragment shader writes by MapPass::formats:
//   colour is not UNDEFINED   gnomonCasterTexel() to attachment 0; `holding` is 2 for R8G8B8A8_UNORM, else 0
//   ids                       gnomonCasterIdTexel() to attachment 0 instead; with `pieces` by gnomonCasterPieceId()
//   write_frag_depth          gnomonCasterDepth() to gl_FragDepth; with several samples the metric's input is `sample`
//   else                      nothing: the rasteriser's depth is the metric
// For an object that clip planes cut, the vertex shader writes gnomonCasterInside() to gl_ClipDistance, one for each
// plane; or it passes them on, and the fragment shader discards where one is negative.
// With ClassicFormats::paraboloid it writes gnomonCasterParaboloid() to gl_Position, passes on clip.xyz and
// gnomonCasterRim(), and the fragment shader takes the metric from gnomonCasterRadial().
// In a pass of several views (MapPass::view_count) the vertex shader also writes the view's number to gl_Layer.
// Every name that this declares begins with gnomon or GNOMON.
#ifndef GNOMON_PUBLIC_CASTER_GLSL
#define GNOMON_PUBLIC_CASTER_GLSL
#include "names_begin.glsl"
#include "lib/caster.glsl"

// The depth metric of a point. `p_ws`: world space; `metric_ws`: MapPass::metric_ws. Affine in the point, so
// interpolation over a triangle is exact.
float gnomonCasterMetric(vec3 p_ws, vec4 metric_ws)
{
    return casterMetric(p_ws, metric_ws);
}

// gl_Position in a MapPass with a placement. `clip`: by MapPass::clip_from_world; `place`: the vec4 at
// MapPass::placement_offset of MapPass::placement.
vec4 gnomonCasterPlaced(vec4 clip, vec4 place)
{
    return casterPlaced(clip, place);
}

// How far inside a clip plane a point is, negative where it is cut away: dot(clip_plane.xyz, p) + clip_plane.w, both in
// one space. Affine in the point.
float gnomonCasterInside(vec3 p, vec4 clip_plane)
{
    return casterInside(p, clip_plane);
}

// gl_Position in a pass with ClassicFormats::paraboloid. `clip`: by MapPass::clip_from_world.
vec4 gnomonCasterParaboloid(vec4 clip)
{
    return casterParaboloid(clip);
}
// The rim of the same `clip`, to be interpolated for gnomonCasterRadial().
vec3 gnomonCasterRim(vec4 clip)
{
    return casterRim(clip);
}

// The metric of a fragment in such a pass; discard the fragment where it is less than 0. `rim` and `q`:
// gnomonCasterRim() and clip.xyz, interpolated; `right`, `below`: dFdx(q), dFdy(q), taken before anything is discarded;
// `metric_ws`: the pass's.
float gnomonCasterRadial(vec3 rim, vec3 q, vec3 right, vec3 below, vec4 metric_ws)
{
    return casterRadial(rim, q, right, below, metric_ws.w);
}

// The depth that is stored, 0 .. 1.
float gnomonCasterDepth(float metric)
{
    return casterStored(metric);
}

// The value for all channels of a colour attachment; MapPass::colour_mask says which are written.
vec4 gnomonCasterTexel(int holding, float metric)
{
    return casterTexel(holding, metric);
}

// The value for attachment 0 in a pass with ClassicFormats::ids. `id`: CasterId::id (gnomon/pack/caster_rows.h), the
// same all over an object; `depth`: dot(CasterId::depth_ws, (p, 1)), affine in the point.
vec4 gnomonCasterIdTexel(float id, float depth)
{
    return casterIdTexel(id, depth);
}

// The `id` of gnomonCasterIdTexel() in a pass with ClassicFormats::pieces. `first`: CasterId::id; `piece`: the piece of
// the vertex or the triangle, counted from 0 in its object, the same as in the mask's pixels; `ids`: CasterId::ids.
float gnomonCasterPieceId(float first, uint piece, float ids)
{
    return casterPieceId(first, float(piece & uint(kMostPieces - 1)), ids);
}

// In a pass with ClassicFormats::behind_first: discard the fragment where this is false. `stored`: gnomonCasterDepth()
// of the metric, or of gl_FragCoord.z where nothing is written to gl_FragDepth; `first`: ClassicPass::first_surface at
// gl_FragCoord.xy; `quantum`: MapPass::first_quantum.
bool gnomonCasterBehind(float stored, float first, float quantum)
{
    return casterBehind(stored, first, quantum);
}

#include "names_end.glsl"
#endif
