// SPDX-License-Identifier: Apache-2.0
// What filters have in common that know how large the light is: the cone of rays from a receiver to all of the light, as
// it lies on the map; which texels can block any of them; and what blocks (shared/map_blocks.h) say of that.
#ifndef GNOMON_LIGHT_CONE_GLSL
#define GNOMON_LIGHT_CONE_GLSL
#include "../shared/discs.h"
#include "filter_types.glsl"
GN_BEGIN

// Two neighbouring texels whose depths differ by no more than this, times a texel's width, are one surface. From 2 to 8
// it hardly matters; without a limit every caster would be a wall down to the ground.
GN_CONST real kOneSurface = real(4.0);
// How far from the receiver a texel of a crease is looked for, texels.
GN_CONST real kCrease = real(1.6);
// How often the part of the map that can block is narrowed down.
GN_CONST int kNarrowings = 4;

// Points of the cone of rays at one distance along the light, as homogeneous map coordinates. At s = 1 the cone's axis
// is one `toward` from the receiver.
struct RayCone {
    real3 start;  // x, y, w of the receiver
    real metric;  // of the receiver, less the bias
    real3 axis;   // what start gains along the axis
    real3 side_x; // and along two directions across it, to the cone's rim
    real3 side_y;
    real rise;    // what the metric loses along the axis; > 0
    real rise_x;  // and along the two directions, by sign
    real rise_y;
    real3 facing; // how far the axis and the two directions lead from the receiver's plane
};

GN_FN real3 mapGradient(MapRows rows, real3 d)
{
#ifdef GNOMON_ORTHOGRAPHIC_ONLY
    return real3(dot(gradientOf(rows.x), d), dot(gradientOf(rows.y), d), real(0.0));
#else
    return real3(dot(gradientOf(rows.x), d), dot(gradientOf(rows.y), d), dot(gradientOf(rows.w), d));
#endif
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
GN_CONST real kRayEnd = real(0.05);

// A ray's length in which the metric falls by `fall`, `rise` being what it falls over a length of 1; `w` and `w_way`: at
// its beginning, and what it gains over a length of 1.
GN_FN real rayLength(real fall, real rise, real w, real w_way)
{
    real s = max(fall, real(0.0)) / max(rise, real(1e-30));
#ifndef GNOMON_ORTHOGRAPHIC_ONLY
    s = min(s, (real(1.0) - kRayEnd) * w / max(-w_way, real(1e-30)));
#endif
    return s;
}

// Rays go on a little beyond the nearest surface, so that rounding does not end them before it.
GN_CONST real kRayBeyond = real(1.001);

// How far along the cone all of it is at least as near to the light as a depth.
GN_FN real coneReach(RayCone c, real depth)
{
    real slowest = max(c.rise - abs(c.rise_x) - abs(c.rise_y), real(0.25) * c.rise);
    return rayLength(kRayBeyond * (c.metric - depth), slowest, c.start.z, c.axis.z);
}

// Texels around the receiver that the cone may touch as far as `s`: low x, y, high x, y, absolute. A rim that leads
// beyond what a perspective map shows gives a rectangle that holds nothing else either.
GN_FN real4 coneTexels(RayCone c, real s)
{
    real2 here = real2(c.start.x, c.start.y) / c.start.z;
    real4 box = real4(here.x, here.y, here.x, here.y);
    for (int i = 0; i < 4; ++i) {
        real a = (i & 1) == 0 ? s : -s;
        real b = (i & 2) == 0 ? s : -s;
        real3 h = c.start + c.axis * s + c.side_x * a + c.side_y * b;
#ifdef GNOMON_ORTHOGRAPHIC_ONLY
        real2 q = real2(h.x, h.y);
#else
        real2 q = real2(h.x, h.y) / max(h.z, real(0.5) * kRayEnd * c.start.z);
#endif
        box = real4(min(box.x, q.x), min(box.y, q.y), max(box.z, q.x), max(box.w, q.y));
    }
    return box;
}

// Is what a texel holds above the receiver's plane, at the texel's own centre? `at`: of the centre, relative to the
// receiver. The plane is off by what the normal is, the more the farther away.
GN_FN bool risesOverPlane(MapPoint point, real2 at, real stored)
{
    real w = max(real(1.0) + dot(point.w_slope, at), real(0.05));
    real plane = point.depth + dot(point.depth_slope, at);
    real doubt = point.plane_doubt * (abs(at.x) + abs(at.y)) * w;
    return stored * w < plane - doubt;
}

// A texel beside the receiver may belong to a wall that meets the receiver's surface in a crease, and rise over the
// receiver's plane there, though it does not where the receiver is: followed on as it leans, it passes beneath.
// `at`: of the texel's centre, relative to the receiver.
GN_FN bool passesBeneath(MapPoint point, FilterInput f, real2 cell, real2 at, real stored)
{
    real beyond_x = mapTexel(cell + real2(sign(at.x), real(0.0)), f.layer, f.part);
    real beyond_y = mapTexel(cell + real2(real(0.0), sign(at.y)), f.layer, f.part);
    // Where it ends or bends away from the light beyond, it is no such wall.
    real leans = max(stored - beyond_x, real(0.0)) * abs(at.x) + max(stored - beyond_y, real(0.0)) * abs(at.y);
    return stored + leans >= point.depth;
}

// Can this texel block a ray of the receiver's?
GN_FN bool canBlock(MapPoint point, FilterInput f, real2 cell, real2 at, real stored)
{
    bool rises = risesOverPlane(point, at, stored);
    if (rises && max(abs(at.x), abs(at.y)) < kCrease) {
        rises = !passesBeneath(point, f, cell, at, stored);
    }
    return rises;
}

// What blocks say of the texels that the rays may touch.
struct RayRegion {
    real4 texels;  // rectangle: low x, y, high x, y
    real nearest;  // nothing there is nearer to the light
    real farthest; // or farther
};

GN_FN real2 joined(real2 a, real2 b)
{
    return real2(min(a.x, b.x), max(a.y, b.y));
}

GN_FN RayRegion regionAround(RayCone cone, FilterInput f, real within, real nearest)
{
    RayRegion r;
    real pad = real(0.5) * within + real(0.01);
    r.texels = coneTexels(cone, coneReach(cone, nearest)) + real4(-pad, -pad, pad, pad);
    r.texels = real4(max(f.tile.x, r.texels.x), max(f.tile.y, r.texels.y), min(f.tile.z - real(0.01), r.texels.z),
                     min(f.tile.w - real(0.01), r.texels.w));
    real side = max(real(2.0), max(r.texels.z - r.texels.x, r.texels.w - r.texels.y));
    real level = min(ceil(log2(side)), f.coarsest);
    real size = exp2(-level);
    real2 low = floor(real2(r.texels.x, r.texels.y) * size);
    real2 high = floor(real2(r.texels.z, r.texels.w) * size);
    int l = int(level);
    real2 depths =
        joined(joined(mapBlock(low, l, f.layer), mapBlock(high, l, f.layer)),
               joined(mapBlock(real2(low.x, high.y), l, f.layer), mapBlock(real2(high.x, low.y), l, f.layer)));
    r.nearest = depths.x;
    r.farthest = depths.y;
    return r;
}

// Depth of the receiver's plane where it is nearest to the light within a rectangle of the map.
GN_FN real planeNearest(MapPoint point, real4 texels)
{
    real2 reach = max(real2(texels.z, texels.w) - point.texel, point.texel - real2(texels.x, texels.y));
    real2 slope = point.depth_slope - point.w_slope * point.depth;
    real w = real(1.0) - abs(point.w_slope.x) * reach.x - abs(point.w_slope.y) * reach.y;
    return point.depth - (abs(slope.x) * reach.x + abs(slope.y) * reach.y) / max(w, real(0.05));
}

// Does none of the texels of a rectangle of at most three on a side rise over the receiver's plane?
GN_FN bool noneRises(MapPoint point, FilterInput f, real4 texels)
{
    bool none = true;
    real2 first = floor(real2(texels.x, texels.y)) + real2(real(1.0));
    for (int i = 0; i < 4; ++i) {
        real2 corner = first + real2(real(2 * (i & 1)), real(2 * (i >> 1)));
        real4 stored = mapGather(corner, f.layer, f.part);
        real2 at = corner - point.texel;
        none = none && !risesOverPlane(point, at + real2(real(-0.5), real(0.5)), stored.x) &&
               !risesOverPlane(point, at + real2(real(0.5), real(0.5)), stored.y) &&
               !risesOverPlane(point, at + real2(real(0.5), real(-0.5)), stored.z) &&
               !risesOverPlane(point, at + real2(real(-0.5), real(-0.5)), stored.w);
    }
    return none;
}

// What is known of a receiver before a single texel is looked at.
struct Surroundings {
    real visibility; // 0 or 1; negative: that depends
    real nearest;    // nothing that may block is nearer to the light
    real4 texels;    // where it may be, as RayRegion has it
};

// Rays start within a square of `within` texels around the receiver, on its plane.
GN_FN Surroundings lookAround(MapPoint point, FilterInput f, RayCone cone, real within)
{
    // The nearest surface bounds how far rays have to go, and so where they may lead, and so what surfaces there are.
    RayRegion region = regionAround(cone, f, within, real(0.0));
    int left = kNarrowings;
    real before = real(0.0);
    do {
        before = region.nearest;
        region = regionAround(cone, f, within, before);
        --left;
    } while (left > 0 && region.nearest > before && region.nearest < point.depth);
    Surroundings around;
    around.visibility = real(-1.0);
    around.nearest = region.nearest;
    around.texels = region.texels;
    real2 size = real2(region.texels.z - region.texels.x, region.texels.w - region.texels.y);
    if (region.nearest >= point.depth) {
        around.visibility = real(1.0);
    } else if (region.farthest < planeNearest(point, region.texels) - kOneSurface * point.texel_depth) {
        around.visibility = real(0.0); // all of it is one body above the receiver
    } else if (max(size.x, size.y) <= real(3.0)) {
        around.visibility = noneRises(point, f, region.texels) ? real(1.0) : real(-1.0);
    }
    return around;
}

// Another for each pixel.
struct ConeNoise {
    real2 turn;  // cosine and sine
    real2 shift; // of a texel
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
