// SPDX-License-Identifier: Apache-2.0
// Exponential warps of depth: the values that a map of esm and evsm stores for one depth, and the visibility of values
// that are read back. Based on: T. Annen, T. Mertens, H.-P. Seidel, E. Flerackers, J. Kautz, "Exponential Shadow Maps",
// Graphics Interface 2008, and M. Salvi, "Rendering Filtered Shadows with Exponential Shadow Maps", ShaderX6, 2008:
//   (1) V = sat(e^(-c d) E[e^(c z)]), d the receiver's depth, z the occluders';
// A. Lauritzen, M. McCool, "Layered Variance Shadow Maps", Graphics Interface 2008, section 5:
//   (2) the warps e^(c+ z) and -e^(-c- z); (3) Chebyshev's bound in each of them holds, so the smaller one does too;
//   (4) least variance in a warp is that of depth times the square of the warp's slope;
//   (5) ours: rounding takes a share of what is stored, which differs from warp to warp (moments.h).
// Departures: everything is divided by the warp at the receiver (Chebyshev's bound does not change), so that no square
// of e^c appears and one evaluation does for values stored as they are and as logarithms. Where logarithms are stored
// ("log space"), a channel holds v, which stands for e^(k v) with k = c+, 2 c+, -c-, -2 c- (esm: c); see
// lib/average.glsl.
#ifndef GNOMON_EXPONENTIAL_H
#define GNOMON_EXPONENTIAL_H
#include "moment_rule.h"
#include "moments.h"
GN_BEGIN

// e^(2 c t) must not make 2 c infinite; so large an exponent takes the largest value already.
GN_CONST real kMostExponent = real(1e30);
// e^80 is next to infinite as a ratio of second moments, and finite.
GN_CONST real kMostLog = real(80.0);

// k of each channel.
GN_FN real4 esmExponents(MomentRule rule)
{
    return real4(min(rule.exponent, kMostExponent));
}
GN_FN real4 evsmExponents(MomentRule rule)
{
    real up = min(rule.exponent, kMostExponent);
    real down = min(rule.exponent_negative, kMostExponent);
    return real4(up, real(2.0) * up, -down, real(-2.0) * down);
}

GN_FN real4 encodeEsm(EncodeInput e, MomentRule rule)
{
    real t = momentCoordinate(e.depth, rule.flags);
    return real4(hasFlag(rule.flags, kMomentLogSpace) ? t : exp(rule.exponent * t));
}

// By the delta method a texel whose depth varies by s^2 has a warp that varies by (c s)^2 times its square. No second
// moment exceeds that of the far plane, which is what the format is known to hold.
GN_FN real4 encodeEvsm(EncodeInput e, MomentRule rule)
{
    real t = momentCoordinate(e.depth, rule.flags);
    real scale = momentScale(rule.flags);
    real variance = e.variance * scale * scale;
    real4 k = evsmExponents(rule);
    real more_up = real(1.0) + k.x * k.x * variance;
    real more_down = real(1.0) + k.z * k.z * variance;
    if (hasFlag(rule.flags, kMomentLogSpace)) {
        return real4(t, t + log(min(more_up, real(1e30))) / k.y, t, t + log(min(more_down, real(1e30))) / k.w);
    }
    real up = exp(k.x * t);
    real down = exp(k.z * t);
    return real4(up, min(up * up * more_up, exp(k.y)), -down, min(down * down * more_down, exp(-k.w)));
}

// log(e^(-c t) E) of what an esm map holds: 0 where all of it is at the receiver, above 0 where some is behind it.
// Below -87 the visibility is 0 anyway, and the logarithm of 0 is never taken.
GN_FN real esmExcess(real stored, real t, MomentRule rule)
{
    real c = esmExponents(rule).x;
    if (hasFlag(rule.flags, kMomentLogSpace)) {
        return c * (stored - t);
    }
    return log(max(stored, real(1e-37))) - c * t;
}

// (1).
GN_FN real esmVisibility(real excess)
{
    return exp(min(excess, real(0.0)));
}

// (3) in the warp e^(c+ z), with (4) and (5). `least`: of the coordinate. Occluders before the receiver are small in
// this warp, and so is what rounding makes of them: (5) goes with their second moment and lights no deep shadow.
GN_FN real evsmPositive(real4 stored, real t, real least, MomentRule rule)
{
    real c = evsmExponents(rule).x;
    real mean = real(0.0);
    real second = real(0.0);
    if (hasFlag(rule.flags, kMomentLogSpace)) {
        mean = exp(min(c * (stored.x - t), real(0.0))); // 1 is at the receiver: lit, however far behind
        second = exp(min(real(2.0) * c * (stored.y - t), kMostLog));
    } else {
        real one_over = exp(-c * t);
        mean = min(stored.x * one_over, real(1.0));
        second = stored.y * one_over * one_over;
    }
    return chebyshevBound(mean, second, real(1.0), max(min(c * c * least, real(1e30)), rule.rounding * second));
}

// (3) in the warp -e^(-c- z), with (4) and (5). Divided by the mean, not by the receiver's warp: -mean is without bound
// here. Occluders are large in this warp; rounding shows on what is lit, where they are as large as the receiver, so
// (5) goes with that one's square and pales with depth behind them.
GN_FN real evsmNegative(real4 stored, real t, real least, MomentRule rule)
{
    real c = -evsmExponents(rule).z;
    real at = real(0.0);     // warp at the receiver over the mean: below 1 where the mean is before the receiver
    real second = real(0.0); // over the square of the mean
    if (hasFlag(rule.flags, kMomentLogSpace)) {
        at = exp(min(c * (stored.z - t), real(0.0)));
        second = exp(min(real(2.0) * c * (stored.z - stored.w), kMostLog));
    } else {
        real one_over = real(1.0) / max(-stored.z, real(1e-37));
        at = min(exp(-c * t) * one_over, real(1.0));
        second = stored.w * one_over * one_over;
    }
    real least_here = max(min(c * c * least, real(1e30)), rule.rounding_negative);
    return chebyshevBound(real(-1.0), second, -at, least_here * at * at);
}

GN_FN real evsmVisibility(real4 stored, real t, real least, MomentRule rule)
{
    real v = evsmPositive(stored, t, least, rule);
    return hasFlag(rule.flags, kMomentFourChannels) ? min(v, evsmNegative(stored, t, least, rule)) : v;
}

GN_END
#endif
