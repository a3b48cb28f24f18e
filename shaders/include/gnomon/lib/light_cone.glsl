// SPDX-License-Identifier: Apache-2.0
// Shared by filters that know how large the light is: the cone of rays from a receiver to all of the light, as it lies
// on the map, and the noise by which its points are chosen.
#ifndef GNOMON_LIGHT_CONE_GLSL
#define GNOMON_LIGHT_CONE_GLSL
#include "../shared/discs.h"
#include "filter_types.glsl"
GN_BEGIN

// Points of the cone of rays at one distance along the light, as homogeneous map coordinates. At s = 1 the cone's axis
// is one `toward` from the receiver.
struct RayCone {
    real3 start;  // the receiver's x, y, w
    real metric;  // the receiver's, less the bias
    real3 axis;   // growth of start along the axis
    real3 side_x; // and along two directions across it, to the cone's rim
    real3 side_y;
    real rise;    // fall of the metric along the axis; > 0
    real rise_x;  // and along the two directions, by sign
    real rise_y;
    real2 at;     // the receiver's place on the map: x and y of start, over its w
    real3 facing; // how far the axis and the two directions lead from the receiver's plane
};

GN_FN real3 mapGradient(MapRows rows, real3 d)
{
    real w = mix(dot(gradientOf(rows.w), d), real(0.0), GNOMON_ORTHOGRAPHIC_ONLY);
    return real3(dot(gradientOf(rows.x), d), dot(gradientOf(rows.y), d), w);
}

GN_FN RayCone rayCone(MapPoint point, FilterInput f)
{
    real3 axis = f.toward;
    real3 helper = abs(axis.y) < real(0.7) * length(axis) ? real3(0.0, 1.0, 0.0) : real3(1.0, 0.0, 0.0);
    real3 right = normalize(cross(helper, axis));
    real3 up = normalize(cross(axis, right));
    right = right * f.spread;
    up = up * f.spread;
    RayCone c;
    c.start = real3(point.texel.x * point.w, point.texel.y * point.w, point.w);
    c.at = GNOMON_RECOMPUTES ? point.texel : real2(c.start.x, c.start.y) / c.start.z;
    c.metric = point.depth;
    c.axis = mapGradient(f.rows, axis);
    c.side_x = mapGradient(f.rows, right);
    c.side_y = mapGradient(f.rows, up);
    real3 m = gradientOf(f.rows.metric);
    c.rise = -dot(m, axis);
    c.rise_x = -dot(m, right);
    c.rise_y = -dot(m, up);
    c.facing = real3(dot(f.n, axis), dot(f.n, right), dot(f.n, up));
    return c;
}

// Before rays have come to a lamp their places on its map go to infinity. They are followed until w, the distance
// along the lamp's axis, is this share of what it is at the receiver.
GN_CONST real kRayEnd = real(0.008);
// A filter that reads all over the cone's disc, and does not follow rays, ends sooner: the few taps of a wider disc
// miss small occluders.
GN_CONST real kDiscEnd = real(0.05);

// A ray's length in which the metric falls by `fall`. `rise`: its fall over a length of 1; `w` and `w_way`: w at the
// ray's beginning, and its growth over a length of 1; `end`: kRayEnd or kDiscEnd.
GN_FN real rayLength(real fall, real rise, real w, real w_way, real end)
{
    real s = max(fall, real(0.0)) / max(rise, real(1e-30));
    return mix(min(s, (real(1.0) - end) * w / max(-w_way, real(1e-30))), s, GNOMON_ORTHOGRAPHIC_ONLY);
}

// Rays go on a little beyond the nearest surface, so that rounding does not end them before it.
GN_CONST real kRayBeyond = real(1.001);

// How far along the cone all of it is at least as near to the light as a depth.
GN_FN real coneReach(RayCone c, real depth, real end)
{
    real slowest = max(c.rise - abs(c.rise_x) - abs(c.rise_y), real(0.25) * c.rise);
    return rayLength(kRayBeyond * (c.metric - depth), slowest, c.start.z, c.axis.z, end);
}

// Where the cone's cross-section at `s` has its point `at`, on the map.
GN_FN real2 coneTexel(RayCone cone, real s, real2 at)
{
    real3 h = cone.start + (cone.axis + cone.side_x * at.x + cone.side_y * at.y) * s;
    return real2(h.x, h.y) / max(h.z, real(0.5) * kRayEnd * cone.start.z);
}

// Another for each pixel.
struct ConeNoise {
    real2 turn;  // cosine and sine
    real2 shift; // parts of a texel
};

GN_FN ConeNoise coneNoise(real2 pixel)
{
    real turn = interleavedGradientNoise(pixel) * real(6.2831853);
    ConeNoise noise;
    noise.turn = real2(cos(turn), sin(turn));
    noise.shift = real2(interleavedGradientNoise(pixel + real2(real(47.0), real(17.0))),
                        interleavedGradientNoise(pixel + real2(real(-23.0), real(61.0))));
    return noise;
}

// Point i of `count` of the light's disc, as shares of the cone's sides.
GN_FN real2 pointOfLight(ConeNoise noise, int i, int count)
{
    real2 at = vogelPoint(i, count);
    return real2(at.x * noise.turn.x - at.y * noise.turn.y, at.x * noise.turn.y + at.y * noise.turn.x);
}

// Where ray i starts, as a share of the square around its receiver, so that no texel's edge is seen: the plastic
// number's sequence, M. Roberts, "The unreasonable effectiveness of quasirandom sequences", 2018.
GN_FN real2 pointOfTexel(ConeNoise noise, int i)
{
    return fract(noise.shift + real(i) * real2(real(0.7548776662), real(0.5698402910))) - real2(real(0.5));
}

GN_END
#endif
