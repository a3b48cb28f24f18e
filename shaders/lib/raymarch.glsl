// SPDX-License-Identifier: Apache-2.0
// raymarch: the share of the light that a receiver sees, by rays to points of the light that are marched through the
// map as through a height field, texel by texel.
// Related: S. Xie, E. Tabellion, A. Pearce, "Soft shadows by ray tracing multilayer transparent shadow maps", EGSR
// 2007; G. Guennebaud, L. Barthe, M. Paulin, "Real-time soft shadow mapping by backprojection", EGSR 2006. That a texel
// is compared with the receiver's plane at the texel's own centre is after H. Dou et al., "Adaptive depth bias for
// shadow maps", JCGT 3(4), 2014.
//
// A ray starts on the receiver's plane. Where it crosses a texel's surface it is blocked. So it is where it passes
// between the surfaces of two neighbouring texels that are not far apart in depth, because there the map has one
// surface, which leans. Texels on the receiver's plane or beneath it cannot block. Occluders that overlap fuse by
// themselves, which the mean depth of blockers (pcss) cannot do.
//
// What the map does not hold, no ray can find: what lies behind its first surface, and what is thinner than a texel.
#ifndef GNOMON_RAYMARCH_GLSL
#define GNOMON_RAYMARCH_GLSL
#include "../shared/discs.h"
#include "filter_types.glsl"
GN_BEGIN

// Two neighbouring texels whose depths differ by no more than this, times a texel's width, are one surface. From 2 to 8
// it hardly matters; without a limit every caster would be a wall down to the ground.
GN_CONST real kRaySurface = real(4.0);
// How far from the receiver a texel of a crease is looked for, texels.
GN_CONST real kRayCrease = real(1.6);
// Rays of a pixel, and how many texels they shall visit together: where they would visit more, there are fewer rays.
GN_CONST int kRaysMost = 48;
GN_CONST int kRaysLeast = 16;
GN_CONST int kRaysFewest = 8;
GN_CONST real kRaysPerTexel = real(3.5); // that the light's disc is wide on the map
GN_CONST real kRayTexels = real(1024.0);
// Texels that one ray may visit. What lies beyond does not block.
GN_CONST int kRaySteps = 256;
// How often the part of the map that can block is narrowed down.
GN_CONST int kRayNarrowings = 4;

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

// Is the ray blocked that leads from `start` to `end` (homogeneous), over which the metric falls from `from` to `to`?
// `steps`: texels that it may visit.
GN_FN bool rayIsBlocked(MapPoint point, FilterInput f, real3 start, real3 end, real from, real to, int steps)
{
    real2 first = real2(start.x, start.y) / start.z;
    real2 last = real2(end.x, end.y) / end.z;
    real2 run = last - first;
    real2 cell = floor(first);
    real2 sense = real2(run.x < real(0.0) ? real(-1.0) : real(1.0), run.y < real(0.0) ? real(-1.0) : real(1.0));
    real2 per_cell = real2(real(1.0) / max(abs(run.x), real(1e-9)), real(1.0) / max(abs(run.y), real(1e-9)));
    // Where along the run, from 0 to 1, the next border across x and across y is.
    real2 next = (max(sense, real2(real(0.0))) + sense * (cell - first)) * per_cell;
    real enters = from;
    real before = real(2.0); // depth of the texel before
    bool before_rises = false;
    real surface = kRaySurface * point.texel_depth;
    bool blocked = false;
    bool more = true;
    int left = steps;
    do {
        real t = min(min(next.x, next.y), real(1.0));
#ifdef GNOMON_ORTHOGRAPHIC_ONLY
        real s = t;
#else
        // Of the ray's own length: lines stay straight in a perspective map, but not their measure.
        real s = t * start.z / (t * start.z + (real(1.0) - t) * end.z);
#endif
        real leaves = from + (to - from) * s;
        real stored = mapTexel(cell, f.layer, f.part);
        real2 at = cell + real2(real(0.5)) - point.texel;
        bool rises = risesOverPlane(point, at, stored);
        if (rises && max(abs(at.x), abs(at.y)) < kRayCrease) {
            rises = !passesBeneath(point, f, cell, at, stored);
        }
        real low = min(before, stored);
        real high = max(before, stored);
        bool low_rises = before < stored ? before_rises : rises;
        bool one_body = (before_rises && rises) || high - low <= surface;
        bool between = low_rises && enters > low && enters < high && one_body;
        bool crosses = rises && enters > stored && leaves <= stored;
        blocked = between || crosses;
        --left;
        more = !blocked && t < real(1.0) && left > 0;
        bool along_x = next.x <= next.y;
        cell = cell + real2(along_x ? sense.x : real(0.0), along_x ? real(0.0) : sense.y);
        next = next + real2(along_x ? per_cell.x : real(0.0), along_x ? real(0.0) : per_cell.y);
        more = more && cell.x >= f.tile.x && cell.y >= f.tile.y && cell.x < f.tile.z && cell.y < f.tile.w;
        before = stored;
        before_rises = rises;
        enters = leaves;
    } while (more);
    return blocked;
}

// The share of `count` rays that reach the light, as far as depth `nearest`, above which nothing casts.
GN_FN real raysUnblocked(MapPoint point, FilterInput f, RayCone cone, real nearest, int count)
{
    real turn = interleavedGradientNoise(f.pixel) * real(6.2831853);
    real2 turned = real2(cos(turn), sin(turn));
    real2 shift = real2(interleavedGradientNoise(f.pixel + real2(real(47.0), real(17.0))),
                        interleavedGradientNoise(f.pixel + real2(real(-23.0), real(61.0))));
    real lit = real(0.0);
    int i = 0;
    do {
        real2 at = vogelPoint(i, count);
        at = real2(at.x * turned.x - at.y * turned.y, at.x * turned.y + at.y * turned.x);
        // From anywhere within half a texel, so that no texel's edge is seen: the plastic number's sequence, M. Roberts,
        // "The unreasonable effectiveness of quasirandom sequences", 2018.
        real2 from = fract(shift + real(i) * real2(real(0.7548776662), real(0.5698402910))) - real2(real(0.5));
        real w = max(real(1.0) + dot(point.w_slope, from), real(0.25));
        real metric = (point.depth + dot(point.depth_slope, from)) / w;
        real3 start = real3(point.texel.x + from.x, point.texel.y + from.y, real(1.0)) * (cone.start.z / w);
        real3 way = cone.axis + cone.side_x * at.x + cone.side_y * at.y;
        real rise = cone.rise + cone.rise_x * at.x + cone.rise_y * at.y;
        real s = rayLength(kRayBeyond * (metric - nearest), max(rise, real(0.05) * cone.rise), start.z, way.z);
        real3 end = start + way * s;
        bool faces = dot(cone.facing, real3(real(1.0), at.x, at.y)) > real(0.0);
        lit += faces && !rayIsBlocked(point, f, start, end, metric, metric - rise * s, kRaySteps) ? real(1.0) : real(0.0);
        ++i;
    } while (i < count);
    return lit / real(count);
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

GN_FN RayRegion regionAround(RayCone cone, FilterInput f, real nearest)
{
    RayRegion r;
    // Rays start up to half a texel off.
    r.texels = coneTexels(cone, coneReach(cone, nearest)) + real4(real(-0.51), real(-0.51), real(0.51), real(0.51));
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

// In a penumbra few texels wide these are what is seen, whatever the rays; in a wide one it is the rays' noise.
GN_FN int rayCount(real4 texels)
{
    real across = real(0.5) * (texels.z - texels.x + texels.w - texels.y);
    // A ray leads from the middle to somewhere between there and the rim.
    real affordable = kRayTexels / (real(0.7) * across);
    real wanted = clamp(kRaysPerTexel * across, real(kRaysLeast), real(kRaysMost));
    return int(clamp(affordable, real(kRaysFewest), wanted));
}

GN_FN real filterRaymarch(MapPoint point, FilterInput f)
{
    RayCone cone = rayCone(point, f);
    // The nearest surface bounds how far rays have to go, and so where they may lead, and so what surfaces there are.
    RayRegion region = regionAround(cone, f, real(0.0));
    int left = kRayNarrowings;
    real before = real(0.0);
    do {
        before = region.nearest;
        region = regionAround(cone, f, before);
        --left;
    } while (left > 0 && region.nearest > before);
    if (region.nearest >= point.depth) {
        return real(1.0);
    }
    // All of it is one body above the receiver.
    if (region.farthest < planeNearest(point, region.texels) - kRaySurface * point.texel_depth) {
        return real(0.0);
    }
    bool few = max(region.texels.z - region.texels.x, region.texels.w - region.texels.y) <= real(3.0);
    if (few && noneRises(point, f, region.texels)) {
        return real(1.0);
    }
    return raysUnblocked(point, f, cone, region.nearest, rayCount(region.texels));
}

GN_END
#endif
