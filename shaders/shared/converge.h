// SPDX-License-Identifier: Apache-2.0
// A mask that is a mean over frames: how a frame joins those before it, and where they no longer count.
// Based on: D. Scherzer, M. Schwaerzler, O. Mattausch, M. Wimmer, "Real-Time Soft Shadows Using Temporal Coherence",
// ISVC 2009 (means of shadow tests over frames, each frame by another point of the light).
// Departure: what moved objects can have changed is given up by their boxes, not found out from the shadows.
#ifndef GNOMON_CONVERGE_H
#define GNOMON_CONVERGE_H
#include "portability.h"
GN_BEGIN

// `before`: the mean of `count` frames, or of what counts as so many; `now`: one more. Where the count grows with the
// frames this is their arithmetic mean; where it is held at n, an exponential one by 1 / (n + 1).
GN_FN real joinedMean(real before, real count, real now)
{
    return before + (now - before) / (count + real(1.0));
}

// As how many frames those before count at most, under a camera that moves: the mean is then read between pixels in
// each frame, and each time blurred by some tenth of a pixel's square. `spread`: how far the pixels there are apart.
// Where that is little the shadow's edge is so wide that much blur is none.
GN_FN real mostInMotion(real spread)
{
    return clamp(real(0.6) / max(spread * spread, real(1e-4)), real(3.0), real(15.0));
}

// Weights of the four pixels around a place `part` of the way from the second to the third; they add up to 1. Straight
// lines and parabolas stay as they are (E. Catmull, R. Rom, "A Class of Local Interpolating Splines", 1974).
GN_FN real4 cubicWeights(real part)
{
    real p = part;
    real a = p * (real(-0.5) + p * (real(1.0) - real(0.5) * p));
    real b = real(1.0) + p * p * (real(-2.5) + real(1.5) * p);
    real c = p * (real(0.5) + p * (real(2.0) - real(1.5) * p));
    real d = p * p * (real(-0.5) + real(0.5) * p);
    return real4(a, b, c, d);
}

// Cosine of how far two frames' normals of one surface may be apart: those of a curved surface differ between pixels.
GN_CONST real kSameFacing = real(0.9);

// May what lies in a box have thrown a shadow on p, or hold it? The light is as GpuLight::place has it: w = 0: xyz is
// the unit direction to it, w = 1: its place. `size`: as GpuLight::size.x. The way from p to any of the light's points
// is within the box's own way if the box is as much larger as the light looks wide beside it. `pad`: how far beside a
// caster a filter can be dark.
GN_FN bool mayShadow(real3 centre, real3 extent, real3 p, real4 place, real size, real pad)
{
    real3 to_box = centre - p;
    real3 way = real3(place) - p * place.w;
    real far = place.w > real(0.0) ? real(1.0) : length(to_box) + length(extent);
    real3 reach = extent + (pad + size * far);
    // The way meets each pair of the box's sides between two places; w = 1: 1 is at the light.
    real least = real(1e-20);
    real3 safe = real3(abs(way.x) > least ? way.x : least, abs(way.y) > least ? way.y : least,
                       abs(way.z) > least ? way.z : least);
    real3 a = (to_box - reach) / safe;
    real3 b = (to_box + reach) / safe;
    real3 enter = min(a, b);
    real3 leave = max(a, b);
    real first = max(max(enter.x, enter.y), max(enter.z, real(0.0)));
    real last = min(leave.x, min(leave.y, leave.z));
    return first <= last && (place.w == real(0.0) || first <= real(1.0));
}

GN_END
#endif
