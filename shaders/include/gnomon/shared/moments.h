// SPDX-License-Identifier: Apache-2.0
// Two moments of depth, the bound on visibility that they give, and what is done to a visibility afterwards.
// Based on: W. Donnelly, A. Lauritzen, "Variance Shadow Maps", I3D 2006; A. Lauritzen, "Summed-Area Variance Shadow
// Maps", GPU Gems 3, chapter 8, 2007 (derivatives, linear step); A. Lauritzen, M. McCool, "Layered Variance Shadow
// Maps", Graphics Interface 2008; A. Marinescu, "Achieving real-time soft shadows using LVSM in an RTS game", 2011
// (power).
#ifndef GNOMON_MOMENTS_H
#define GNOMON_MOMENTS_H
#include "depth_layers.h"
#include "moment_rule.h"
GN_BEGIN

// How rounding disturbs M2 - M1^2. Let `step` be the spacing of a format's numbers just below 1: 1 / 65535 at 16-bit
// unorm, 2^-11 at half and 2^-24 at single precision. Errors e1 and e2 of the moments, |M1| <= 1, change the variance
// by (e2 - 2 M1 e1 - e1^2). To the nearest number, |e| <= step / 2: at most 3/2 steps are lost. Towards zero, which
// Vulkan allows for floats, -step < e <= 0: e2 loses one step and e1 loses nothing. So one rounding loses at most 3/2
// steps. An average is off by no more than what is averaged, so errors add up over the passes: two that write a
// blurred map, and one that is allowed for. (Mip levels round again, but average away what was rounded before.) An
// interpolated pair has the same weights for both moments, so whatever their precision, it stays a pair of moments. A
// least variance as large as all that can be lost, E, never leaves less than half of the true variance v, because max(v
// - E, E) >= v / 2; and what rounding may add is at most 4/3 E.
GN_CONST int kMomentRoundings = 3;
// Single precision arithmetic of blur and interpolation on top: sums of 9 to 63 products err by some 2^-24 each, and so
// do weights that should sum to 1.
GN_CONST real kMomentArithmetic = real(0.000001);

// The least variance that hides rounding, in squares of the coordinate that is stored: 7.0e-5 at 16-bit unorm, 2.2e-3
// at half and 1.3e-6 at single precision. In squares of d', divide by momentScale()^2: remapped, a half needs 5.5e-4.
GN_FN real varianceOfRounding(real step_of_format)
{
    return real(1.5) * real(kMomentRoundings) * step_of_format + kMomentArithmetic;
}

// The same where moments of w = exp(c x) are stored, c > 0, as a share of M2: floats err in proportion to what they
// hold, just above a power of two by twice as much.
GN_FN real shareOfWarpRounding(real step_of_format)
{
    return varianceOfRounding(real(2.0) * step_of_format);
}

// And where their logarithms are, as log(M1) / c and log(M2) / (2 c): errors e1, e2 of these change M1^2 and M2 by the
// factors e^(2 c e1) and e^(2 c e2), which to the first order loses 2 c (e2 - e1) M2: 4/3 c of the 3/2 steps above.
GN_FN real shareOfLogRounding(real step_of_format, real c)
{
    return varianceOfRounding(step_of_format) * c * real(4.0) / real(3.0);
}

// A variance that rounding of the arithmetic itself cannot tell from 0, whatever the user asks for.
GN_CONST real kTinyVariance = real(1e-10);

// Between 0 and 1; what is not a number is 0.
GN_FN real unitOrZero(real x)
{
    return x >= real(0.0) ? min(x, real(1.0)) : real(0.0);
}

// The depth of a receiver on the map: as momentDepth(), but what is not a number is nearest to the light: lit.
GN_FN real receiverDepth(real m, int flags, real near_over_far)
{
    real d = m > real(1.0) ? real(1.0) : unitOrZero(m);
    return momentDepth(d, flags, near_over_far);
}

// (1) M1 = x, M2 = x^2 + variance within the texel, of one coordinate x.
GN_FN real2 twoMoments(real x, real variance)
{
    return real2(x, x * x + variance);
}

GN_FN real4 encodeVsm(EncodeInput e, MomentRule rule)
{
    real scale = momentScale(rule.flags);
    real x = momentCoordinate(momentDepth(e.depth, 0, real(1.0)), rule.flags);
    real2 m = twoMoments(x, unitOrZero(e.variance) * scale * scale);
    return real4(m.x, m.y, real(0.0), real(0.0));
}

// One layer of depth, in its own metric. Where that is clamped, depth varies no more.
GN_FN real2 encodeLayer(EncodeInput e, MomentRule rule, real4 layer)
{
    real stretch = momentScale(rule.flags) / max(layer.y - layer.x, real(1e-6));
    bool inside = e.depth > layer.x && e.depth < layer.y;
    real variance = inside ? min(unitOrZero(e.variance) * stretch * stretch, real(1.0)) : real(0.0);
    real d = isLayer(layer) ? layerMetric(e.depth, layer) : real(1.0); // no such layer: as if nothing was drawn
    return twoMoments(momentCoordinate(d, rule.flags), isLayer(layer) ? variance : real(0.0));
}

GN_FN real4 encodeLvsm(EncodeInput e, MomentRule rule)
{
    real2 a = encodeLayer(e, rule, e.first);
    real2 b = encodeLayer(e, rule, e.second);
    return real4(a.x, a.y, b.x, b.y);
}

// In squares of the stored coordinate: the larger one of an absolute variance and of what a texel's width spans on a
// slope. `stretch`: how much faster the stored depth (before remapping) changes here than the linear metric.
GN_FN real leastVariance(MomentRule rule, real texel_depth, real stretch)
{
    real scale = momentScale(rule.flags);
    real deviation = unitOrZero(rule.min_variance_texels * texel_depth * stretch);
    real least = max(max(deviation * deviation, unitOrZero(rule.min_variance)), kTinyVariance);
    return least * scale * scale;
}

// How much faster than the linear metric m the depth that is stored changes.
GN_FN real metricStretch(real m, int flags, real near_over_far)
{
    return hasFlag(flags, kMomentZOverW) ? zOverWSlope(unitOrZero(m), near_over_far) : real(1.0);
}

// (2) Chebyshev's one-sided bound, Donnelly & Lauritzen 2006, eq. 5: no more than var / (var + (t - M1)^2) of any
// distribution with these moments is at t or beyond. It is exact for an occluder and a receiver that are both parallel
// to the map. Moments that are not numbers give a result that is none, or 1.
GN_FN real chebyshevBound(real m1, real m2, real t, real least)
{
    real variance = m2 - m1 * m1;
    variance = variance < least ? least : variance;
    real beyond = t - m1;
    return beyond > real(0.0) ? variance / (variance + beyond * beyond) : real(1.0);
}

// The occluders that (2) assumes. With mean M1 and visibility p at t, their mean lies (t - M1) / (1 - p) before t: B.
// Yang et al., "Variance Soft Shadow Mapping", 2010, eq. 4. Written out with (2), nothing is divided by a small number.
// `scale`: stored coordinate per metric.
GN_FN Occluders chebyshevOccluders(real m1, real m2, real t, real least, real scale)
{
    real variance = max(m2 - m1 * m1, least);
    real beyond = t - m1;
    Occluders o;
    o.share = beyond > real(0.0) ? beyond * beyond / (variance + beyond * beyond) : real(0.0);
    o.height = beyond > real(0.0) ? (variance / beyond + beyond) / scale : real(0.0);
    return o;
}

// Markov's bound: depths are never before 0, so no more than M1 / t of them is at t or beyond. `slack`: by how much
// rounding may have lowered M1.
GN_FN real markovBound(real m1, real t, real slack)
{
    real most = max(m1, real(0.0)) + slack;
    return t > most ? most / t : real(1.0);
}

// Reduces light bleeding, in this order: (3) linstep(a, 1, V), GPU Gems 3, ch. 8.4.1; (4) V^k, Marinescu 2011. Always
// in [0, 1]; NaN is lit.
GN_FN real shapeVisibility(real visibility, MomentRule rule)
{
    real v = visibility < real(1.0) ? max(visibility, real(0.0)) : real(1.0);
    v = max(v - rule.linstep, real(0.0)) / max(real(1.0) - rule.linstep, real(0.01)); // (3)
    v = pow(clamp(v, real(0.0), real(1.0)), rule.power);                              // (4)
    return v < real(1.0) ? max(v, real(0.0)) : real(1.0);
}

GN_END
#endif
