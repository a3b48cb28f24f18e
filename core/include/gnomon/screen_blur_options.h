// SPDX-License-Identifier: Apache-2.0
// The options of Soften::blur: how the mask is blurred on the screen.
// Based on: A. S. Shastry, "Soft-Edged Shadows", 2005.
#pragma once

#include <gnomon/export.h>

#include <cstdint>
#include <string_view>

namespace gnomon {

/// What weighs the pixels around.
enum class ScreenKernel : std::uint8_t {
    gaussian, // 15 taps along x, then 15 along y; standard deviation 3 times the strength
    box,      // likewise, all of one weight
    poisson,  // points of a disc in one pass, turned from pixel to pixel; of the same standard deviation
};
[[nodiscard]] GNOMON_API std::string_view nameOf(ScreenKernel value);

/// Of the images that the blur is worked out in, against the mask.
enum class ScreenSize : std::uint8_t { full, half, quarter };
[[nodiscard]] GNOMON_API std::string_view nameOf(ScreenSize value);

/// What a pixel takes from at silhouettes.
enum class ScreenEdges : std::uint8_t {
    aware, // a pixel takes from pixels of its own surface alone, by depth and normal
    plain, // from all around, as published: shadow and light bleed over silhouettes
};
[[nodiscard]] GNOMON_API std::string_view nameOf(ScreenEdges value);

/// Where a Gaussian reads.
enum class ScreenTaps : std::uint8_t {
    symmetric, // side by side, of weights that are the same to both sides and sum to 1
    published, // the article's: at odd offsets alone, heavier to one side, of sum 1.067 a pass; clamped by the 8 bits
};
[[nodiscard]] GNOMON_API std::string_view nameOf(ScreenTaps value);

/// How Soften::blur blurs the mask.
struct ScreenBlurOptions {
    ScreenKernel kernel = ScreenKernel::gaussian; // what weighs the pixels around
    /// Pixels from tap to tap at full size: 0.25 .. 8. The blur is as wide whatever the size is. A plain blur reads
    /// between pixels where a tap falls between them; one that is aware of edges takes the nearest pixel.
    float strength_px = 1.0F;
    ScreenSize size = ScreenSize::full;      // smaller is faster, and coarser
    ScreenEdges edges = ScreenEdges::aware;  // whether shadow may bleed over silhouettes
    ScreenTaps taps = ScreenTaps::symmetric; // of a plain Gaussian
    std::uint32_t points = 16;               // poisson: 4 .. 64
    /// To look at the blur at work: 1 leaves out the second pass, along y. 1 .. 2.
    std::uint32_t passes = 2;

    bool operator==(const ScreenBlurOptions&) const = default;
};
/// Pixels of the picture on a side of a texel of such images: 1, 2 or 4.
[[nodiscard]] GNOMON_API std::uint32_t pixelsPerTexel(ScreenSize size);

} // namespace gnomon
