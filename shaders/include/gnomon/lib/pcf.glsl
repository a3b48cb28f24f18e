// SPDX-License-Identifier: Apache-2.0
// pcf: the share of texels around the receiver that light it.
// Based on: W. Reeves, D. Salesin, R. Cook, "Rendering Antialiased Shadows with Depth Maps", SIGGRAPH 1987.
#ifndef GNOMON_PCF_GLSL
#define GNOMON_PCF_GLSL
#include "../shared/discs.h"
#include "../shared/pcf_weights.h"
#include "filter_types.glsl"
GN_BEGIN

// A separable kernel of width x width bilinear taps (width 1: the plain 2 x 2 blend). Neighbouring taps share texels, so
// that (width + 1)^2 comparisons, fetched by ((width + 1) / 2)^2 gathers, do the work of 4 width^2.
GN_FN real pcfSeparable(MapPoint point, FilterInput f)
{
    int half_width = (f.kernel_width - 1) / 2;
    real2 shifted = point.texel - real2(real(0.5));
    real2 cell = floor(shifted);
    real2 part = shifted - cell;
    real sum = real(0.0);
    for (int j = 0; j <= half_width; ++j) {
        real y0 = texelWeight(f.kernel, f.kernel_width, 2 * j, part.y);
        real y1 = texelWeight(f.kernel, f.kernel_width, 2 * j + 1, part.y);
        for (int i = 0; i <= half_width; ++i) {
            real x0 = texelWeight(f.kernel, f.kernel_width, 2 * i, part.x);
            real x1 = texelWeight(f.kernel, f.kernel_width, 2 * i + 1, part.x);
            real2 first = real2(real(2 * i - half_width), real(2 * j - half_width));
            real4 stored = storedMetric(f, mapGather(cell + first + real2(real(1.0)), f.layer, f.part));
            real4 lit = compareGather(point, first - part, stored);
            sum += dot(lit, real4(x0 * y1, x1 * y1, x1 * y0, x0 * y0));
        }
    }
    return sum;
}

GN_FN real pcfBilinear(MapPoint point, real2 offset, FilterInput f)
{
    real2 shifted = point.texel + offset - real2(real(0.5));
    real2 cell = floor(shifted);
    real2 part = shifted - cell;
    real4 lit = compareGather(point, offset - part, storedMetric(f, mapGather(cell + real2(real(1.0)), f.layer, f.part)));
    return mix(mix(lit.w, lit.z, part.x), mix(lit.x, lit.y, part.x), part.y);
}

// Bilinear taps in a disc that is turned by a different angle at every pixel.
GN_FN real pcfDisc(MapPoint point, FilterInput f)
{
    real angle = interleavedGradientNoise(noisePlace(f)) * real(6.2831853);
    real2 turn = real2(cos(angle), sin(angle)) * f.disc_radius;
    real sum = real(0.0);
    for (int i = 0; i < f.disc_taps; ++i) {
        real2 at = discPoint(i);
        real2 turned = real2(at.x * turn.x - at.y * turn.y, at.x * turn.y + at.y * turn.x);
        sum += pcfBilinear(point, turned, f);
    }
    return sum / real(f.disc_taps);
}

// Nine point samples of one weight, not blended.
// Based on: A. S. Shastry, "Soft-Edged Shadows", 2005.
GN_FN real pcfPoints(MapPoint point, FilterInput f)
{
    real spread = pointSpread(f.kernel_width, point.w);
    real sum = real(0.0);
    for (int i = 0; i < 9; ++i) {
        real2 offset = real2(real(i % 3 - 1), real(i / 3 - 1)) * spread;
        real2 texel = floor(point.texel + offset);
        real stored = storedMetric(f, real4(mapTexel(texel, f.layer, f.part))).x;
        sum += compareTexel(point, texel + real2(real(0.5)) - point.texel, stored);
    }
    return sum / real(9.0);
}

GN_FN real filterPcf(MapPoint point, FilterInput f)
{
    if (f.kernel_width < 0) {
        return pcfPoints(point, f);
    }
    return f.kernel_width > 0 ? pcfSeparable(point, f) : pcfDisc(point, f);
}

GN_END
#endif
