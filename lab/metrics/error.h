// SPDX-License-Identifier: Apache-2.0
// The error of a mask against another. Images have one channel, values in [0, 1] where they are masks, and one size.
#pragma once

#include "image/image.h"

#include <cstdint>
#include <optional>

namespace gnomon::lab {

/// 1 where a pixel counts, 0 where it is left out; one channel, the size of the masks.
using Counted = ImageOf<std::uint8_t>;

/// Numbers of e = test - truth over the counted pixels.
struct ErrorNumbers {
    double rmse = 0.0; // sqrt(mean e^2), [0, 1] for masks; 0 is best
    double mae = 0.0;  // mean |e|
    double bias = 0.0; // mean e: above 0 the test is too bright
    double p99 = 0.0;  // 99th percentile of |e|: the smallest value that at least 99 % of the pixels do not exceed
};
/// Nothing when no pixel counts. Precondition: same size, one channel each. A NaN in an image makes every number NaN,
/// so masks must have none and readers must check for it.
[[nodiscard]] std::optional<ErrorNumbers> errorNumbers(const ImageF& test, const ImageF& truth, const Counted& counted);

/// All pixels count.
[[nodiscard]] Counted countAll(std::uint32_t width, std::uint32_t height);

/// The pixels that count in `counted` and not in `other`, which are of one size.
[[nodiscard]] Counted without(const Counted& counted, const Counted& other);

/// Mean structural similarity over the counted pixels, [-1, 1], 1 for equal images; nothing when no pixel counts. An
/// 11x11 Gaussian window of sigma 1.5, K1 = 0.01, K2 = 0.03, range 1; at the border the window is cut and renormalised.
/// Pixels that do not count hold the truth in both images. Based on: Z. Wang, A. C. Bovik, H. R. Sheikh, E. P.
/// Simoncelli, "Image Quality Assessment: From Error Visibility to Structural Similarity", 2004, eq. 13.
[[nodiscard]] std::optional<double> ssim(const ImageF& test, const ImageF& truth, const Counted& counted);

} // namespace gnomon::lab
