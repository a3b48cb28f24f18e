// SPDX-License-Identifier: Apache-2.0
// How stored values of filterable maps are averaged: over the samples of a texel, the taps of a blur, the four texels
// under a texel of the next mip level. As they are; or, where logarithms are stored, as what they are logarithms of.
// Based on: A. Lauritzen, "Summed-Area Variance Shadow Maps", GPU Gems 3, 2007, chapter 8 (what is averaged must be
// linear); M. Salvi, "Rendering Filtered Shadows with Exponential Shadow Maps", ShaderX6, 2008 (blurring logarithms:
//   log(w0 e^a0 + w1 e^a1 + ..) = a0 + log(w0 + w1 e^(a1 - a0) + ..)).
// Departures: Salvi's reference is the first tap, which overflows where a later one is far above it. Ours moves to the
// largest seen so far, so that every exponent is at most 0, and one pass over the taps does. And our value v stands for
// e^(k v), k of either sign, one for each channel.
//
// Use: s = startAverage(first, w, log); s = addToAverage(s, next, w, k, log); ..; finishAverage(s, k, log). The weights
// are at least 0, the first is more, and they add up to 1. `log` is averagesLogarithms(), a constant: what it does not
// need is never run.
#ifndef GNOMON_AVERAGE_GLSL
#define GNOMON_AVERAGE_GLSL
#include "../shared/filter_numbers.h"
#include "../shared/exponential.h"
GN_BEGIN

GN_FN bool averagesLogarithms(int filter_number, int flags)
{
    return hasFlag(flags, kMomentLogSpace) && (filter_number == GNOMON_FILTER_ESM || filter_number == GNOMON_FILTER_EVSM);
}

// k of each channel; 0 where values are averaged as they are.
GN_FN real4 averageExponents(int filter_number, MomentRule rule)
{
    if (!averagesLogarithms(filter_number, rule.flags)) {
        return real4(real(0.0));
    }
    return filter_number == GNOMON_FILTER_ESM ? esmExponents(rule) : evsmExponents(rule);
}

struct MomentSum {
    real4 total;     // sum of w v; for logarithms, of w e^(k (v - reference))
    real4 reference; // for logarithms: the v with the largest k v so far
};

GN_FN MomentSum startAverage(real4 value, real weight, bool logarithms)
{
    MomentSum sum;
    sum.total = logarithms ? real4(weight) : value * weight;
    sum.reference = value;
    return sum;
}

GN_FN MomentSum addToAverage(MomentSum sum, real4 value, real weight, real4 k, bool logarithms)
{
    MomentSum next = sum;
    if (!logarithms) {
        next.total = sum.total + value * weight;
        return next;
    }
    real4 above = k * (value - sum.reference);
    real4 ratio = exp(-abs(above)); // one exponential a tap: of the smaller to the larger
    real4 is_above = step(real4(real(0.0)), above);
    next.total = mix(sum.total + ratio * weight, sum.total * ratio + real4(weight), is_above);
    next.reference = mix(sum.reference, value, is_above);
    return next;
}

GN_FN real4 finishAverage(MomentSum sum, real4 k, bool logarithms)
{
    if (!logarithms) {
        return sum.total;
    }
    return sum.reference + log(max(sum.total, real4(real(1e-30)))) / k;
}

// The average of the four texels under a texel of the next mip level.
GN_FN real4 averageOfFour(real4 a, real4 b, real4 c, real4 d, real4 k, bool logarithms)
{
    MomentSum sum = startAverage(a, real(0.25), logarithms);
    sum = addToAverage(sum, b, real(0.25), k, logarithms);
    sum = addToAverage(sum, c, real(0.25), k, logarithms);
    sum = addToAverage(sum, d, real(0.25), k, logarithms);
    return finishAverage(sum, k, logarithms);
}

GN_END
#endif
