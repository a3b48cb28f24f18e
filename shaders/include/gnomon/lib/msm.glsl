// SPDX-License-Identifier: Apache-2.0
// msm: the least shadow that four moments of depth allow.
// Based on: C. Peters, R. Klein, "Moment Shadow Mapping", I3D 2015; C. Peters, C. Muenstermann, N. Wetzstein, R. Klein,
// "Improved Moment Shadow Maps for Translucent Occluders, Soft Shadows and Single Scattering", JCGT 6(1), 2017.
// Departure: on a slope a kernel holds the receiver's own plane from before the receiver to behind it, and four moments
// cannot tell that from occluders: at the mean of a Gaussian the bound is 5/6. For depths that lie alike to both
// sides of their mean, with standard deviation s, it is 1 from mean - s on towards the light: there the polynomial whose
// roots are the occluders has none before the receiver (k2 = (t^2 / s^2 - 1) / (kurtosis - 1) changes sign). So the
// receiver is moved towards the light by the s that its own plane has in the kernel, which is nothing where the plane is
// parallel to the map. Only where the kernel may hold nothing but that plane: its mean square distance from the receiver
// is then s^2, and any occluder that matters makes it more; shadows on walls keep their place.
#ifndef GNOMON_MSM_GLSL
#define GNOMON_MSM_GLSL
#include "../shared/moments.h"
#include "../shared/moments_four.h"
#include "moment_sampling.glsl"
GN_BEGIN

// Variance of the place that a bilinear read stands for, in texels of its level: 1/12 within a texel (of a mip level, or
// of four samples) and up to 1/4 between texels.
GN_CONST real kVarianceOfRead = real(1.0) / real(3.0);

// Standard deviation of the receiver's own plane in the kernel, in the depth metric.
GN_FN real planeDeviation(MapPoint point, FilterInput f, FootprintReads reads)
{
    real2 slope = point.depth_slope - point.w_slope * point.depth; // the slope of depth itself, per texel
    real variance = f.moments.min_variance_texels * f.moments.min_variance_texels + kVarianceOfRead * exp2(real(2.0) * reads.level);
    variance = variance * dot(slope, slope);
    real along = dot(slope, reads.step);
    return sqrt(variance + along * along * (real(reads.reads * reads.reads) - real(1.0)) / real(12.0));
}

// Mean square distances from the receiver, in squares of the plane's deviation, from where on the kernel holds more than
// the plane, and where it surely does.
GN_CONST real kPlaneAlone = real(1.5);
GN_CONST real kMoreThanPlane = real(4.0);

// By how much a receiver at coordinate t moves towards the light. `deviation`: of its plane, in the same coordinate.
GN_FN real msmAllowance(real4 b, real t, real deviation)
{
    real distance = b.y - real(2.0) * t * b.x + t * t; // E[(z - t)^2]
    real s2 = max(deviation * deviation, real(1e-12));
    real share = (kMoreThanPlane - distance / s2) / (kMoreThanPlane - kPlaneAlone);
    return deviation * (share < real(1.0) ? max(share, real(0.0)) : real(1.0));
}

// The coordinate that a receiver is tested at, with the moments that were read.
GN_FN real msmCoordinate(MapPoint point, FilterInput f, FootprintReads reads, real4 stored)
{
    int flags = f.moments.flags;
    real t = momentCoordinate(receiverDepth(point.depth, flags, f.near_over_far), flags);
    real before = point.depth - planeDeviation(point, f, reads);
    real deviation = t - momentCoordinate(receiverDepth(before, flags, f.near_over_far), flags);
    real4 b = hasFlag(flags, kMomentQuantised) ? momentsOfQuantised(stored) : stored;
    return t - msmAllowance(b, t, deviation);
}

// `reads`: mapReads(), `stored`: sampleMoments() at the point; here and below.
GN_FN Occluders msmOccluders(MapPoint point, FilterInput f, FootprintReads reads, real4 stored)
{
    Hankel h = factorise(usableMoments(stored, f.moments), leastLastPivot(f.moments.flags));
    return hamburgerOccluders(h, msmCoordinate(point, f, reads, stored), momentScale(f.moments.flags));
}

GN_FN real filterMsm(MapPoint point, FilterInput f, FootprintReads reads, real4 stored)
{
    return shapeVisibility(msmVisibility(stored, msmCoordinate(point, f, reads, stored), f.moments), f.moments);
}

GN_END
#endif
