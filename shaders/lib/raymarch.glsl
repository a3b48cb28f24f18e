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
#include "light_cone.glsl"
GN_BEGIN

// Rays of a pixel, and how many texels they shall visit together: where they would visit more, there are fewer rays.
GN_CONST int kRaysMost = 48;
GN_CONST int kRaysLeast = 24;
GN_CONST int kRaysFewest = 8;
GN_CONST real kRaysPerTexel = real(3.5); // that the light's disc is wide on the map
GN_CONST real kRayTexels = real(1024.0);
// Texels that one ray may visit. What lies beyond does not block.
GN_CONST int kRaySteps = 256;
// The square around the receiver that rays start in, texels. In it an edge's place is found to less than a texel. In a
// penumbra so wide that nothing is to be narrowed it is one texel, which blurs less.
GN_CONST real kStartsWithin = real(1.5);
// Rays that are blocked on one side tell an edge from leaves and wires (RaysFound::straight): none of the edge's ramp is
// narrowed below the first value, all above the second.
GN_CONST real kStraightFrom = real(0.5);
GN_CONST real kStraightTo = real(0.9);
// Penumbrae in texels: up to the first all of the ramp is narrowed, from the second on none.
GN_CONST real kWideFrom = real(3.0);
GN_CONST real kWideTo = real(6.0);
// No edge is narrowed further, texels: the map does not say where it is within less.
GN_CONST real kNarrowest = real(0.8);

// How far the metric has fallen where the ray is blocked that leads from `start` to `end` (homogeneous), over which it
// falls from `from` to `to`. Negative: nothing blocks it. `steps`: texels that it may visit.
GN_FN real fallToBlocker(MapPoint point, FilterInput f, real3 start, real3 end, real from, real to, int steps)
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
    real surface = kOneSurface * point.texel_depth;
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
        bool rises = canBlock(point, f, cell, at, stored);
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
    return blocked ? from - enters : real(-1.0);
}

// What the rays of a pixel found.
struct RaysFound {
    real lit;      // share of them that reach the light
    real straight; // 1: those that are blocked start on one side of a straight edge; 0: all around
    real fall;     // of the metric, from the receiver to what blocks: mean
};

// `count` rays, or `enough` if these agree, as far as depth `nearest`, above which nothing casts.
GN_FN RaysFound traceRays(MapPoint point, FilterInput f, RayCone cone, real nearest, int count, int enough,
                         real within)
{
    ConeNoise noise = coneNoise(f.pixel);
    bool agree = true;
    real lit = real(0.0);
    real falls = real(0.0);
    real2 starts = real2(real(0.0));
    real2 starts_lit = real2(real(0.0));
    int i = 0;
    do {
        real2 at = pointOfLight(noise, i, count);
        real2 from = pointOfTexel(noise, i) * within;
        real w = max(real(1.0) + dot(point.w_slope, from), real(0.25));
        real metric = (point.depth + dot(point.depth_slope, from)) / w;
        real3 start = real3(point.texel.x + from.x, point.texel.y + from.y, real(1.0)) * (cone.start.z / w);
        real3 way = cone.axis + cone.side_x * at.x + cone.side_y * at.y;
        real rise = cone.rise + cone.rise_x * at.x + cone.rise_y * at.y;
        real s = rayLength(kRayBeyond * (metric - nearest), max(rise, real(0.05) * cone.rise), start.z, way.z);
        real3 end = start + way * s;
        bool faces = dot(cone.facing, real3(real(1.0), at.x, at.y)) > real(0.0);
        real fall = faces ? fallToBlocker(point, f, start, end, metric, metric - rise * s, kRaySteps) : real(0.0);
        bool reaches = fall < real(0.0);
        lit += reaches ? real(1.0) : real(0.0);
        falls += max(fall, real(0.0));
        starts = starts + from;
        starts_lit = starts_lit + (reaches ? from : real2(real(0.0)));
        ++i;
        agree = lit == real(0.0) || lit == real(i);
    } while (i < count && !(agree && i >= enough));
    real n = real(i);
    RaysFound found;
    found.lit = lit / n;
    found.fall = falls / max(n - lit, real(1.0));
    // An edge along the map's axes leaves a slab of starts in light, whose middle is that far from the middle of all.
    real apart = real(0.5) * within * (real(1.0) - found.lit);
    found.straight = length(starts_lit / max(lit, real(1.0)) - starts / n) / max(apart, real(0.01));
    return found;
}

// The starts of rays make a ramp of what is a step where the light is small or its blocker near. Rays tell how far off
// that is, and so how wide the penumbra is: `across`, texels. A straight edge's ramp is narrowed to that about its
// middle. Around leaves and wires rays are blocked on all sides, and there the mean stays as it is.
GN_FN real narrowed(RaysFound found, real across, real within)
{
    real steeper = (within + across) / max(across, kNarrowest);
    real straight = clamp((found.straight - kStraightFrom) / (kStraightTo - kStraightFrom), real(0.0), real(1.0));
    real share = straight * clamp((kWideTo - across) / (kWideTo - kWideFrom), real(0.0), real(1.0));
    return clamp(real(0.5) + (found.lit - real(0.5)) * mix(real(1.0), steeper, share), real(0.0), real(1.0));
}

// In a penumbra few texels wide these are what is seen, whatever the rays; in a wide one it is the rays' noise.
// `across`: texels that the rays may lead over.
GN_FN int rayCount(real across)
{
    // A ray leads from the middle to somewhere between there and the rim.
    real affordable = kRayTexels / (real(0.7) * across);
    real wanted = clamp(kRaysPerTexel * across, real(kRaysLeast), real(kRaysMost));
    return int(clamp(affordable, real(kRaysFewest), wanted));
}

GN_FN real filterRaymarch(MapPoint point, FilterInput f)
{
    RayCone cone = rayCone(point, f);
    Surroundings around = lookAround(point, f, cone, kStartsWithin);
    if (around.visibility >= real(0.0)) {
        return around.visibility;
    }
    real across = real(0.5) * (around.texels.z - around.texels.x + around.texels.w - around.texels.y);
    real widest = across - kStartsWithin; // of the light's disc, where it is farthest from the receiver
    real within = widest < kWideTo ? kStartsWithin : real(1.0);
    RaysFound found = traceRays(point, f, cone, around.nearest, rayCount(across),
                                across < kWideFrom ? kRaysFewest : kRaysMost, within);
    return narrowed(found, widest * found.fall / max(point.depth - around.nearest, real(1e-9)), within);
}

GN_END
#endif
