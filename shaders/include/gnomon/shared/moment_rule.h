// SPDX-License-Identifier: Apache-2.0
// Shared by all filterable maps: how a depth becomes the coordinate whose moments are stored.
#ifndef GNOMON_MOMENT_RULE_H
#define GNOMON_MOMENT_RULE_H
#include "portability.h"
GN_BEGIN

// MomentRule::flags
GN_CONST int kMomentRemap = 1;        // the coordinate is 2 d - 1 instead of d
GN_CONST int kMomentZOverW = 2;       // d is z / w instead of the linear metric
GN_CONST int kMomentLogSpace = 4;     // esm, evsm: logarithms are stored
GN_CONST int kMomentFourChannels = 8; // evsm: both warps
GN_CONST int kMomentHausdorff = 16;   // msm
GN_CONST int kMomentQuantised = 32;   // msm: in the basis that is made for unorm
GN_CONST int kMomentDerivatives = 64; // derivative-based variance
GN_CONST int kMomentPenumbra = 128;   // vsm, msm: penumbrae follow from the light's size

struct MomentRule {
    int flags;
    int sampling;             // gnomon::MapSampling
    int layers;               // lvsm: 2 .. 8
    real exponent;            // esm: c; evsm: c+
    real exponent_negative;   // evsm: c-
    real moment_bias;         // msm
    real min_variance;        // variance of d', absolute
    real min_variance_texels; // variance of d', the square of this many texel depths; the larger one holds. msm: the
                              // blur's standard deviation in texels, for the spread of a slope
    real rounding;            // evsm, warp of c+: share of a second moment that rounding may take
    real rounding_negative;   // evsm, warp of c-: the same
    real linstep;
    real power;
    real lighten;     // for every filter: lightenedVisibility()
    real lighten_cut; // for every filter: lightenedVisibility()
    real anisotropy;
};

// Shadows are lightened by b = `lighten`: V (1 - cut) + b. Marinescu 2011 adds b as it is, cut = 0, and what exceeds 1
// is cut off; with cut = b full shadow is b and penumbrae keep their shape.
GN_FN real lightenedVisibility(real v, real lighten, real cut)
{
    return min(v * (real(1.0) - cut) + lighten, real(1.0));
}

// The depths before a receiver, as moments describe them.
struct Occluders {
    real share;  // share of the averaged texels that lies before it
    real height; // their mean height over the receiver, in the metric
};

// The inputs of encoders.
struct EncodeInput {
    real depth;    // [0, 1]: linear or z / w, not yet remapped
    real variance; // variance that this texel adds to its own second moment, in squares of `depth`
    real4 first;   // lvsm: GpuDepthLayers::layer of the two layers of this image layer
    real4 second;
};

GN_FN bool hasFlag(int flags, int flag)
{
    return (flags & flag) != 0;
}

// z / w of a perspective projection from the linear metric m, r = near / far: with d = near + m (far - near),
// z / w = far (d - near) / (d (far - near)) = m / (r + m (1 - r)). 0 and 1 stay where they are.
GN_FN real zOverW(real m, real near_over_far)
{
    return m / max(near_over_far + m * (real(1.0) - near_over_far), real(1e-30));
}

// How much faster z / w changes than the linear metric.
GN_FN real zOverWSlope(real m, real near_over_far)
{
    real q = max(near_over_far + m * (real(1.0) - near_over_far), real(1e-15));
    return near_over_far / (q * q);
}

// The depth that is stored, from the linear metric: clamped, in [0, 1]. NaN becomes the far plane: lit.
GN_FN real momentDepth(real m, int flags, real near_over_far)
{
    real d = m <= real(1.0) ? max(m, real(0.0)) : real(1.0);
    return hasFlag(flags, kMomentZOverW) ? zOverW(d, near_over_far) : d;
}

// The coordinate whose moments are taken, and by how much it is stretched against `depth`.
GN_FN real momentCoordinate(real depth, int flags)
{
    return hasFlag(flags, kMomentRemap) ? real(2.0) * depth - real(1.0) : depth;
}
GN_FN real momentScale(int flags)
{
    return hasFlag(flags, kMomentRemap) ? real(2.0) : real(1.0);
}

GN_END
#endif
