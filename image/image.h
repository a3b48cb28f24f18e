// SPDX-License-Identifier: Apache-2.0
// Images in memory, rows from the top. Knows nothing of files or GPUs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon {

/// `channels` interleaved values of type T per pixel.
template <typename T>
struct ImageOf {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::uint32_t channels = 0;
    std::vector<T> values; // width * height * channels

    ImageOf() = default;
    ImageOf(std::uint32_t w, std::uint32_t h, std::uint32_t c, T fill = T{})
        : width(w), height(h), channels(c), values(static_cast<std::size_t>(w) * h * c, fill)
    {
    }
    [[nodiscard]] T* pixel(std::uint32_t x, std::uint32_t y)
    {
        return values.data() + (static_cast<std::size_t>(y) * width + x) * channels;
    }
    [[nodiscard]] const T* pixel(std::uint32_t x, std::uint32_t y) const
    {
        return values.data() + (static_cast<std::size_t>(y) * width + x) * channels;
    }
};

using Image8 = ImageOf<std::uint8_t>; // sRGB-encoded when it is a picture
using Image16 = ImageOf<std::uint16_t>;
using ImageF = ImageOf<float>; // linear

} // namespace gnomon
