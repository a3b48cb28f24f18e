// SPDX-License-Identifier: Apache-2.0
// Four moments of depth, as a map of msm stores them, and the least shadow that they allow.
// Based on: C. Peters, R. Klein, "Moment Shadow Mapping", I3D 2015 (the bounds: algorithm 2 on the whole line,
// "Hamburger", algorithm 3 on the interval, "Hausdorff"; the bias of section 4.4), and C. Peters, C. Muenstermann,
// N. Wetzstein, R. Klein, "Improved Moment Shadow Maps for Translucent Occluders, Soft Shadows and Single Scattering",
// JCGT 6(1), 2017 (depth in [-1, 1]; the sparse basis for 16 bits; the bias vector (0, 0.628, 0, 0.628)).
//
// Among all distributions with moments b1 .. b4, the one with the least weight before the receiver's depth z0 has its
// weight at z0 and at the two roots of K(z0, z) = 0 (2015, algorithm 2). K is the quadratic form of the inverse of the
// Hankel matrix B = (1, b1, b2; b1, b2, b3; b2, b3, b4), for (1, z0, z0^2) and (1, z, z^2). With B = L D L^T,
//   (1) p1(z) = z - b1, p2(z) = z^2 - b2 - l (z - b1), K(x, z) = 1 + p1(x) p1(z) / d1 + p2(x) p2(z) / d2.
// Departures, all so that single precision is enough and nothing divides by a difference of roots:
//   (2) the weight at each of these points is 1 / K(z, z) (Christoffel's number), at least 0 and at most 1 as it
//   stands; (3) the side of z0 on which the roots are is read off K(z0, z) as a polynomial in z - z0 = s,
//       k0 + k1 s + k2 s^2 with k0 >= 1, k2 = p2(z0) / d2: one on each side when k2 < 0, else both below when k1 > 0,
//       else both above. Only the first case takes a root, and its discriminant is a sum of two that are not negative;
//   (4) on the interval, where a root lies outside of it, the points are -1, 1, z0 and one more (Krein & Nudelman 1977,
//       theorem on canonical representations), and (1) to (3) hold for the distribution weighted by 1 - z^2, one degree
//       lower, whose moments are 1 - b2, b1 - b3, b2 - b4.
#ifndef GNOMON_MOMENTS_FOUR_H
#define GNOMON_MOMENTS_FOUR_H
#include "moment_rule.h"
GN_BEGIN

// Towards what moments are biased. On the line the vector of 2017; on the interval that one has no weight between its
// ends and 0, so that it would not lead away from where (4) divides by nothing: there the moments of the arcsine
// distribution, which is in the middle.
GN_CONST real kBiasMoment = real(0.628);
GN_CONST real kBiasSecond = real(0.5);
GN_CONST real kBiasFourth = real(0.375);
// Least pivots: about the rounding error of a pivot that is 0. The last one is 0 for two depths, as a receiver with a
// little of an occluder over it is. Rounding to 16 bits makes it noise instead, which moves the roots by more than any
// bias of the receiver: a lit one goes black where a root falls before it. A pivot as large as that noise prevents
// this. A larger moment bias would do the same, but acts everywhere, and lets light in at contacts.
GN_CONST real kLeastPivot = real(1e-7);
GN_CONST real kLeastLastPivot = real(1e-12);
GN_CONST real kLeastLastPivot16 = real(1e-5);
// The ends of the interval have no room for a point beside them.
GN_CONST real kNearlyOne = real(0.99999);

struct Hankel {
    real b1;
    real b2;
    real l;
    real d1;
    real d2;
};

// The sparse basis of 2017: each moment vector of a point in [-1, 1] lands in [0, 1]^4.
GN_FN real4 quantisedMoments(real4 b)
{
    real root = sqrt(real(3.0));
    return real4(real(1.5) * b.x - real(2.0) * b.z + real(0.5), real(4.0) * (b.y - b.w),
                 root * (real(0.5) * b.x - (real(2.0) / real(9.0)) * b.z) + real(0.5), real(0.5) * (b.y + b.w));
}

// Its inverse. An error of h in each channel becomes at most 2.07 h (b1), 1.13 h (b2), 2.05 h (b3) and 1.13 h (b4).
GN_FN real4 momentsOfQuantised(real4 q)
{
    real x = q.x - real(0.5);
    real z = sqrt(real(3.0)) * (q.z - real(0.5));
    return real4(z - x / real(3.0), q.w + real(0.125) * q.y, real(0.75) * (z - x), q.w - real(0.125) * q.y);
}

GN_FN real4 encodeMsm(EncodeInput e, MomentRule rule)
{
    real t = momentCoordinate(e.depth, rule.flags);
    real4 b = real4(t, t * t, t * t * t, t * t * t * t);
    return hasFlag(rule.flags, kMomentQuantised) ? quantisedMoments(b) : b;
}

GN_FN real leastLastPivot(int flags)
{
    return hasFlag(flags, kMomentQuantised) ? kLeastLastPivot16 : kLeastLastPivot;
}

GN_FN Hankel factorise(real4 b, real least_last)
{
    Hankel h;
    h.b1 = b.x;
    h.b2 = b.y;
    h.d1 = max(b.y - b.x * b.x, kLeastPivot);
    real product = b.z - b.x * b.y;
    h.l = product / h.d1;
    h.d2 = max((b.w - b.y * b.y) - product * h.l, least_last);
    return h;
}

GN_FN real secondPolynomial(Hankel h, real z)
{
    return z * z - h.b2 - h.l * (z - h.b1);
}
// (2).
GN_FN real weightAt(Hankel h, real z)
{
    real p1 = z - h.b1;
    real p2 = secondPolynomial(h, z);
    return real(1.0) / (real(1.0) + p1 * p1 / h.d1 + p2 * p2 / h.d2);
}
// (1).
GN_FN real kernelOf(Hankel h, real x, real z)
{
    return real(1.0) + (x - h.b1) * (z - h.b1) / h.d1 + secondPolynomial(h, x) * secondPolynomial(h, z) / h.d2;
}
// K(z0, .) about z0: (3).
GN_FN real3 kernelAbout(Hankel h, real z0)
{
    real k2 = secondPolynomial(h, z0) / h.d2;
    real k1 = (z0 - h.b1) / h.d1 + k2 * (real(2.0) * z0 - h.l);
    return real3(real(1.0) / weightAt(h, z0), k1, k2);
}

// The root of k0 + k1 s + k2 s^2 below 0, for k2 < 0 < k0. Far away it does not matter where: its weight is 0.
GN_FN real rootBelow(real3 k)
{
    real q = sqrt(k.y * k.y - real(4.0) * k.z * k.x);
    real s = k.y > real(0.0) ? real(-2.0) * k.x / (k.y + q) : (q - k.y) / (real(2.0) * k.z);
    return max(s, real(-100.0));
}

// Largest visibility of a receiver at z0 that moments allow, occluders being anywhere. `k`: kernelAbout(h, z0).
GN_FN real hamburgerVisibility(Hankel h, real z0, real3 k)
{
    if (k.z < real(0.0)) {
        return real(1.0) - weightAt(h, z0 + rootBelow(k));
    }
    return k.y > real(0.0) ? real(1.0) / k.x : real(1.0);
}

// The occluders that the bound assumes: the roots below z0. For two of them it is their mean, which follows from the
// mean and weights of all. `scale`: coordinate per metric.
// Source: C. Peters et al., "Beyond Hard Shadows: Moment Shadow Maps for Single Scattering, Soft Shadows and
// Translucent Occluders", I3D 2016.
GN_FN Occluders hamburgerOccluders(Hankel h, real z0, real scale)
{
    real3 k = kernelAbout(h, z0);
    Occluders o;
    o.share = real(0.0);
    o.height = real(0.0);
    if (k.z < real(0.0)) {
        real root = rootBelow(k);
        o.share = weightAt(h, z0 + root);
        o.height = -root / scale;
    } else if (k.y > real(0.0)) {
        o.share = max(real(1.0) - real(1.0) / k.x, real(1e-6));
        o.height = max(z0 - h.b1, real(0.0)) / (o.share * scale);
    }
    return o;
}

// Do both roots of K(z0, .) lie in [-1, 1]?
GN_FN bool rootsInside(Hankel h, real z0, real3 k)
{
    real at_first = kernelOf(h, z0, real(-1.0));
    real at_last = kernelOf(h, z0, real(1.0));
    if (k.z < real(0.0)) {
        return at_first <= real(0.0) && at_last <= real(0.0);
    }
    return k.y > real(0.0) ? at_first >= real(0.0) : at_last >= real(0.0);
}

// (4): visibility by points -1, 1, z0 and one more.
GN_FN real endpointVisibility(real4 b, real z0)
{
    real m0 = max(real(1.0) - b.y, kLeastPivot);
    real mean = (b.x - b.z) / m0;
    real variance = max((b.y - b.w) / m0 - mean * mean, kLeastPivot);
    real from_mean = z0 - mean;
    // K(z0, y) = (1 + (z0 - mean) (y - mean) / variance) / m0 = 0
    real step_back = variance / max(abs(from_mean), real(1e-15));
    real y = mean + (from_mean > real(0.0) ? -step_back : step_back);
    y = clamp(y, -kNearlyOne, kNearlyOne);
    real y_from_mean = y - mean;
    real w0 = m0 / ((real(1.0) + from_mean * from_mean / variance) * (real(1.0) - z0 * z0));
    real wy = m0 / ((real(1.0) + y_from_mean * y_from_mean / variance) * (real(1.0) - y * y));
    if (y < z0) { // lit: z0 itself and 1, whose weight is what mass and mean leave
        real last = real(0.5) * (real(1.0) + b.x - w0 * (real(1.0) + z0) - wy * (real(1.0) + y));
        return w0 + max(last, real(0.0));
    }
    return real(1.0) - max(real(0.5) * (real(1.0) - b.x - w0 * (real(1.0) - z0) - wy * (real(1.0) - y)), real(0.0));
}

GN_FN real4 biasedMoments(real4 b, MomentRule rule)
{
    bool interval = hasFlag(rule.flags, kMomentHausdorff);
    real second = interval ? kBiasSecond : kBiasMoment;
    real fourth = interval ? kBiasFourth : kBiasMoment;
    return mix(b, real4(real(0.0), second, real(0.0), fourth), rule.moment_bias);
}

// The biased moments of a value that is read from a map, in either basis.
GN_FN real4 usableMoments(real4 stored, MomentRule rule)
{
    real4 b = hasFlag(rule.flags, kMomentQuantised) ? momentsOfQuantised(stored) : stored;
    return biasedMoments(clamp(b, real4(real(-1.0)), real4(real(1.0))), rule);
}

// NaN counts as lit.
GN_FN real msmVisibility(real4 stored, real t, MomentRule rule)
{
    real4 b = usableMoments(stored, rule);
    Hankel h = factorise(b, leastLastPivot(rule.flags));
    bool interval = hasFlag(rule.flags, kMomentHausdorff); // occluders in [-1, 1]: never more light than anywhere
    real z = interval ? clamp(t, -kNearlyOne, kNearlyOne) : t;
    real3 k = kernelAbout(h, z);
    real v = hamburgerVisibility(h, z, k);
    if (interval && !rootsInside(h, z, k)) {
        v = min(v, endpointVisibility(b, z));
    }
    return v >= real(0.0) ? min(v, real(1.0)) : (v < real(0.0) ? real(0.0) : real(1.0));
}

GN_END
#endif
