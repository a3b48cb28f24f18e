// SPDX-License-Identifier: Apache-2.0
// pcss: a disc of comparisons, as wide as the penumbra that follows from the blockers' mean depth.
// Based on: R. Fernando, "Percentage-closer soft shadows", NVIDIA, 2005. In world units: both discs are cross-sections
// of the cone of rays to the light, carried to the map by its own rows, so that a penumbra is as wide in every fit,
// cascade and size of a map. Departures: a texel counts as a blocker only where the cone has come as far as it when it
// is as deep; each comparison is with the receiver's plane at the texel's own centre; receivers that blocks
// (gnomon/shared/map_blocks.h) can decide are not searched.
#ifndef GNOMON_PCSS_GLSL
#define GNOMON_PCSS_GLSL
#include "cone_texels.glsl"
GN_BEGIN

GN_CONST int kSearchTaps = 16;
GN_CONST int kPcssTaps = 32;

// Depth of the texel at a place within the tile, and whether it can block.
GN_FN bool tapBlocks(MapPoint point, FilterInput f, real2 texel, GN_OUT(real) stored)
{
    real2 cell = texelInside(f, floor(texel));
    stored = mapTexel(cell, f.layer, f.part);
    return canBlock(point, f, cell, cell + real2(real(0.5)) - point.texel, stored);
}

// Mean depth of what may block, of which nothing is nearer than `nearest`; the receiver's own: there is nothing.
GN_FN real meanBlocker(MapPoint point, FilterInput f, RayCone cone, ConeNoise noise, real nearest)
{
    real widest = coneReach(cone, nearest, kDiscEnd);
    real sum = real(0.0);
    real found = real(0.0);
    int i = 0;
    do {
        real2 at = pointOfLight(noise, i, kSearchTaps);
        real stored = real(1.0);
        bool blocks = tapBlocks(point, f, coneTexel(cone, widest, at) + pointOfTexel(noise, i), stored);
        // At its depth the cone is narrower. A little wider counts, for texels are not points.
        real here = coneReach(cone, stored, kDiscEnd) * real(1.25);
        blocks = blocks && length(at) * widest <= max(here, real(0.1) * widest);
        sum += blocks ? stored : real(0.0);
        found += blocks ? real(1.0) : real(0.0);
        ++i;
    } while (i < kSearchTaps);
    return found > real(0.0) ? sum / found : point.depth;
}

GN_FN real filterPcss(MapPoint point, FilterInput f)
{
    RayCone cone = rayCone(point, f);
    Surroundings around = lookAround(point, f, cone, real(1.0), kDiscEnd);
    if (around.visibility >= real(0.0) || GNOMON_SETTLES) {
        return around.visibility;
    }
    ConeNoise noise = coneNoise(noisePlace(f));
    real blocker = meanBlocker(point, f, cone, noise, around.nearest);
    real s = coneReach(cone, blocker, kDiscEnd);
    real lit = real(0.0);
    int i = 0;
    do {
        real2 at = pointOfLight(noise, i, kPcssTaps);
        real stored = real(1.0);
        bool blocks = tapBlocks(point, f, coneTexel(cone, s, at) + pointOfTexel(noise, i), stored);
        bool faces = dot(cone.facing, real3(real(1.0), at.x, at.y)) > real(0.0);
        lit += faces && !blocks ? real(1.0) : real(0.0);
        ++i;
    } while (i < kPcssTaps);
    return lit / real(kPcssTaps);
}

GN_END
#endif
