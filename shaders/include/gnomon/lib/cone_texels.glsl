// SPDX-License-Identifier: Apache-2.0
// Which texels of a depth map can block any ray of a receiver's cone, and what blocks (gnomon/shared/map_blocks.h) say of that.
#ifndef GNOMON_CONE_TEXELS_GLSL
#define GNOMON_CONE_TEXELS_GLSL
#include "light_cone.glsl"
GN_BEGIN

// Two neighbouring texels whose depths differ by no more than this, times a texel's width, are one surface. From 2 to 8
// it hardly matters; without a limit every caster would be a wall down to the ground.
GN_CONST real kOneSurface = real(4.0);
// How far from the receiver a texel of a crease is looked for, texels.
GN_CONST real kCrease = real(1.6);
// Beyond the view's tile its last texels go on; NaN is a texel, too.
GN_FN real2 texelInside(FilterInput f, real2 cell)
{
    return min(real2(f.tile.z, f.tile.w) - real2(real(1.0)), max(real2(f.tile.x, f.tile.y), cell));
}

// How often the part of the map that can block is narrowed down: by a filter that will read what is left, and by one
// that will leave the receiver to another draw. The first narrowing settles nearly all that the others do.
GN_CONST int kNarrowings = 4;
GN_CONST int kFewNarrowings = 1;

// Texels around the receiver that the cone may touch as far as `s`: low x, y, high x, y, absolute. A rim that leads
// beyond what a perspective map shows gives a rectangle that holds nothing else either.
GN_FN real4 coneTexels(RayCone c, real s)
{
    real2 here = c.at;
    real4 box = real4(here.x, here.y, here.x, here.y);
    for (int i = 0; i < 4; ++i) {
        real a = (i & 1) == 0 ? s : -s;
        real b = (i & 2) == 0 ? s : -s;
        real3 h = c.start + c.axis * s + c.side_x * a + c.side_y * b;
        real w = mix(max(h.z, real(0.5) * kRayEnd * c.start.z), real(1.0), GNOMON_ORTHOGRAPHIC_ONLY);
        real2 q = real2(h.x, h.y) / w;
        box = real4(min(box.x, q.x), min(box.y, q.y), max(box.z, q.x), max(box.w, q.y));
    }
    return box;
}

// A texel that nothing was drawn to holds this. It blocks nobody, not even receivers beyond the map's far plane.
GN_CONST real kNothingDrawn = real(1.0);

// Is what a texel holds above the receiver's plane, at the texel's own centre? `at`: of the centre, relative to the
// receiver. The plane is off by what the normal is, the more the farther away.
GN_FN bool risesOverPlane(MapPoint point, real2 at, real stored)
{
    real w = max(real(1.0) + dot(point.w_slope, at), real(0.05));
    real plane = point.depth + dot(point.depth_slope, at);
    real doubt = point.plane_doubt * (abs(at.x) + abs(at.y)) * w;
    return stored < kNothingDrawn && stored * w < plane - doubt;
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

// The bounds that blocks give for the texels that the rays may touch.
struct RayRegion {
    real4 texels;  // rectangle: low x, y, high x, y
    real nearest;  // nothing there is nearer to the light
    real farthest; // or farther
};

GN_FN real2 joined(real2 a, real2 b)
{
    return real2(min(a.x, b.x), max(a.y, b.y));
}

GN_FN RayRegion regionAround(RayCone cone, FilterInput f, real within, real nearest, real end)
{
    RayRegion r;
    real pad = real(0.5) * within + real(0.01);
    r.texels = coneTexels(cone, coneReach(cone, nearest, end)) + real4(-pad, -pad, pad, pad);
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

// The facts about a receiver that are known before any texel is read.
struct Surroundings {
    real visibility; // 0 or 1; negative: not known
    real nearest;    // no possible blocker is nearer to the light
    real4 texels;    // where blockers may be, as in RayRegion
};

// Rays start within a square of `within` texels around the receiver, on its plane. `end`: kRayEnd or kDiscEnd.
GN_FN Surroundings lookAround(MapPoint point, FilterInput f, RayCone cone, real within, real end)
{
    // The nearest surface bounds how far rays have to go, and so where they may lead, and so what surfaces there are.
    RayRegion region = regionAround(cone, f, within, real(0.0), end);
    int left = GNOMON_SETTLES ? kFewNarrowings : kNarrowings;
    real before = real(0.0);
    do {
        before = region.nearest;
        region = regionAround(cone, f, within, before, end);
        --left;
    } while (left > 0 && region.nearest > before && region.nearest < point.depth);
    Surroundings around;
    around.visibility = real(-1.0);
    around.nearest = region.nearest;
    around.texels = region.texels;
    real2 size = real2(region.texels.z - region.texels.x, region.texels.w - region.texels.y);
    if (region.nearest >= point.depth) {
        around.visibility = real(1.0);
    } else if (region.farthest < kNothingDrawn &&
               region.farthest < planeNearest(point, region.texels) - kOneSurface * point.texel_depth) {
        around.visibility = real(0.0); // all of it is one body above the receiver
    } else if (max(size.x, size.y) <= real(3.0)) {
        around.visibility = noneRises(point, f, region.texels) ? real(1.0) : real(-1.0);
    }
    return around;
}

GN_END
#endif
