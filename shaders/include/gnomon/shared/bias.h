// SPDX-License-Identifier: Apache-2.0
// Where a receiver is on a map, and what depth each tap is compared with, so that a surface does not shadow itself.
// Based on: T. Forsyth, "Extremely Practical Shadows", GDC 2006 (depth aliasing); J. Isidoro, "Shadow Mapping:
// GPU-based Tips and Techniques", GDC 2006 (receiver plane depth bias). We take the plane from the geometric normal,
// not from screen-space derivatives, which are wrong at silhouettes; and we take it exactly in perspective maps too.
#ifndef GNOMON_BIAS_H
#define GNOMON_BIAS_H
#include "portability.h"
// Whether all maps are orthographic, a constant: then w is 1 everywhere. The includer may know. Both cases are worked
// out and one is taken by mix(), without a branch, so compilers that fold the constant drop the other one
// [drivers: unfolded].
#ifndef GNOMON_ORTHOGRAPHIC_ONLY
#define GNOMON_ORTHOGRAPHIC_ONLY false
#endif
GN_BEGIN

// Rows that take a point (p, 1) to the map: atlas texels (x / w, y / w) and the depth metric. w is (0, 0, 0, 1) for an
// orthographic map, the distance along the axis in metres for a perspective one, and times the warp's w for a warped
// one.
struct MapRows {
    real4 x;
    real4 y;
    real4 w;
    real4 metric;
    real texel_m; // a texel's longest side in metres; of use for an orthographic map only
    real range_m; // metres from metric 0 to metric 1
    // With GNOMON_ORTHOGRAPHIC_ONLY: receiverPlane() where w is constant. xyz are the cross products of the rows'
    // gradients: metric with y, x with metric, x with y. plane_w.w is the least determinant that it divides by.
    real4 plane_x;
    real4 plane_y;
    real4 plane_w;
};

struct BiasRule {
    real automatic;      // 1: derive everything; the next four are ignored
    real constant_m;     // towards the light
    real slope;          // times the depth that a texel spans on the receiver
    real normal_texels;  // moves the receiver along its normal
    real receiver_plane; // 1: taps compare with the receiver's plane
    real reach_texels;   // how far from the receiver, per axis, a tap's texel centre can be
    real quantum;        // error of a stored depth, as a metric difference
    real exact_plane;    // 1: texels are compared with the plane at their own centres, wherever they are
    // By hand the next three are ignored.
    real snap_texels;  // a stored depth is that of a point up to so far away, along each axis of the map
    real off_plane_m;  // how far the receiver may be off the plane that the map holds
    real normal_error; // error of the receiver's normal, radians
};

// A receiver on a map. At d texels from it, its reference depth is
// (depth + dot(depth_slope, d)) / (1 + dot(w_slope, d)): the exact depth of the receiver's plane, less the bias. But it
// is never more than `cap`, the depth at the receiver itself: where the plane leads away from the light, it leads under
// whatever surface meets the receiver in a concave edge (a wall's plane under the ground), which would wrongly count as
// a caster.
struct MapPoint {
    real2 texel; // atlas coordinates; texel centres are at halves
    real depth;
    real2 depth_slope;
    real2 w_slope;
    real cap;
    real w;           // > 0 in front of a perspective light; 1 for an orthographic one
    real texel_depth; // a texel's width here, as a metric difference
    real plane_doubt; // error of the plane's depth a texel away, from the normal's error
};

// A plane is followed up to this tangent of the angle between its normal and the light. Beyond it (87 degrees) the
// Lambert term is below 5 %, and neighbours would be compared at depths that have nothing to do with the receiver.
GN_CONST real kSteepest = real(20.0);
// How far a receiver's curvature and creases may leave its plane, in texels of depth: a constant, and a part per texel
// of reach.
GN_CONST real kRoughness = real(0.2);
GN_CONST real kRoughnessPerTexel = real(0.1);
// A device draws on a grid of 2^bits steps to a pixel (VkPhysicalDeviceLimits::subPixelPrecisionBits). It moves each
// vertex to that grid, so a triangle's depth at a pixel is that of a point of its plane this many steps away along each
// axis: half a step where the device rounds, one where it cuts off, and one for the arithmetic of its own depth.
GN_CONST real kSnapSteps = real(2.0);
// Error of a normal before it is stored, radians: of the arithmetic that leads to it.
GN_CONST real kNormalArithmetic = real(0.0001);
// A slope is bounded for the bias, as a tangent.
GN_CONST real kSteepestBias = real(1000.0);

// How far away along each axis the point may lie whose depth a pixel has, pixels.
GN_FN real snapOf(real sub_pixel_bits)
{
    return kSnapSteps * exp2(-sub_pixel_bits);
}

GN_FN real dotRow(real4 row, real3 p)
{
    return dot(real3(row.x, row.y, row.z), p) + row.w;
}
GN_FN real3 gradientOf(real4 row)
{
    return real3(row.x, row.y, row.z);
}

GN_FN real mapW(MapRows map, real3 p)
{
    return mix(dotRow(map.w, p), real(1.0), GNOMON_ORTHOGRAPHIC_ONLY);
}

GN_FN real2 texelAt(MapRows map, real3 p, real w)
{
    return real2(dotRow(map.x, p), dotRow(map.y, p)) / w;
}

// Derivation. Capitals are gradients of the rows, x is the cross product between vectors.
// Moving from texel (u, v) to (u + du, v + dv) on the plane dot(n, dp) = 0 means
//   dot(X, dp) = w' du,  dot(Y, dp) = w' dv,
// with X = gradient(x) - u W, Y = gradient(y) - v W, w' = w + dot(W, dp). So
//   dp = w' (du A + dv B),  A = Y x n / det,  B = n x X / det,  det = dot(X, Y x n).
// Solving w' = w + w' (du W.A + dv W.B) gives
//   w' = w / (1 + dot(s, d)),  s = -(W.A, W.B),
// and the metric
//   m' = m + dot(M, dp) = (m + dot(m s + w (M.A, M.B), d)) / (1 + dot(s, d)).
// For an orthographic map W = 0.
// A plane that lies e along n from this one has at the same texel the depth m + e M.C / det: C = X x Y leads along the
// texel's ray, and det = dot(n, C). `rise` is M.C / det.
GN_FN void receiverPlane(MapRows map, real3 n, real2 texel, real w, real m, GN_OUT(real2) depth_slope,
                         GN_OUT(real2) w_slope, GN_OUT(real) rise)
{
    real3 gw = gradientOf(map.w);
    real3 gx = gradientOf(map.x) - gw * texel.x;
    real3 gy = gradientOf(map.y) - gw * texel.y;
    real3 a = cross(gy, n);
    real3 b = cross(n, gx);
    real3 gm = gradientOf(map.metric);
    const bool ortho = GNOMON_ORTHOGRAPHIC_ONLY;
    real det = mix(dot(gx, a), dot(n, gradientOf(map.plane_w)), ortho);
    // Edge-on, the slope is without bound; keep it finite and let the steepness limit deal with it.
    real tiny = mix(real(1e-6) * length(gx) * length(gy), map.plane_w.w, ortho);
    real inverse = real(1.0) / (abs(det) > tiny ? det : (det < real(0.0) ? -tiny : tiny));
    w_slope = real2(dot(gw, a), dot(gw, b)) * mix(-inverse, real(0.0), ortho);
    real along_u = mix(dot(gm * w, a), dot(n, gradientOf(map.plane_x)), ortho);
    real along_v = mix(dot(gm * w, b), dot(n, gradientOf(map.plane_y)), ortho);
    depth_slope = w_slope * m + real2(along_u, along_v) * inverse;
    rise = mix(dot(gm, cross(gx, gy)), dot(gm, gradientOf(map.plane_w)), ortho) * inverse;
}

// A texel's longest extent across the light where the map has the given w, metres. A texel is a ray of light, so the
// gradients of its two coordinates lie across the ray, and the inverse of the two stretches a texel to its footprint by
// at most one over their least singular value: the greatest over their determinant.
GN_FN real texelExtent(MapRows map, real2 texel, real w)
{
    real3 gx = gradientOf(map.x) - gradientOf(map.w) * texel.x;
    real3 gy = gradientOf(map.y) - gradientOf(map.w) * texel.y;
    real xx = dot(gx, gx);
    real yy = dot(gy, gy);
    real xy = dot(gx, gy);
    real half_difference = real(0.5) * (xx - yy);
    real greatest = real(0.5) * (xx + yy) + sqrt(half_difference * half_difference + xy * xy);
    return mix(w * sqrt(greatest) / length(cross(gx, gy)), map.texel_m, GNOMON_ORTHOGRAPHIC_ONLY);
}

// `p` in the space of the rows, `n` its unit geometric normal, which faces the light.
GN_FN MapPoint projectReceiver(MapRows map, BiasRule rule, real3 p, real3 n)
{
    MapPoint r;
    real offset_texels = rule.automatic > real(0.0) ? real(0.0) : rule.normal_texels;
    real3 moved = p;
    if (offset_texels != real(0.0)) {
        real w = mapW(map, p);
        moved = p + n * (offset_texels * texelExtent(map, texelAt(map, p, w), w));
    }
    r.w = mapW(map, moved);
    r.texel = texelAt(map, moved, r.w);
    real m = dotRow(map.metric, moved);

    real2 plane_slope;
    real2 w_slope;
    real rise;
    receiverPlane(map, n, r.texel, r.w, m, plane_slope, w_slope, rise);
    // The slope of depth itself, in metric per texel, at the receiver.
    real2 slope = plane_slope - w_slope * m;
    real texel_depth = texelExtent(map, r.texel, r.w) / map.range_m; // a texel's width, as a metric difference
    real steepness = length(slope) / texel_depth;

    r.plane_doubt = real(0.0);
    real follow = real(0.0);
    real bias = real(0.0);
    if (rule.automatic > real(0.0)) {
        follow = max(rule.exact_plane, min(real(1.0), kSteepest / max(steepness, real(1e-6))));
        real lost = (real(1.0) - follow) * (abs(slope.x) + abs(slope.y)); // per texel, where the plane is not followed
        real bounded = min(steepness, kSteepestBias);
        real doubt = rule.normal_error * (real(1.0) + bounded * bounded);
        real at_reach = kRoughness + (kRoughnessPerTexel + doubt) * rule.reach_texels;
        bias = rule.quantum + texel_depth * (real(1.0) - rule.exact_plane) * at_reach;
        bias = bias + rule.snap_texels * min(abs(slope.x) + abs(slope.y), kSteepestBias * texel_depth);
        bias = bias + rule.off_plane_m * min(abs(rise), kSteepestBias / map.range_m);
        bias = bias + lost * rule.reach_texels;
        r.plane_doubt = doubt * texel_depth;
    } else {
        follow = rule.receiver_plane;
        bias = rule.constant_m / map.range_m + rule.slope * length(slope);
    }
    r.texel_depth = texel_depth;
    r.w_slope = w_slope * follow;
    r.depth_slope = r.w_slope * m + slope * follow;
    r.depth = m - bias;
    r.cap = min(r.depth, real(1.0)); // and texels that nothing was drawn to, which hold 1, light everything
    // The bias is along with the depth at every tap: (depth + ..) / (1 + ..) - bias needs its share of the slope.
    r.depth_slope = r.depth_slope - r.w_slope * bias;
    return r;
}

// The reference depth at `offset` texels from the receiver, times y of the result. A stored depth s is lit when
// s * y >= x, which spares a division.
GN_FN real2 referenceAt(MapPoint r, real2 offset)
{
    real w = max(real(1.0) + dot(r.w_slope, offset), real(0.05));
    return real2(min(r.depth + dot(r.depth_slope, offset), r.cap * w), w);
}

GN_END
#endif
