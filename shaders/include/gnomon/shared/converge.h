// SPDX-License-Identifier: Apache-2.0
// A mask that is a mean over frames: how a frame joins those before it, and where they no longer count.
// Based on: D. Scherzer, M. Schwaerzler, O. Mattausch, M. Wimmer, "Real-Time Soft Shadows Using Temporal Coherence",
// ISVC 2009 (means of shadow tests over frames, each frame by another point of the light); D. Scherzer, S. Jeschke,
// M. Wimmer, "Pixel-Correct Shadow Maps with Temporal Reprojection and Shadow Test Confidence", EGSR 2007, section 4.3
// (a test counts for the more the nearer it is to its texel's centre).
// Departures: what moved objects can have changed is given up by their boxes, not found out from the shadows.
#ifndef GNOMON_CONVERGE_H
#define GNOMON_CONVERGE_H
#include "portability.h"
GN_BEGIN

// `before`: the mean of frames that weigh `count` together; `now`: one more, of this weight. With weights of 1 this is
// the arithmetic mean where the count grows with the frames, and an exponential one by 1 / (n + 1) where the count is
// held at n.
GN_FN real joinedMean(real before, real count, real now, real weight)
{
    return before + (now - before) * weight / (count + weight);
}

// How far a map's texel holds for a place in it, 0 .. 1: 1 at the texel's centre, where it was drawn, 0 at its rim.
// `place`: texel coordinates.
GN_FN real texelConfidence(real2 place)
{
    real2 off = abs(place - floor(place) - real(0.5));
    return real(1.0) - real(2.0) * max(off.x, off.y);
}

// By which power of that a frame counts, `stood` frames of the same before it: the higher, the less of a texel's blur
// is left, and the fewer frames count. `most`: kMostOfWholeLight where each of them sees all of the light, kMostOfPoint
// where it sees the light from one point, and many have to count for a penumbra. Chosen, see
// docs/techniques/converge.md.
GN_CONST real kMostOfWholeLight = real(8.0);
GN_CONST real kMostOfPoint = real(1.5);

GN_FN real confidencePower(real stood, real most)
{
    return most * min(stood / real(20.0), real(1.0));
}

// The weight of such a read. Its mean over a texel is 1.
GN_FN real frameWeight(real confidence, real power)
{
    return real(0.5) * (power + real(1.0)) * (power + real(2.0)) * pow(confidence, power);
}

// A visibility and its confidence in one number: v - 2 k, with the kth of these steps of confidence. A visibility
// without one is v itself. A k never makes the number larger, so that the least of all values drawn to a channel is the
// right one.
GN_CONST real kConfidences = real(8.0);

GN_FN real packSeen(real v, real confidence)
{
    return v -
           real(2.0) * (kConfidences - clamp(floor(confidence * kConfidences), real(0.0), kConfidences - real(1.0)));
}

// x: the visibility, y: what the frame weighs.
GN_FN real2 unpackSeen(real seen, real power)
{
    real k = floor((real(1.0) - seen) * real(0.5));
    real confidence = (kConfidences + real(0.5) - k) / kConfidences;
    return real2(seen + real(2.0) * k, k > real(0.0) ? frameWeight(confidence, power) : real(1.0));
}

// Weights of up to 64 in eight bits: by their square roots, so that small ones are told apart.
GN_FN real packCount(real count)
{
    return floor(sqrt(clamp(count, real(0.0), real(64.0)) / real(64.0)) * real(255.0) + real(0.5));
}
GN_FN real unpackCount(real packed)
{
    return packed * packed * (real(64.0) / (real(255.0) * real(255.0)));
}

// As how many frames those before count at most, under a camera that moves: the mean is then read between pixels in
// each frame, and each time blurred by some tenth of a pixel's square. `spread`: how far the pixels there are apart.
// Where that is little the shadow's edge is so wide that much blur is none. `least`: along the sharpest edges. Where
// each frame sees the light from one point, kLeastOfPoint still count. Where it sees all of the light, the frame itself
// is sharper than any mean: kLeastOfWholeLight.
GN_CONST real kLeastOfWholeLight = real(0.0);
GN_CONST real kLeastOfPoint = real(3.0);

GN_FN real mostInMotion(real spread, real least)
{
    real most = real(0.6) / max(spread * spread, real(1e-4));
    return clamp(most - real(0.2) * (kLeastOfPoint - least), least, real(15.0));
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
