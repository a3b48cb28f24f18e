// SPDX-License-Identifier: Apache-2.0
// Pictures of a comparison: false colour with legends.
#pragma once

#include "image/image.h"
#include "lab/metrics/error.h"
#include "lab/metrics/error_classes.h"

#include <array>
#include <cstdint>

namespace gnomon::lab {

/// test - truth from -1 (too dark, blue) over 0 (white) to 1 (too bright, orange-brown), in a diverging map that people
/// with any of the usual colour deficiencies can read; left-out pixels dark grey, NaN magenta. The scale is the square
/// root of |test - truth|, so that an error of 0.01 is seen too.
///
/// This picture and the next two are RGB and get a legend below them: they are higher than what they show, and at least
/// 320 px wide. Images smaller than 320 px are enlarged by the whole factor that fits, and padded on both sides with
/// the legend's dark grey. Precondition: one size, one channel each.
[[nodiscard]] Image8 errorPicture(const ImageF& test, const ImageF& truth, const Counted& counted);
/// errorPicture() without a legend and of the masks' size, for pages with legends of their own. classPixels() and
/// densityPixels() are alike.
[[nodiscard]] Image8 errorPixels(const ImageF& test, const ImageF& truth, const Counted& counted);
/// The colour of an error from -1 to 1 in errorPicture() and errorPixels(): red, green, blue, sRGB-encoded.
[[nodiscard]] std::array<std::uint8_t, 3> errorRgb(double error);

/// The colour-blind-safe colour of a class in pictures and plots: red, green, blue, sRGB-encoded.
[[nodiscard]] std::array<std::uint8_t, 3> classRgb(ErrorClass error_class);

/// classRgb() over a faint grey truth, with a legend that names them. The colour is as strong as the square root of
/// |test - truth|: a pixel near an edge without error stays grey.
[[nodiscard]] Image8 classPicture(const ImageOf<ErrorClass>& classes, const ImageF& test, const ImageF& truth);
[[nodiscard]] Image8 classPixels(const ImageOf<ErrorClass>& classes, const ImageF& test, const ImageF& truth);

/// Texels per pixel on a logarithmic scale from 1/16 to 16 (a sequential map, perceptually even; a white line where it
/// passes through 1), with a legend; 0 (left out) dark grey, NaN magenta.
[[nodiscard]] Image8 densityPicture(const ImageF& texels_per_pixel);
[[nodiscard]] Image8 densityPixels(const ImageF& texels_per_pixel);
/// The colour of a density in densityPicture() and densityPixels(): red, green, blue, sRGB-encoded.
[[nodiscard]] std::array<std::uint8_t, 3> densityRgb(double texels_per_pixel);

/// How many lights reach each pixel, from 1 to 32 on a logarithmic scale in the same colours; dark grey where none
/// does.
[[nodiscard]] Image8 lightCountPicture(const ImageOf<std::uint8_t>& lights);

} // namespace gnomon::lab
