// SPDX-License-Identifier: Apache-2.0
// Point sets in the unit disc, and the per-pixel rotation that turns their banding into noise.
#ifndef GNOMON_DISCS_H
#define GNOMON_DISCS_H
#include "portability.h"
GN_BEGIN

// Sunflower spiral: point `i` of `count`, evenly dense for any count.
// Based on: H. Vogel, "A better way to construct the sunflower head", Mathematical Biosciences, 1979.
GN_FN real2 vogelPoint(int i, int count)
{
    real radius = sqrt((real(i) + real(0.5)) / real(count));
    real angle = real(i) * real(2.39996323); // the golden angle
    return real2(radius * cos(angle), radius * sin(angle));
}

// Blue-noise points, the first n of which are spread out for any n: each is the farthest from those before it among
// 2000 candidates (D. Mitchell, "Spectrally optimal sampling for distribution ray tracing", SIGGRAPH 1991). C++ only:
// shaders get them in a table, because a large constant array takes some compilers seconds.
#ifdef __cplusplus
// clang-format off
inline constexpr real2 kPoissonPoints[64] = {
    real2(real(0.016), real(0.0088)), real2(real(-0.7738), real(-0.2863)),
    real2(real(0.0931), real(-0.7907)), real2(real(-0.1526), real(0.7683)),
    real2(real(0.5869), real(0.5098)), real2(real(0.6942), real(-0.3184)),
    real2(real(-0.7031), real(0.3957)), real2(real(-0.4716), real(-0.7207)),
    real2(real(-0.4308), real(0.0302)), real2(real(0.8328), real(0.1315)),
    real2(real(0.2439), real(-0.3686)), real2(real(-0.2153), real(-0.3631)),
    real2(real(0.1338), real(0.4334)), real2(real(0.4996), real(-0.7162)),
    real2(real(0.4324), real(0.0419)), real2(real(0.2633), real(0.8389)),
    real2(real(-0.2834), real(0.397)), real2(real(-0.5101), real(0.7467)),
    real2(real(-0.7948), real(0.0627)), real2(real(-0.2003), real(-0.8921)),
    real2(real(-0.5309), real(-0.4422)), real2(real(0.9157), real(-0.1389)),
    real2(real(0.0075), real(-0.5263)), real2(real(0.387), real(0.3082)),
    real2(real(0.8306), real(0.4022)), real2(real(0.4567), real(-0.2183)),
    real2(real(-0.0792), real(0.2406)), real2(real(0.5194), real(0.7699)),
    real2(real(0.3403), real(0.5809)), real2(real(0.7225), real(-0.5706)),
    real2(real(-0.207), real(-0.1132)), real2(real(0.02), real(-0.2624)),
    real2(real(-0.2323), real(-0.6068)), real2(real(0.6759), real(-0.0647)),
    real2(real(-0.5124), real(-0.1978)), real2(real(-0.7027), real(-0.6192)),
    real2(real(0.2265), real(-0.1246)), real2(real(0.2582), real(-0.6151)),
    real2(real(0.4685), real(-0.4716)), real2(real(0.0755), real(0.6769)),
    real2(real(0.1949), real(0.1671)), real2(real(0.6256), real(0.2659)),
    real2(real(0.0266), real(0.9174)), real2(real(-0.0809), real(0.5089)),
    real2(real(-0.4966), real(0.2675)), real2(real(0.3138), real(-0.8755)),
    real2(real(-0.5098), real(0.5173)), real2(real(-0.8779), real(0.287)),
    real2(real(-0.9323), real(-0.1167)), real2(real(-0.6949), real(0.6317)),
    real2(real(-0.3054), real(0.618)), real2(real(-0.3221), real(0.883)),
    real2(real(-0.2235), real(0.0992)), real2(real(-0.6845), real(-0.1011)),
    real2(real(-0.609), real(0.077)), real2(real(0.887), real(-0.3256)),
    real2(real(-0.0826), real(-0.6996)), real2(real(-0.014), real(-0.9395)),
    real2(real(-0.8207), real(-0.4614)), real2(real(-0.7143), real(0.2225)),
    real2(real(0.6016), real(0.0923)), real2(real(0.7457), real(0.5878)),
    real2(real(-0.3878), real(-0.3239)), real2(real(-0.3744), real(-0.8755))};
// clang-format on
#endif

// A number in [0, 1) per pixel, spread so that every 3 x 3 neighbourhood has all ninths.
// Based on: J. Jimenez, "Next Generation Post Processing in Call of Duty: Advanced Warfare", SIGGRAPH 2014.
GN_FN real interleavedGradientNoise(real2 pixel)
{
    return fract(real(52.9829189) * fract(dot(pixel, real2(real(0.06711056), real(0.00583715)))));
}

GN_END
#endif
