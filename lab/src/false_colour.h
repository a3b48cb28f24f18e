// SPDX-License-Identifier: Apache-2.0
// Colours that stand for numbers: readable with any of the usual colour deficiencies.
#pragma once

#include "lab/metrics/error_classes.h"

#include <cstddef>
#include <cstdint>

namespace gnomon::lab {

/// sRGB-encoded.
struct Colour {
    std::uint8_t red = 0;
    std::uint8_t green = 0;
    std::uint8_t blue = 0;

    [[nodiscard]] bool operator==(const Colour&) const = default;
};

inline constexpr Colour kNotANumber{255, 0, 255};
inline constexpr Colour kLeftOut{34, 34, 34};
inline constexpr Colour kWhite{255, 255, 255};

/// The truth under the class colours: grey from kFaintDark (0) to kFaintLight (1), which no class colour comes near.
inline constexpr Colour kFaintDark{68, 68, 68};
inline constexpr Colour kFaintLight{104, 104, 104};

/// Densities from 2^-kDensityOctaves to 2^kDensityOctaves have a colour of their own; beyond, the end's.
inline constexpr double kDensityOctaves = 4.0;

/// sRGB's code of a linear value, clamped to [0, 1].
[[nodiscard]] std::uint8_t encodeSrgb(double linear);

/// The colour of a signed error in [-1, 1], clamped: blue below 0, white at 0, orange above; as light for -e as for e.
/// The scale is the square root of |e|. NaN has kNotANumber.
[[nodiscard]] Colour errorColour(double error);

/// The colour of texels per pixel; 0 and less have kLeftOut, NaN kNotANumber.
[[nodiscard]] Colour densityColour(double texels_per_pixel);

/// The colour of a number of lights, from 1 to 2^kLightOctaves; beyond, the end's colour. 0 has kLeftOut.
inline constexpr double kLightOctaves = 5.0;
[[nodiscard]] Colour lightCountColour(std::uint32_t lights);

/// The full colour of a class of error; kFaintLight for `correct`, kLeftOut for `left_out`.
[[nodiscard]] Colour classColour(ErrorClass error_class);

/// The colour of a kind, from 0; colours repeat after kMostTints (lab/tint.h).
[[nodiscard]] Colour tintColour(std::size_t kind);

/// Mixed as light; share_of_b in [0, 1].
[[nodiscard]] Colour mixLight(Colour a, Colour b, double share_of_b);

} // namespace gnomon::lab
