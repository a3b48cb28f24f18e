// SPDX-License-Identifier: Apache-2.0
// raymarch: the share of the light that a receiver sees, by rays to points of the light that are marched through the
// map as through a height field, texel by texel.
// Related: S. Xie, E. Tabellion, A. Pearce, "Soft shadows by ray tracing multilayer transparent shadow maps", EGSR
// 2007; G. Guennebaud, L. Barthe, M. Paulin, "Real-time soft shadow mapping by backprojection", EGSR 2006. That a texel
// is compared with the receiver's plane at the texel's own centre is after H. Dou et al., "Adaptive depth bias for
// shadow maps", JCGT 3(4), 2014.
//
// A ray starts on the receiver's plane. It is blocked where it crosses a texel's surface. It is also blocked where it
// passes between the surfaces of two neighbouring texels that are not far apart in depth, because there the map has one
// slanted surface. Texels on the receiver's plane or beneath it cannot block. Occluders that overlap fuse by
// themselves, which the mean depth of blockers (pcss) cannot do.
//
// Rays cannot find occluders that the map does not hold: those behind its first surface, and those thinner than a
// texel.
#ifndef GNOMON_RAYMARCH_GLSL
#define GNOMON_RAYMARCH_GLSL
#include "edge_line.glsl"
GN_BEGIN

// Rays of a pixel, by how far they spread. In a narrow penumbra no more than the first few if these agree.
GN_CONST int kLeastRays = 24;
GN_CONST int kMostRays = 48;
GN_CONST int kRaysToAgree = 8;
GN_CONST real kRaysPerTexel = real(3.5); // that the light's disc is wide on the map
// Vogel's points begin in the light's middle. In a wide penumbra, where rays may end early by kPixelSteps, the first
// few of them must be spread all over the light, or it would look smaller: in steps of a power of two, modulo an odd
// count, each comes once. In a narrow penumbra the first few decide whether further ones are needed. They lie near the
// middle, and their edge is sharper than the map's.
GN_CONST int kRayStride = 16;
GN_CONST int kRayOffset = 14;
// Texels and squares of them that the rays of a pixel may visit together, after which there are no further rays, and
// that one ray may. Texels beyond do not block.
GN_CONST int kPixelSteps = 1024;
GN_CONST int kRaySteps = 256;
// The square around the receiver that rays start in, texels. In it an edge's place is found to less than a texel. In a
// penumbra so wide that its edge is not seen it is one texel, which blurs less.
GN_CONST real kStartsWithin = real(1.5);
// The square where frames are averaged whose maps lie a part of a texel apart: these frames find the edge's place.
GN_CONST real kStartsAtRest = real(0.5);
// Texels: where rays spread less than the first, with the square that they start in, a few may do if they agree. Where
// the light's disc is as wide as the second, lines along edges are not tried.
GN_CONST real kWideFrom = real(3.0);
GN_CONST real kWideTo = real(6.0);

// A pass that shows how rays fared has one of these instead of visibility: blocks or a line along an edge decided without
// a ray; as many rays as wanted; fewer, or some that ended after kRaySteps.
#ifndef GNOMON_SHOWS_RAYS
#define GNOMON_SHOWS_RAYS false
#endif
GN_CONST real kShowsDecided = real(0.25);
GN_CONST real kShowsRays = real(0.5);
GN_CONST real kShowsCeiling = real(0.75);

// Where a ray is on the map: between two places it runs straight from texel to texel.
struct RayRun {
    real2 first;    // texels, where it begins
    real2 run;      // to where it ends
    real2 per_cell; // share of the run over one texel along x and along y; negative: it runs to lower ones
};

GN_FN real2 sharePerCell(real2 run)
{
    real2 share = real2(real(1.0) / max(abs(run.x), real(1e-9)), real(1.0) / max(abs(run.y), real(1e-9)));
    return real2(run.x < real(0.0) ? -share.x : share.x, run.y < real(0.0) ? -share.y : share.y);
}

GN_FN RayRun rayRun(real3 start, real3 end)
{
    RayRun r;
    r.first = real2(start.x, start.y) / start.z;
    r.run = real2(end.x, end.y) / end.z - r.first;
    r.per_cell = real2(real(0.0));
    if (!GNOMON_RECOMPUTES) {
        r.per_cell = sharePerCell(r.run);
    }
    return r;
}

// A ray from the receiver's plane to a point of the light.
struct LightRay {
    RayRun on_map;
    real from; // the metric where it begins
    real to;   // and where it ends
    real from_w; // the map's w where it begins and where it ends, or both divided by the first
    real to_w;
    bool faces; // the light's point is above the receiver's surface
};

// From `offset` texels beside the receiver to the point `at` of the light's unit disc, as far as depth `nearest`.
GN_FN LightRay lightRay(MapPoint point, RayCone cone, real nearest, real2 offset, real2 at)
{
    real w = max(real(1.0) + dot(point.w_slope, offset), real(0.25));
    real3 way = cone.axis + cone.side_x * at.x + cone.side_y * at.y;
    real rise = cone.rise + cone.rise_x * at.x + cone.rise_y * at.y;
    LightRay ray;
    ray.from = (point.depth + dot(point.depth_slope, offset)) / w;
    real3 start = real3(point.texel.x + offset.x, point.texel.y + offset.y, real(1.0)) * (cone.start.z / w);
    real s = rayLength(kRayBeyond * (ray.from - nearest), max(rise, real(0.05) * cone.rise), start.z, way.z, kRayEnd);
    real3 end = start + way * s;
    ray.on_map = rayRun(start, end);
    ray.to = ray.from - rise * s;
    ray.from_w = start.z;
    ray.to_w = end.z;
    if (GNOMON_RECOMPUTES) { // one number fewer
        ray.from_w = real(1.0);
        ray.to_w = end.z / start.z;
    }
    ray.faces = dot(cone.facing, real3(real(1.0), at.x, at.y)) > real(0.0);
    return ray;
}

// The texel beside `cell` towards which the ray runs, or from which it comes, along one axis.
GN_FN real2 cellBeside(RayRun r, real2 cell, bool along_x, real way)
{
    real2 sense = real2(r.run.x < real(0.0) ? -way : way, r.run.y < real(0.0) ? -way : way);
    return cell + real2(along_x ? sense.x : real(0.0), along_x ? real(0.0) : sense.y);
}

// Where the ray leaves the square of `size` texels around a cell, as a share of the run, and the cell that it comes to.
struct RayStep {
    real t;
    real2 cell;
    bool along_x; // it leaves through a side that lies across x
};

GN_FN RayStep leaveSquare(RayRun r, real2 cell, real size)
{
    bool falls_x = r.run.x < real(0.0);
    bool falls_y = r.run.y < real(0.0);
    real2 low = floor(cell / size) * size;
    real2 border = real2(falls_x ? low.x : low.x + size, falls_y ? low.y : low.y + size);
    real2 next = (border - r.first) * r.per_cell;
    RayStep step;
    step.along_x = next.x <= next.y;
    step.t = min(next.x, next.y);
    // Rounding must not lead out of the square along the other axis.
    real first = step.along_x ? r.first.y : r.first.x;
    real run = step.along_x ? r.run.y : r.run.x;
    real least = step.along_x ? low.y : low.x;
    real beside = clamp(floor(first + run * step.t), least, least + (size - real(1.0)));
    bool falls = step.along_x ? falls_x : falls_y;
    real beyond = (step.along_x ? border.x : border.y) - (falls ? real(1.0) : real(0.0));
    step.cell = real2(step.along_x ? beyond : beside, step.along_x ? beside : beyond);
    return step;
}

// A texel as a ray sees it.
struct RayTexel {
    real depth;
    bool rises; // over the receiver's plane
};

GN_FN RayTexel rayTexel(MapPoint point, FilterInput f, real2 cell)
{
    RayTexel texel;
    texel.depth = mapTexel(cell, f.layer, f.part);
    texel.rises = canBlock(point, f, cell, cell + real2(real(0.5)) - point.texel, texel.depth);
    return texel;
}

// Does a texel block a ray whose metric falls in it from `enters` to `leaves`, the texel before it being `before`?
GN_FN bool texelBlocks(RayTexel before, RayTexel here, real enters, real leaves, real surface)
{
    real low = min(before.depth, here.depth);
    real high = max(before.depth, here.depth);
    bool low_rises = before.depth < here.depth ? before.rises : here.rises;
    bool one_body = (before.rises && here.rises) || high - low <= surface;
    bool between = low_rises && enters > low && enters < high && one_body;
    bool crosses = here.rises && enters > here.depth && leaves <= here.depth;
    return between || crosses;
}

// The end of a ray.
struct RayEnd {
    bool blocked;
    int steps; // squares and texels that it visited
};

// Squares of texels none of which comes up to the ray are passed over in one step, larger ones the farther it goes.
GN_FN RayEnd followRay(MapPoint point, FilterInput f, LightRay ray)
{
    RayRun r = ray.on_map;
    real2 cell = floor(r.first);
    RayTexel before;
    before.depth = real(2.0);
    before.rises = false;
    bool came_along_x = false;
    bool passed = false; // over the square before: its last texel was not read
    real enters = ray.from;
    real level = real(0.0);
    bool blocked = false;
    bool more = true;
    int steps = 0;
    do {
        bool advances = true;
        RayTexel here = before;
        if (level > real(0.0)) {
            real2 square = floor(cell * exp2(-level));
            advances = mapBlock(square, int(level), f.layer).x > enters;
            passed = passed || advances;
        } else {
            bool is_here = false;
            do { // the one that was not read first
                is_here = !passed;
                before = here;
                here = rayTexel(point, f, is_here ? cell : cellBeside(r, cell, came_along_x, real(-1.0)));
                passed = false;
            } while (!is_here);
        }
        if (GNOMON_RECOMPUTES) {
            r.per_cell = sharePerCell(r.run);
        }
        RayStep step = leaveSquare(r, cell, exp2(level));
        real t = min(step.t, real(1.0));
        // A share of the ray's own length: lines stay straight in a perspective map, but not their measure.
        real s = mix(t * ray.from_w / (t * ray.from_w + (real(1.0) - t) * ray.to_w), t, GNOMON_ORTHOGRAPHIC_ONLY);
        real leaves = ray.from + (ray.to - ray.from) * s;
        blocked = level == real(0.0) && texelBlocks(before, here, enters, leaves, kOneSurface * point.texel_depth);
        before = here;
        // Out from under a texel's surface a ray may come through its side, which is found between two texels alone.
        bool beneath = level == real(0.0) && before.depth < leaves;
        level = beneath ? real(0.0) : clamp(level + (advances ? real(1.0) : real(-1.0)), real(0.0), f.coarsest);
        if (advances) {
            cell = step.cell;
            came_along_x = step.along_x;
            enters = leaves;
        }
        ++steps;
        bool ended = advances && t >= real(1.0);
        more = !blocked && !ended && steps < kRaySteps;
        more = more && cell.x >= f.tile.x && cell.y >= f.tile.y && cell.x < f.tile.z && cell.y < f.tile.w;
    } while (more);
    RayEnd found;
    found.blocked = blocked;
    found.steps = steps;
    return found;
}

// Which rays of a pixel are traced.
struct RayTask {
    int count;
    bool all;  // else the first kRaysToAgree if these agree
    real side; // of the square around the receiver that they start in, texels
};

// The result of a pixel's rays.
struct RaysFound {
    real lit; // share of the rays that reach the light
    bool cut; // kRaySteps or kPixelSteps were too few
};

// Above depth `nearest` nothing casts.
GN_FN RaysFound traceRays(MapPoint point, FilterInput f, RayCone kept, real nearest, RayTask task)
{
    ConeNoise noise;
    noise.turn = real2(real(0.0));
    noise.shift = real2(real(0.0));
    if (!GNOMON_RECOMPUTES) {
        noise = coneNoise(noisePlace(f));
    }
    bool agree = true;
    bool cut = false;
    int steps = 0;
    real lit = real(0.0);
    int i = 0;
    int strewn = kRayOffset; // (i * kRayStride + kRayOffset) % count, for which software has no quick division
    do {
        RayCone cone = kept;
        if (GNOMON_RECOMPUTES) {
            noise = coneNoise(noisePlace(f));
            FilterInput anew = f;
            anew.toward = f.toward * unknownOne(f);
            cone = rayCone(point, anew);
        }
        if (GNOMON_RECOMPUTES) {
            int whole = int(floor((real(i * kRayStride + kRayOffset) + real(0.5)) / real(task.count)));
            strewn = i * kRayStride + kRayOffset - whole * task.count;
        }
        int turn = task.all ? strewn : i;
        real2 at = pointOfLight(noise, turn, task.count);
        LightRay ray = lightRay(point, cone, nearest, pointOfTexel(noise, i) * task.side, at);
        bool reaches = false;
        if (ray.faces) {
            RayEnd end = followRay(point, f, ray);
            reaches = !end.blocked;
            steps += end.steps;
            cut = cut || end.steps >= kRaySteps;
        }
        lit += reaches ? real(1.0) : real(0.0);
        ++i;
        strewn += kRayStride;
        strewn -= strewn >= task.count ? task.count : 0;
        agree = lit == real(0.0) || lit == real(i);
        cut = cut || (steps >= kPixelSteps && i < task.count && i >= kRaysToAgree);
    } while (i < task.count && !(agree && !task.all && i >= kRaysToAgree) && !(steps >= kPixelSteps && i >= kRaysToAgree));
    RaysFound found;
    found.lit = lit / real(i);
    found.cut = cut;
    return found;
}

// Few rays do where the penumbra is few texels wide, because texels are seen there. In a wide one the rays' noise is.
// `spread`: texels that the rays may lead over.
GN_FN int rayCount(real spread)
{
    real wanted = clamp(kRaysPerTexel * spread, real(kLeastRays), real(kMostRays));
    return int(wanted) / 2 * 2 + 1; // odd, see kRayStride
}

GN_FN real filterRaymarch(MapPoint point, FilterInput f)
{
    RayCone cone = rayCone(point, f);
    Surroundings around = lookAround(point, f, cone, kStartsWithin, kRayEnd);
    if (around.visibility >= real(0.0) || GNOMON_SETTLES) {
        return GNOMON_SHOWS_RAYS && around.visibility >= real(0.0) ? kShowsDecided : around.visibility;
    }
    real spread = real(0.5) * (around.texels.z - around.texels.x + around.texels.w - around.texels.y);
    real widest = spread - kStartsWithin; // width of the light's disc, where it is farthest from the receiver
    if (widest < kWideTo) {
        EdgeShare edge = edgeShare(point, f, cone);
        if (linesSuffice(edge)) {
            return GNOMON_SHOWS_RAYS ? kShowsDecided : edge.lit;
        }
    }
    RayTask task;
    task.count = rayCount(spread);
    task.all = spread >= kWideFrom;
    task.side = f.stood > 0 ? kStartsAtRest : (widest < kWideTo ? kStartsWithin : real(1.0));
    RaysFound found = traceRays(point, f, cone, around.nearest, task);
    return GNOMON_SHOWS_RAYS ? (found.cut ? kShowsCeiling : kShowsRays) : found.lit;
}

GN_END
#endif
