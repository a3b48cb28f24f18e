// SPDX-License-Identifier: Apache-2.0
// Filterable maps with penumbrae as wide as the light's size and the mean depth of occluders say: as pcss, with moments
// in place of depths.
// Based on: B. Yang, Z. Dong, J. Feng, H.-P. Seidel, J. Kautz, "Variance Soft Shadow Mapping", Pacific Graphics 2010.
// With mean depth mu and visibility p of a receiver at depth d, occluders have the mean depth (mu - p d) / (1 - p).
// Departures:
//   (1) Both discs are cross-sections of the cone of rays to the light (light_cone.glsl), so in world units.
//   (2) Taps are not averaged before they are tested: each is tested alone, against the receiver's plane at its place.
//   Bounds of parts have a mean that is never above the bound of the whole, so less light bleeds; and a plane's slope
//   over the disc is no variance.
//   (3) A tap's occluders count only where the cone has come as far as the tap when it is as deep as they are. Taps of
//   the search are denser near the receiver, so that low casters are found beside high ones.
#ifndef GNOMON_MOMENT_PENUMBRA_GLSL
#define GNOMON_MOMENT_PENUMBRA_GLSL
#include "light_cone.glsl"
#include "msm.glsl"
#include "vsm.glsl"
GN_BEGIN

GN_CONST int kMomentSearchTaps = 16;
GN_CONST int kMomentTaps = 16;
// How far a read averages around its place, texels: its own kernel and some of the map's blur.
GN_CONST real kTapReach = real(1.5);
// Occluders lower than this, in widths of a texel, may be the receiver's own curvature.
GN_CONST real kLeastHeight = real(2.0);
// So small a share of a tap may be only the bound's slack, and its height means nothing.
GN_CONST real kLeastShare = real(0.1);

// The point of the receiver's plane that is at a place on the map, or at the nearest one within the tile. A plane is off
// by what its normal is, the more the farther away.
GN_FN MapPoint pointOnPlane(MapPoint point, FilterInput f, real level, real2 place)
{
    real2 texel = keepInside(place, level, f.tile);
    real2 at = texel - point.texel;
    real w = max(real(1.0) + dot(point.w_slope, at), real(0.05));
    MapPoint q = point;
    q.texel = texel;
    q.depth = (point.depth + dot(point.depth_slope, at)) / w - point.plane_doubt * (abs(at.x) + abs(at.y));
    q.depth_slope = point.depth_slope / w;
    q.w_slope = point.w_slope / w;
    return q;
}

GN_FN Occluders tapOccluders(int filter_number, MapPoint q, FilterInput f, FootprintReads reads)
{
    real4 stored = sampleMoments(q, f, f.layer, reads);
    Occluders o;
    if (filter_number == GNOMON_FILTER_MSM) {
        o = msmOccluders(q, f, reads, stored);
    } else {
        o = vsmOccluders(q, f, stored);
    }
    return o;
}

// Half the width on the map of the cone's cross-section at `s`, texels.
GN_FN real coneWidth(RayCone cone, MapPoint point, real s)
{
    real2 side = real2(cone.side_x.x, cone.side_x.y) - point.texel * cone.side_x.z;
    return length(side) * s / max(cone.start.z + cone.axis.z * s, real(0.5) * kRayEnd * cone.start.z);
}

// How far along the cone the mean occluder is; 0: there is none.
GN_FN real occluderReach(int filter_number, MapPoint point, FilterInput f, FootprintReads reads, RayCone cone, ConeNoise noise)
{
    real widest = coneReach(cone, real(0.0), kDiscEnd);
    real widest_texels = coneWidth(cone, point, widest);
    real sum = real(0.0);
    real found = real(0.0);
    int i = 0;
    do {
        real2 at = pointOfLight(noise, i, kMomentSearchTaps);
        real r2 = dot(at, at); // a share of the taps lies within it; they are moved to its square
        at = at * (r2 * length(at));
        MapPoint q = pointOnPlane(point, f, reads.level, coneTexel(cone, widest, at));
        Occluders o = tapOccluders(filter_number, q, f, reads);
        real depth = max(min(q.depth, real(1.0)) - o.height, real(0.0)); // nothing is drawn before 0
        real height = point.depth - depth;
        real here = coneWidth(cone, point, coneReach(cone, depth, kDiscEnd));
        bool counts = length(at) * widest_texels <= here * real(1.25) + kTapReach;
        counts = counts && height > kLeastHeight * point.texel_depth;
        // By the share of the light that a tap stands for: its ring's area, which grows with the third power, over that
        // of the cone where it is blocked.
        here = max(here, kTapReach);
        real share = counts ? max(o.share - kLeastShare, real(0.0)) * r2 * r2 * r2 / (here * here) : real(0.0);
        sum += share * height;
        found += share;
        ++i;
    } while (i < kMomentSearchTaps);
    return found > real(0.0) ? coneReach(cone, point.depth - sum / found, kDiscEnd) : real(0.0);
}

// vsm or msm: one tap, or with penumbra light a disc of them. One loop for both, so that a tap is compiled once.
GN_FN real applyMoments(int filter_number, MapPoint point, FilterInput f)
{
    bool follows_light = hasFlag(f.moments.flags, kMomentPenumbra);
    RayCone cone = rayCone(point, f);
    ConeNoise noise = coneNoise(noisePlace(f));
    FootprintReads reads = mapReads(f);
    real s = real(0.0);
    if (follows_light) {
        s = occluderReach(filter_number, point, f, reads, cone, noise);
    }
    int taps = follows_light ? kMomentTaps : 1;
    real lit = real(0.0);
    int i = 0;
    do {
        MapPoint q = point;
        bool faces = true;
        if (follows_light) {
            real2 at = pointOfLight(noise, i, kMomentTaps);
            q = pointOnPlane(point, f, reads.level, coneTexel(cone, s, at));
            faces = dot(cone.facing, real3(real(1.0), at.x, at.y)) > real(0.0);
        }
        real4 stored = sampleMoments(q, f, f.layer, reads);
        real v = real(1.0);
        if (filter_number == GNOMON_FILTER_MSM) {
            v = filterMsm(q, f, reads, stored);
        } else {
            v = filterVsm(q, f, stored);
        }
        lit += faces ? v : real(0.0);
        ++i;
    } while (i < taps);
    return lit / real(taps);
}

GN_END
#endif
