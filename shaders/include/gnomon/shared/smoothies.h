// SPDX-License-Identifier: Apache-2.0
// Smoothies: edges of casters, made wide beside their map, by which a lit receiver knows how far it is from a shadow's
// edge and what casts it. They lie outside of the shadow, so its umbra stays as large as that of a point light.
// Based on: E. Chan, F. Durand, "Rendering Fake Soft Shadows with Smoothies", EGSR 2003; W. de Boer, "Smooth Penumbra
// Transitions with Shadow Maps", 2006, which finds the edges in the map.
// Departure: both widen every edge by one width that a user sets, and shrink it by 1 - b / r, b and r being the light's
// distances to caster and receiver. Here the width follows from the light's size, as it lies on the map.
#ifndef GNOMON_SMOOTHIES_H
#define GNOMON_SMOOTHIES_H
#include "portability.h"
GN_BEGIN

// Texels that an edge is widened by at most.
GN_CONST int kMostSmoothieReach = 32;
GN_CONST int kNoSmoothie = 0xffff;
// Distances are stored in steps of a 1024th of a texel: 45 texels, the farthest along a diagonal, are 46340.
GN_CONST real kSmoothieSteps = real(1024.0);

// The smoothie beside a texel of a map, packed: in the low 16 bits the depth of the caster that has the edge, in the
// high ones how far the edge is from the texel's centre.
struct Smoothie {
    real depth;    // in the map's metric
    real distance; // texels; negative: there is no edge
};

GN_FN int packSmoothie(Smoothie s)
{
    int far = s.distance < real(0.0) ? kNoSmoothie : int(s.distance * kSmoothieSteps + real(0.5));
    int near = int(min(max(s.depth, real(0.0)), real(1.0)) * real(65535.0) + real(0.5));
    return near | (far << 16);
}

GN_FN Smoothie unpackSmoothie(int both)
{
    int far = (both >> 16) & 0xffff;
    Smoothie s;
    s.depth = real(both & 0xffff) / real(65535.0);
    s.distance = far == kNoSmoothie ? real(-1.0) : real(far) / kSmoothieSteps;
    return s;
}

// Is there an edge between a texel and the next one, which is farther away? `before`: the texel on the other side of
// it, `beyond`: the one after the next. A surface that leans goes on leaning on one side at least; an edge falls by
// more than either side leans. `quantum`: what stored depths may be off by.
GN_FN bool isEdge(real before, real here, real next, real beyond, real quantum)
{
    real leans = max(abs(here - before), abs(beyond - next));
    return next - here > real(2.0) * leans + real(2.0) * quantum;
}

// The distance from a texel's centre to an edge whose caster's last texel is (dx, dy) texels away: to the caster's
// rim, which is half a texel nearer.
GN_FN real edgeDistance(real dx, real dy)
{
    return max(sqrt(dx * dx + dy * dy) - real(0.5), real(0.0));
}

// Does an edge matter more to a surface than another edge? It does where it cuts off light at the greater angle.
// Without an edge the fall is 0.
GN_FN bool outweighs(real distance, real fall, real other_distance, real other_fall)
{
    return distance * other_fall < other_distance * fall;
}

// alpha' of Chan and Durand, section 3.2: visibility at `distance` texels outside of a shadow whose penumbra is `width`
// texels wide there, on its outer side. No edge is wider than it was made.
GN_FN real smoothieAlpha(real distance, real width, real reach)
{
    real within = min(width, reach);
    return distance >= within ? real(1.0) : distance / within;
}

GN_END
#endif
