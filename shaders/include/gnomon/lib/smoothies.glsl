// SPDX-License-Identifier: Apache-2.0
// The visibility of a receiver by the smoothies beside a map (gnomon/shared/smoothies.h). The includer defines, besides
// the functions of filter_types.glsl:
//   int mapSmoothie(real2 texel, real layer); // texel: integer coordinates; packed
#ifndef GNOMON_SMOOTHIES_GLSL
#define GNOMON_SMOOTHIES_GLSL
#include "../shared/smoothies.h"
#include "light_cone.glsl"
GN_BEGIN

// Texels from the middle of the light's cone to its rim where a caster at `depth` cuts it: of a map that is not as fine
// along x as along y, the geometric mean.
GN_FN real coneRadius(RayCone cone, real depth)
{
    real s = coneReach(cone, depth, kDiscEnd);
    real2 middle = coneTexel(cone, s, real2(real(0.0)));
    real2 x = coneTexel(cone, s, real2(real(1.0), real(0.0))) - middle;
    real2 y = coneTexel(cone, s, real2(real(0.0), real(1.0))) - middle;
    return sqrt(max(abs(x.x * y.y - x.y * y.x), real(0.0)));
}

// Averages the four texels around a receiver: alpha' of the lit ones. Texels in shadow lie within the edge and count as
// 0. Where the penumbra is narrower than a texel they do not show it, and only the lit ones count. The includer takes
// the filter's own answer where that is less, so this can only take light away.
GN_FN real smoothieVisibility(MapPoint point, FilterInput f)
{
    RayCone cone = rayCone(point, f);
    real2 shifted = point.texel - real2(real(0.5));
    real2 cell = floor(shifted);
    real2 fraction = shifted - cell;
    real sum = real(0.0);
    real of_lit = real(0.0);
    real widths = real(0.0); // sum of penumbra widths, texels, each at most 1
    for (int i = 0; i < 4; ++i) {
        real2 at = real2(real(i & 1), real(i >> 1));
        real2 texel = cell + at;
        Smoothie s = unpackSmoothie(mapSmoothie(texel, f.layer));
        // A caster that does not rise over the receiver's plane, in whichever direction the edge lies, takes no light
        // from it.
        real rises = length(point.depth_slope) * s.distance;
        bool before = s.distance >= real(0.0) && s.depth + rises < point.depth;
        real width = before ? coneRadius(cone, s.depth) : real(0.0);
        real2 weights = mix(real2(real(1.0)) - fraction, fraction, at);
        real weight = weights.x * weights.y * compareTexel(point, at - fraction, mapTexel(texel, f.layer, f.part));
        sum += weight * (before ? smoothieAlpha(s.distance, width, f.smoothies) : real(1.0));
        of_lit += weight;
        widths += weight * min(width, real(1.0));
    }
    real within = of_lit > real(0.0) ? sum / of_lit : real(1.0);
    return mix(within, sum, of_lit > real(0.0) ? widths / of_lit : real(0.0));
}

GN_END
#endif
