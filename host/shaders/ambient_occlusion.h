// SPDX-License-Identifier: Apache-2.0
// The share of the sky's light that reaches a point between surfaces of the picture. Based on: J. Jimenez, X. Wu, A.
// Pesce, A. Jarabo, "Practical Realtime Strategies for Accurate Indirect Occlusion", 2016: along slices through the
// view direction the highest thing to both sides (horizon) is searched, the light between the two is integrated in
// closed form with its cosine, and light that bounces is a polynomial in the albedo. S. Lagarde, C. de Rousiers,
// "Moving Frostbite to Physically Based Rendering", 2014 (specular occlusion). Both GLSL and C++.
//
// One departure: a slice is divided by its light without occluders, where the article divides all slices by their
// number. The limit is the same, and a plane is 1 in every slice, however few there are.
#ifndef GNOMON_AMBIENT_OCCLUSION_H
#define GNOMON_AMBIENT_OCCLUSION_H
#include "gnomon/shared/portability.h"
GN_BEGIN
#ifdef __cplusplus
using glm::acos, glm::atan;
#endif

GN_CONST real kOcclusionHalfPi = real(1.57079632679489662);
GN_CONST real kOcclusionWhole = real(0.5);      // share of the radius within which an occluder counts in full
GN_CONST real kOcclusionThickness = real(0.05); // how fast a horizon sinks again behind a thin thing, per step
GN_CONST int kOcclusionSlices = 2;              // slices of a pixel, at right angles
GN_CONST int kOcclusionSteps = 8;               // steps of a slice, to each side

// Which way the first slice of a pixel goes (x, in quarter turns) and how far its steps are shifted (y, in steps).
// Every 4 x 4 pixels have 16 directions, so a mean over as many has no pattern left.
GN_FN real2 occlusionPattern(int x, int y)
{
    int direction = (((x + y) & 3) << 2) + (x & 3);
    return real2(real(direction) / real(16.0), (real((y - x) & 3) + real(0.5)) / real(4.0));
}

// How much an occluder counts at this distance, so that it does not end abruptly at the radius.
GN_FN real occluderWeight(real distance, real radius)
{
    return clamp((radius - distance) / (radius * (real(1.0) - kOcclusionWhole)), real(0.0), real(1.0));
}

// The highest cosine to the view direction after one more sample of this cosine. A lower sample lets the horizon sink,
// because the thing before it may be thin.
GN_FN real raisedHorizon(real horizon, real cosine, real thickness)
{
    return cosine > horizon ? cosine : mix(horizon, cosine, thickness);
}

// Where a surface itself ends a slice: the cosine of the angle between it and the view direction, to the side that
// `along` is positive on. `along`, `up`: the normal's components along the slice and along the view direction.
GN_FN real ownHorizon(real along, real up)
{
    return -along / max(sqrt(along * along + up * up), real(1e-6));
}

// The cosine to the view direction of a sample that rises above the surface. `own`: ownHorizon(); `rise`: the cosine
// between normal and the way to the sample, over the length of the normal's part in the slice. Samples lie at middles
// of pixels and so beside their slice. Their rise, unlike their place, puts samples of a plane on its horizon.
GN_FN real risenHorizon(real own, real rise)
{
    real up = clamp(rise, real(0.0), real(1.0));
    return own * sqrt(real(1.0) - up * up) + sqrt(max(real(1.0) - own * own, real(0.0))) * up;
}

// Equation 7: light between the view direction and a horizon, both as signed angles in the slice; `gamma`: the
// normal's.
GN_FN real arcLight(real horizon, real gamma)
{
    return real(0.25) * (cos(gamma) - cos(real(2.0) * horizon - gamma) + real(2.0) * horizon * sin(gamma));
}

// The light that one slice receives (x), and its light without occluders (y). `along` and `up` are as in ownHorizon();
// `cosines` are those of the horizons to the positive (x) and negative side (y).
GN_FN real2 sliceLight(real along, real up, real2 cosines)
{
    real part = sqrt(along * along + up * up);
    real gamma = atan(along, up);
    real after = min(acos(clamp(cosines.x, real(-1.0), real(1.0))), gamma + kOcclusionHalfPi);
    real before = max(-acos(clamp(cosines.y, real(-1.0), real(1.0))), gamma - kOcclusionHalfPi);
    real whole = cos(gamma) + gamma * sin(gamma);
    return part * real2(arcLight(after, gamma) + arcLight(before, gamma), whole);
}

// Light that bounces between surfaces of one albedo before it is gone: a fit to path tracing, of each colour.
GN_FN real bouncedOcclusion(real seen, real albedo)
{
    real a = real(2.0404) * albedo - real(0.3324);
    real b = real(-4.7951) * albedo + real(0.6417);
    real c = real(2.7552) * albedo + real(0.6903);
    return max(seen, ((seen * a + b) * seen + c) * seen);
}

// The share of mirrored light: a smooth surface sees a small part of the sky, a rough one nearly all. `n_v`: cosine
// between normal and view direction.
GN_FN real specularOcclusion(real seen, real n_v, real roughness)
{
    real power = exp2(real(-16.0) * roughness - real(1.0));
    return clamp(pow(n_v + seen, power) - real(1.0) + seen, real(0.0), real(1.0));
}

GN_END
#endif
