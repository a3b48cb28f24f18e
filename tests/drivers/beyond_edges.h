// SPDX-License-Identifier: Apache-2.0
// Masks of one frame by two drivers: they may place edges differently within a pixel, and nothing else.
#pragma once

#include "image/image.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace gnomon::test {

/// How many pixels of `mask` are outside the range of the 3x3 pixels of `reference` around them, by more than a tenth.
[[nodiscard]] inline std::size_t countBeyondEdges(const ImageF& mask, const ImageF& reference)
{
    constexpr float kTolerance = 0.1F;
    const auto width = static_cast<int>(reference.width);
    const auto height = static_cast<int>(reference.height);
    const auto at = [](const ImageF& image, int x, int y) {
        return image.pixel(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y))[0];
    };
    std::size_t count = 0;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            float low = at(reference, x, y);
            float high = low;
            for (int i = 0; i < 9; ++i) {
                const float near =
                    at(reference, std::clamp(x + i % 3 - 1, 0, width - 1), std::clamp(y + i / 3 - 1, 0, height - 1));
                low = std::min(low, near);
                high = std::max(high, near);
            }
            const float value = at(mask, x, y);
            // NaN is beyond.
            count += value >= low - kTolerance && value <= high + kTolerance ? 0 : 1;
        }
    }
    return count;
}

} // namespace gnomon::test
