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

// The level of each of sampleMoments()' reads.
GN_FN real samplingLevel(FilterInput f)
{
    if (f.moments.sampling < kSamplingTrilinear)
        return real(0.0);
    if (f.moments.sampling == kSamplingTrilinear)
        return footprintLevel(f.footprint_x, f.footprint_y, f.coarsest);
    return footprintReads(f.footprint_x, f.footprint_y, f.coarsest, f.moments.anisotropy).level;
}

// `level`: samplingLevel().
GN_FN real4 sampleMoments(MapPoint point, FilterInput f, real layer, real level)
{
    if (f.moments.sampling <= kSamplingTrilinear) {
        bool nearest = f.moments.sampling == kSamplingNearest;
        real2 texel = nearest ? floor(point.texel) + real2(real(0.5)) : point.texel;
        return readMoments(texel, level, f, layer);
    }
    FootprintReads r = footprintReads(f.footprint_x, f.footprint_y, f.coarsest, f.moments.anisotropy);
    real4 sum = real4(real(0.0));
    for (int i = 0; i < r.reads; ++i) {
        real2 offset = r.step * (real(i) + real(0.5) - real(0.5) * real(r.reads));
        sum += readMoments(point.texel + offset, level, f, layer);
    }
    return sum / real(r.reads);
}

GN_FN real4 sampleMoments(MapPoint point, FilterInput f, real layer)
{
    return sampleMoments(point, f, layer, samplingLevel(f));
}

GN_END
#endif
