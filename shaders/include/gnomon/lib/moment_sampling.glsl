// SPDX-License-Identifier: Apache-2.0
// A filterable map at a receiver: nearest, bilinear, trilinear or anisotropic, by f.moments.sampling. Never reads a
// texel of another tile.
#ifndef GNOMON_MOMENT_SAMPLING_GLSL
#define GNOMON_MOMENT_SAMPLING_GLSL
#include "../shared/choice_numbers.h"
#include "../shared/footprint.h"
#include "filter_types.glsl"
GN_BEGIN

// Half a texel of the coarser level that the read blends in, inside of the tile; its middle where it is narrower.
GN_FN real2 keepInside(real2 texel, real level, real4 tile)
{
    real inset = real(0.5) * exp2(ceil(level));
    real2 first = real2(tile.x, tile.y);
    real2 last = real2(tile.z, tile.w);
    real2 middle = real(0.5) * (first + last);
    return clamp(texel, min(first + real2(inset), middle), max(last - real2(inset), middle));
}

GN_FN real4 readMoments(real2 texel, real level, FilterInput f, real layer)
{
    return mapMoments(keepInside(texel, level, f.tile), level, layer);
}

// The reads of a map that f.moments.sampling asks for: several only where it is anisotropic.
GN_FN FootprintReads mapReads(FilterInput f)
{
    if (f.moments.sampling > kSamplingTrilinear)
        return footprintReads(f.footprint_x, f.footprint_y, f.coarsest, f.moments.anisotropy);
    FootprintReads one;
    one.reads = 1;
    one.step = real2(real(0.0));
    one.level = f.moments.sampling == kSamplingTrilinear ? footprintLevel(f.footprint_x, f.footprint_y, f.coarsest)
                                                         : real(0.0);
    return one;
}

GN_FN real4 sampleMoments(MapPoint point, FilterInput f, real layer, FootprintReads reads)
{
    bool nearest = f.moments.sampling == kSamplingNearest;
    real2 texel = nearest ? floor(point.texel) + real2(real(0.5)) : point.texel;
    real4 sum = real4(real(0.0));
    for (int i = 0; i < reads.reads; ++i) {
        real2 offset = reads.step * (real(i) + real(0.5) - real(0.5) * real(reads.reads));
        sum += readMoments(texel + offset, reads.level, f, layer);
    }
    return sum / real(reads.reads);
}

GN_FN real4 sampleMoments(MapPoint point, FilterInput f, real layer)
{
    return sampleMoments(point, f, layer, mapReads(f));
}

GN_END
#endif
