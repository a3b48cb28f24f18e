// SPDX-License-Identifier: Apache-2.0
// The colour spaces of FLIP and its distance of two colours.
// Based on: P. Andersson et al., "FLIP: A Difference Evaluator for Alternating Images", 2020, the colour pipeline.
#pragma once

namespace gnomon::lab::flip_parts {

/// Linear RGB of sRGB's primaries, the cube [0, 1]^3 being what a monitor shows.
struct LinearRgb {
    double r = 0.0;
    double g = 0.0;
    double b = 0.0;
};

/// YCxCz, affine in linear RGB: achromatic [-16, 100], red-green, blue-yellow; a grey has no chroma.
struct Opponent {
    double y = 0.0;
    double cx = 0.0;
    double cz = 0.0;
};

/// L*a*b* with chroma scaled by lightness: the Hunt effect, colours seem more colourful in more light.
struct HuntLab {
    double l = 0.0; // [0, 100]
    double a = 0.0;
    double b = 0.0;
};

/// Clamped to the cube; not-a-number stays.
[[nodiscard]] LinearRgb clampToCube(const LinearRgb& rgb);

[[nodiscard]] Opponent opponentFromLinear(const LinearRgb& rgb);
[[nodiscard]] LinearRgb linearFromOpponent(const Opponent& colour);
[[nodiscard]] HuntLab huntLabFromLinear(const LinearRgb& rgb);

/// Luminance relative to white, [0, 1].
[[nodiscard]] double luminance(double opponent_y);

/// City block in lightness plus Euclidean in chroma, at least 0.
[[nodiscard]] double hyab(const HuntLab& first, const HuntLab& second);

/// Spreads the HyAB distances of the cube's colours over [0, 1], small ones over most of it.
class Redistribution {
public:
    Redistribution();
    [[nodiscard]] double operator()(double hyab_distance) const;
    /// The distance of the two colours of the cube that are farthest apart, after the exponent.
    [[nodiscard]] double largest() const { return largest_; }

private:
    double largest_ = 0.0;
};

} // namespace gnomon::lab::flip_parts
