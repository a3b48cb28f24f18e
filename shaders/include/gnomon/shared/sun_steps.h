// SPDX-License-Identifier: Apache-2.0
// A sun that moves in steps: what is seen by maps of two of its positions becomes one visibility.
// Based on: P. Fortier, "Shadow maps for moving light sources", IceFall Games, 2010.
#ifndef GNOMON_SUN_STEPS_H
#define GNOMON_SUN_STEPS_H
#include "portability.h"
GN_BEGIN

// How much the later position counts, 0 .. 1, at x of the picture (0: its left edge, 1: its right one). `steps`: x: the
// share of the way that the sun has gone; y: the band's right end and z: one over its width, both in shares of the
// picture's width, or z = 0: there is no band, and the share is the same all over; w: 1: by a cubic, 0: linear.
GN_FN real stepWeight(real4 steps, real x)
{
    real a = steps.x;
    if (steps.z > real(0.0))
        a = clamp((steps.y - x) * steps.z, real(0.0), real(1.0));
    return steps.w > real(0.0) ? a * a * (real(3.0) - real(2.0) * a) : a;
}

// Visibilities by the earlier and the later position.
GN_FN real steppedVisibility(real earlier, real later, real weight)
{
    return earlier + (later - earlier) * weight;
}
// The same of each colour.
GN_FN real4 steppedVisibility(real4 earlier, real4 later, real weight)
{
    return real4(steppedVisibility(earlier.x, later.x, weight), steppedVisibility(earlier.y, later.y, weight),
                 steppedVisibility(earlier.z, later.z, weight), steppedVisibility(earlier.w, later.w, weight));
}

// Where this frame has the one position and the frame before had the other (step-alternate): how much the frame before
// counts. `weight`: stepWeight(); `read_later`: 1 where this frame has the later position, else 0.
GN_FN real weightOfBefore(real weight, real read_later)
{
    return weight + read_later * (real(1.0) - real(2.0) * weight);
}

// Distances from the eye that two frames have for one surface differ by this share at most: by their pixels' own
// extent. A surface that was hidden is farther than what hid it, as a rule by more.
GN_CONST real kSameSurface = real(0.03);

GN_FN bool isSameSurface(real found, real expected)
{
    return abs(found - expected) <= kSameSurface * expected;
}

GN_END
#endif
