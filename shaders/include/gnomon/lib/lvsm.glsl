// SPDX-License-Identifier: Apache-2.0
// lvsm: vsm in layers of depth, each with its own metric and moments. A receiver reads its own layer only, where every
// caster of nearer layers is at 0: whatever lies between them leaves no variance through which light could bleed.
// Based on: A. Lauritzen, M. McCool, "Layered Variance Shadow Maps", Graphics Interface 2008; A. Marinescu, "Achieving
// real-time soft shadows using LVSM in an RTS game", 2011.
#ifndef GNOMON_LVSM_GLSL
#define GNOMON_LVSM_GLSL
#include "../shared/moments.h"
#include "moment_sampling.glsl"
GN_BEGIN

GN_FN real filterLvsm(MapPoint point, FilterInput f)
{
    int flags = f.moments.flags;
    real d = receiverDepth(point.depth, flags, f.near_over_far);
    int held = 0;
    real4 layer = mapDepthLayer(f.slot, 0);
    for (int i = 1; i < f.moments.layers; ++i) {
        real4 next = mapDepthLayer(f.slot, i);
        bool here = beginsBefore(next, d);
        held = here ? i : held;
        layer = here ? next : layer;
    }
    // Two layers share a texel; both are fetched by the one read.
    int image_layers = (f.moments.layers + 1) / 2;
    real4 m = sampleMoments(point, f, f.layer * real(image_layers) + real(held / 2));
    real2 own = (held & 1) == 0 ? real2(m.x, m.y) : real2(m.z, m.w);

    real t = momentCoordinate(layerMetric(d, layer), flags);
    real stretch = metricStretch(point.depth, flags, f.near_over_far) / max(layer.y - layer.x, real(1e-6));
    real least = leastVariance(f.moments, point.texel_depth, stretch);
    real bound = chebyshevBound(own.x, own.y, t, least);
    real first = momentCoordinate(real(0.0), flags);
    bound = min(bound, markovBound(own.x - first, t - first, f.moments.min_variance));
    return shapeVisibility(bound, f.moments);
}

GN_END
#endif
