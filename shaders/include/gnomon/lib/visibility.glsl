// SPDX-License-Identifier: Apache-2.0
// The visibility of a point in one view. The includer defines the functions of filter_types.glsl before:
// map_texture.glsl has them for one array texture.
#ifndef GNOMON_VISIBILITY_GLSL
#define GNOMON_VISIBILITY_GLSL
#include "../shared/gpu_structs.h"
#include "../shared/smooth_surface.h"
#include "../shared/choice_numbers.h"
#include "filters.glsl"
#include "receiver_footprint.glsl"
#include "facing.glsl"
#include "../shared/paraboloid.h"
// Whether views may be paraboloids, a constant. The includer may know.
#ifndef GNOMON_PARABOLOID
#if GNOMON_COMPILES_KERNELS
#define GNOMON_PARABOLOID !GNOMON_ORTHOGRAPHIC_ONLY
#else
#define GNOMON_PARABOLOID false
#endif
#endif
// Whether it is known already that a view's slice and sector hold a point, a constant.
#ifndef GNOMON_KNOWN_VIEW
#define GNOMON_KNOWN_VIEW false
#endif
GN_BEGIN

GN_FN MapRows rowsOf(GpuView view)
{
    MapRows rows;
    rows.x = real4(view.x);
    rows.y = real4(view.y);
    rows.w = real4(view.w);
    rows.metric = real4(view.metric);
    rows.texel_m = real(view.scale.x);
    rows.range_m = real(view.scale.y);
    rows.plane_x = real4(view.plane_x);
    rows.plane_y = real4(view.plane_y);
    rows.plane_w = real4(view.plane_w);
    return rows;
}

// By which a receiver at `p` is on the view's map. A paraboloid's rows are of that point alone.
GN_FN MapRows rowsAt(GpuView view, real3 p)
{
    MapRows rows = rowsOf(view);
    if (GNOMON_PARABOLOID && view.plane_y.w > 0.0) {
        rows = paraboloidRows(rows, real4(view.plane_x), p);
    }
    return rows;
}

// GpuRule's bias and bias_more; `off_plane_m`: offPlane() of the receiver by what they say.
GN_FN BiasRule biasOf(GN_VEC4 bias, GN_VEC4 more, real off_plane_m)
{
    BiasRule rule;
    rule.automatic = real(bias.x);
    rule.constant_m = real(bias.y);
    rule.slope = real(bias.z);
    rule.normal_texels = real(bias.w);
    rule.snap_texels = real(bias.y);
    rule.off_plane_m = off_plane_m;
    rule.normal_error = real(bias.w);
    rule.receiver_plane = real(more.x);
    rule.reach_texels = real(more.y);
    rule.quantum = real(more.z);
    rule.exact_plane = real(more.w);
    return rule;
}

// FilterInput::spread, `size` being GpuLight::size.x. A lamp is a sphere: the cone that touches it has the sine
// radius / distance. At most 0.9 of distance^2 is taken as radius^2, inside of the sphere too.
GN_FN real lightSpread(GN_VEC4 place, real3 toward, real size)
{
    if (real(place.w) == real(0.0)) {
        return size;
    }
    real far2 = dot(toward, toward);
    real r2 = min(size * size, far2 * real(0.9));
    return size * sqrt(far2 / max(far2 - r2, real(1e-30)));
}

// GpuRule's moment_warp, moment_variance and moment_shape, with what pipelines may have as constants: the flags of
// moment_rule.h, a gnomon::MapSampling and lvsm's number of layers.
GN_FN MomentRule momentsOf(int flags, int sampling, int layers, GN_VEC4 warp, GN_VEC4 variance, GN_VEC4 shape)
{
    MomentRule rule;
    rule.flags = flags;
    rule.sampling = sampling;
    rule.layers = layers;
    rule.exponent = real(warp.x);
    rule.exponent_negative = real(warp.y);
    rule.moment_bias = real(warp.z);
    rule.anisotropy = real(warp.w);
    rule.min_variance = real(variance.x);
    rule.min_variance_texels = real(variance.y);
    rule.rounding = real(variance.z);
    rule.rounding_negative = real(variance.w);
    rule.linstep = real(shape.x);
    rule.power = real(shape.y);
    rule.lighten = real(shape.z);
    rule.lighten_cut = real(shape.w);
    return rule;
}

// Does this view's slice hold this point?
GN_FN bool inSlice(GpuView view, real3 p)
{
    real depth = dotRow(real4(view.slice_axis), p);
    real w = dotRow(real4(view.sector_w), p);
    return !(depth < real(view.slice.x) * w || depth > real(view.slice.y) * w);
}

// Does this view, of several side by side, serve this point?
GN_FN bool inSector(GpuView view, real3 p)
{
    real w = dotRow(real4(view.sector_w), p);
    return abs(dotRow(real4(view.sector_x), p)) <= w && abs(dotRow(real4(view.sector_y), p)) <= w;
}

// Does this view serve a point, and is the point in the map, so far from its tile's edge that no tap leaves the tile?
GN_FN bool viewContains(GpuView view, real3 p)
{
    bool is_served = GNOMON_KNOWN_VIEW || inSlice(view, p);
    bool is_own = GNOMON_KNOWN_VIEW || inSector(view, p);
    is_served = is_served && is_own;
    if (GNOMON_PARABOLOID && view.plane_y.w > 0.0) {
        return is_served; // its half space is the disc, around which there is room for taps
    }
    real w = mix(dotRow(real4(view.w), p), real(1.0), GNOMON_ORTHOGRAPHIC_ONLY);
    real x = dotRow(real4(view.x), p);
    real y = dotRow(real4(view.y), p);
    real4 tile = real4(view.tile) * w;
    // One after the other, so that no branch is made of it.
    bool is_within = w > real(0.0);
    bool is_right = x >= tile.x;
    bool is_below = y >= tile.y;
    bool is_left = x <= tile.z;
    bool is_above = y <= tile.w;
    is_within = is_within && is_right;
    is_within = is_within && is_below;
    is_within = is_within && is_left;
    is_within = is_within && is_above;
    is_within = is_within && is_served;
    return is_within;
}

// At which depth of those that its slice counts in.
GN_FN real sliceDepth(GpuView view, real3 p)
{
    return dotRow(real4(view.slice_axis), p) / dotRow(real4(view.sector_w), p);
}

// The weight of a view's visibility where a view before it serves the point too: that view fades over into this one.
// `depth`: sliceDepth().
GN_FN real viewShare(GpuView view, real depth)
{
    return clamp((depth - real(view.slice.x)) * real(view.slice.z), real(0.0), real(1.0)) * real(view.slice.w);
}

// Is it one of several views that overlap: ViewServes::layered?
GN_FN bool isLayered(GpuView view)
{
    return view.plane_x.w > 0.0 && !(GNOMON_PARABOLOID && view.plane_y.w > 0.0);
}

// ViewServes::opacityAt(), but never nothing, so that a view that is alone counts for all.
GN_FN real viewOpacity(GpuView view, real3 p)
{
    real across = max(abs(dotRow(real4(view.sector_x), p)), abs(dotRow(real4(view.sector_y), p)));
    real inside = real(1.0) - across / dotRow(real4(view.sector_w), p);
    return max(clamp(inside * real(view.plane_x.w), real(0.0), real(1.0)) * real(view.slice.w), real(1e-4));
}

// Never outside [0, 1]; what is not a number is lit.
GN_FN real boundedVisibility(real v)
{
    return v >= real(0.0) ? min(v, real(1.0)) : (v < real(0.0) ? real(0.0) : real(1.0));
}

// Where light all but grazes a surface, filters hardly follow its plane, and let pass what is before it by less than the
// plane rises over a texel: its neighbours on a body, by turns from texel to texel. So the map is asked once more, at the
// point itself, between the four texels around it, where a surface's own texels and its neighbours' both are what they
// are. None of the four is before the plane of a convex body. Casters farther before it make edges as ever.
// `rows`, `texel_depth`: of the receiver (MapPoint); `p`, `sine`: of grazedPoint().
GN_FN real grazedVisibility(GpuView view, MapRows rows, real texel_depth, BiasRule rule, FilterInput f, real3 p,
                            real sine)
{
    real2 low = real2(real(view.whole.x), real(view.whole.y)) + real2(real(0.5));
    real2 high = real2(real(view.whole.z), real(view.whole.w)) - real2(real(1.5));
    real2 shifted = clamp(texelAt(rows, p, mapW(rows, p)) - real2(real(0.5)), low, high);
    real2 part = shifted - floor(shifted);
    FilterInput input_here = f;
    input_here.near_over_far = real(view.more.z);
    real4 four = storedMetric(
        input_here, mapGather(floor(shifted) + real2(real(1.0)), real(view.scale.z), real(view.scale.w)));
    real4 shares = real4(real(1.0) - part.x, part.x, part.x, real(1.0) - part.x) *
                   real4(part.y, part.y, real(1.0) - part.y, real(1.0) - part.y);
    real m = dotRow(rows.metric, p);
    real rise = texel_depth / sine;
    real bias = rule.quantum + kSteepest * texel_depth + rule.snap_texels * rise +
                rule.off_plane_m / (rows.range_m * sine);
    real far = dot(shares, step(real4(m - rise - bias), four));
    real between = dot(shares, min(four, real4(m + rise)));
    return far < real(0.999) ? far : step(min(m, real(1.0)) - bias, between);
}

// The visibility of a receiver inside the view; with GNOMON_SETTLES below 0 where blocks do not settle it. `rows`: rowsAt() its place; `point`: its projectReceiver(); `p`:
// eye-relative; `n`: its unit geometric normal. Fills in f.layer, the view's members and the footprint, which is made
// from `steps` (pixelSteps()) where f.moments.sampling needs it.
GN_FN real viewVisibility(int filter_number, GpuView view, MapRows rows, MapPoint point, FilterInput f,
                          PixelSteps steps, real3 p, real3 n)
{
    FilterInput input_here = f;
    input_here.layer = real(view.scale.z);
    input_here.part = real(view.scale.w);
    input_here.slot = int(view.more.x);
    input_here.tile = real4(view.whole);
    input_here.coarsest = real(view.more.y);
    input_here.near_over_far = real(view.more.z);
    input_here.footprint_x = real2(real(0.0));
    input_here.footprint_y = real2(real(0.0));
    input_here.rows = rows;
    input_here.n = n;
    // It and what comes after it choose a mip level by the receiver's footprint.
    if (f.moments.sampling >= kSamplingTrilinear) {
        input_here.footprint_x = footprintOf(rows, point.texel, point.w, p, n, steps.right, steps.along);
        input_here.footprint_y = footprintOf(rows, point.texel, point.w, p, n, steps.below, steps.along);
    }
    real seen = applyFilter(filter_number, point, input_here);
    if (GNOMON_SETTLES && seen < real(0.0)) {
        return seen;
    }
    return lightenedVisibility(boundedVisibility(seen), f.moments.lighten, f.moments.lighten_cut);
}

// The same without a screen: filterable maps are read at their finest level.
GN_FN real viewVisibility(int filter_number, GpuView view, BiasRule rule, FilterInput f, real3 p, real3 n)
{
    PixelSteps steps;
    steps.right = real4(real(0.0));
    steps.below = real4(real(0.0));
    steps.along = real4(real(0.0));
    MapRows rows = rowsAt(view, p);
    return viewVisibility(filter_number, view, rows, projectReceiver(rows, rule, p, n), f, steps, p, n);
}

GN_END
#endif
