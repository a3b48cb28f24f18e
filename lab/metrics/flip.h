// SPDX-License-Identifier: Apache-2.0
// The perceived difference of two pictures when one flips between them.
// Based on: P. Andersson, J. Nilsson, T. Akenine-Moeller, M. Oskarsson, K. Astroem, M. D. Fairchild, "FLIP: A
// Difference Evaluator for Alternating Images", 2020.
#pragma once

#include "image/image.h"
#include "lab/metrics/error.h"

#include <optional>

namespace gnomon::lab {

/// 0.7 m from a monitor 0.7 m and 3840 pixels wide.
inline constexpr double kFlipPixelsPerDegree = 67.0;
inline constexpr double kFlipLeastPixelsPerDegree = 1.0;
inline constexpr double kFlipMostPixelsPerDegree = 10000.0;

/// The FLIP difference of every pixel, [0, 1], in one channel. `test` and `reference` are linear RGB (3 channels) in
/// [0, 1]; values beyond are clamped, and NaN stays NaN in every pixel that sees it. Symmetric in its images.
/// Precondition: same size, `pixels_per_degree` within the limits above.
[[nodiscard]] ImageF flipMap(const ImageF& test, const ImageF& reference,
                             double pixels_per_degree = kFlipPixelsPerDegree);

/// Mean of flipMap over the counted pixels for two masks shown as grey light; pixels that do not count hold the truth
/// in both. Nothing when no pixel counts. Precondition: same size, one channel each, `pixels_per_degree` within the
/// limits of flipMap().
[[nodiscard]] std::optional<double> flip(const ImageF& test, const ImageF& truth, const Counted& counted,
                                         double pixels_per_degree = kFlipPixelsPerDegree);

} // namespace gnomon::lab
