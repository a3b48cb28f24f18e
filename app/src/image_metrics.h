// SPDX-License-Identifier: Apache-2.0
// Error numbers of two images of any kind.
#pragma once

#include "image/image.h"
#include "lab/metrics/error.h"

#include <cstdint>
#include <string_view>

namespace gnomon::app {

/// 3 or 4 channels; else grey, with or without alpha.
[[nodiscard]] bool isColour(const ImageF& image);

struct ImageMetrics {
    std::string_view interpretation; // the meaning that the values were taken to have
    std::uint32_t channels = 0;      // that were compared: 1 or 3
    lab::ErrorNumbers error;         // over all values of all channels
    double ssim = 0.0;
    double flip = 0.0;
    std::uint64_t counted = 0; // pixels
};
/// Grey values are linear visibility; `encoded` colours are sRGB-encoded, others linear. Colours' rmse, mae, bias and
/// p99 are of the values as stored, ssim is of their Rec. 709 luminance, flip of the linear colours. Alpha is ignored.
/// Precondition: same size, at least one pixel, both grey or both colour, all values finite.
[[nodiscard]] ImageMetrics measureImages(const ImageF& test, const ImageF& truth, bool encoded);

} // namespace gnomon::app
