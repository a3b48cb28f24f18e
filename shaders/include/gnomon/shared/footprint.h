// SPDX-License-Identifier: Apache-2.0
// How far a pixel reaches on a map, and from that which mip level it reads and how often. Worked out here, not by the
// sampler, so that every device and the CPU's tests agree.
// Based on: L. Williams, "Pyramidal Parametrics", SIGGRAPH 1983 (levels); P. Heckbert, "Fundamentals of Texture Mapping
// and Image Warping", 1989, section 3.5 (a pixel's ellipse); J. McCormack, R. Perry, K. Farkas, N. Jouppi, "Feline:
// Fast Elliptical Lines for Anisotropic Texture Mapping", SIGGRAPH 1999 (reads along the ellipse's longer axis). We
// take the axes of the ellipse itself where samplers take the longer and the shorter of the two footprints, which blurs
// too much when both lie along the same diagonal.
#ifndef GNOMON_FOOTPRINT_H
#define GNOMON_FOOTPRINT_H
#include "portability.h"
GN_BEGIN

// An edge-on surface asks for infinitely many texels a pixel. No map is wider than this, so a longer footprint says no
// more; and its fourth power is still a float.
GN_CONST real kLongestFootprint = real(16384.0); // texels
GN_CONST int kMostReads = 16;

// Reads i = 0 .. reads - 1 are at step * (i + 0.5 - reads / 2) from the middle, each of them at `level`.
struct FootprintReads {
    int reads;
    real2 step; // texels
    real level;
};

// Finite; what is not a number is as wide as can be.
GN_FN real boundedTexels(real t)
{
    return t >= -kLongestFootprint ? min(t, kLongestFootprint) : -kLongestFootprint;
}
GN_FN real2 boundedFootprint(real2 t)
{
    return real2(boundedTexels(t.x), boundedTexels(t.y));
}

// (1) level = log2(texels that one read has to cover), in [0, coarsest].
GN_FN real levelOf(real texels, real coarsest)
{
    return clamp(log2(max(texels, real(1.0))), real(0.0), max(coarsest, real(0.0)));
}

// Isotropic: (2) the longer footprint decides, which blurs along the shorter one.
GN_FN real footprintLevel(real2 footprint_x, real2 footprint_y, real coarsest)
{
    real2 x = boundedFootprint(footprint_x);
    real2 y = boundedFootprint(footprint_y);
    return levelOf(sqrt(max(dot(x, x), dot(y, y))), coarsest);
}

// The pixel's unit circle becomes an ellipse whose half axes are the singular values of (x y): (3) the larger one
// squared is (a + c) / 2 + sqrt(((a - c) / 2)^2 + b^2) with ((a, b), (b, c)) = x x' + y y', and (4) the product of both
// is the determinant. Then (5) reads = ceil(major / minor), at most `most`; (6) each covers max(minor, major / reads)
// texels.
GN_FN FootprintReads footprintReads(real2 footprint_x, real2 footprint_y, real coarsest, real most)
{
    real2 x = boundedFootprint(footprint_x);
    real2 y = boundedFootprint(footprint_y);
    real a = x.x * x.x + y.x * y.x;
    real b = x.x * x.y + y.x * y.y;
    real c = x.y * x.y + y.y * y.y;
    real half_difference = real(0.5) * (a - c);
    real root = sqrt(half_difference * half_difference + b * b);
    real major = sqrt(real(0.5) * (a + c) + root);                     // (3)
    real minor = abs(x.x * y.y - x.y * y.x) / max(major, real(1e-10)); // (4)
    // Eigenvector of the larger eigenvalue; of its two expressions the one that does not cancel.
    real2 axis = half_difference >= real(0.0) ? real2(half_difference + root, b) : real2(b, root - half_difference);
    real norm = length(axis);
    axis = norm > real(0.0) ? axis / norm : real2(real(1.0), real(0.0));

    // A texel is the least that a read covers, so a footprint that is shorter needs no second one.
    real wanted = ceil(major / max(minor, real(1.0)) - real(1e-4)); // (5); no further read for rounding
    real reads = clamp(wanted, real(1.0), clamp(most, real(1.0), real(kMostReads)));
    FootprintReads r;
    r.reads = int(reads);
    r.step = axis * (major / reads);
    r.level = levelOf(max(minor, major / reads), coarsest); // (6)
    return r;
}

GN_END
#endif
