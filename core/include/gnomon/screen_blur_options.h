// SPDX-License-Identifier: Apache-2.0
// The options of Soften::blur: how the mask is blurred on the screen.
// Based on: A. S. Shastry, "Soft-Edged Shadows", 2005.
#pragma once

#include <gnomon/export.h>

#include <cstdint>
#include <string_view>

namespace gnomon {

/// The kernel of the blur.
enum class ScreenKernel : std::uint8_t {
    gaussian, // 15 taps along x, then 15 along y; standard deviation 3 times the strength
    box,      // 15 taps along x, then 15 along y, all with the same weight
    poisson,  // points of a disc in one pass, turned from pixel to pixel; the same standard deviation
};
[[nodiscard]] GNOMON_API std::string_view nameOf(ScreenKernel value);

/// The size of the images that the blur works in, relative to the mask.
enum class ScreenSize : std::uint8_t { full, half, quarter };
[[nodiscard]] GNOMON_API std::string_view nameOf(ScreenSize value);

/// The pixels that a pixel takes from at silhouettes.
enum class ScreenEdges : std::uint8_t {
    aware, // a pixel takes from pixels of its own surface alone, by depth and normal
    plain, // all pixels around, as published: shadow and light bleed over silhouettes
};
[[nodiscard]] GNOMON_API std::string_view nameOf(ScreenEdges value);

/// Where a Gaussian reads.
enum class ScreenTaps : std::uint8_t {
    symmetric, // side by side, with weights that are the same on both sides and sum to 1
    published, // the article's: only at odd offsets, heavier to one side, sum 1.067 a pass; clamped by the 8 bits
};
[[nodiscard]] GNOMON_API std::string_view nameOf(ScreenTaps value);

/// How Soften::blur blurs the mask.
struct ScreenBlurOptions {
    ScreenKernel kernel = ScreenKernel::gaussian; // the weights of the pixels around
    /// Pixels from tap to tap at full size: 0.25 .. 8. The width does not depend on `size`. A plain blur reads between
    /// pixels where a tap falls between them; an edge-aware one takes the nearest pixel.
    float strength_px = 1.0F;
    ScreenSize size = ScreenSize::full;      // smaller is faster, and coarser
    ScreenEdges edges = ScreenEdges::aware;  // whether shadow may bleed over silhouettes
    ScreenTaps taps = ScreenTaps::symmetric; // a plain Gaussian
    std::uint32_t points = 16;               // poisson: 4 .. 64
    /// 1 .. 2; 1 leaves out the second pass, along y, to show how the blur works.
    std::uint32_t passes = 2;

    bool operator==(const ScreenBlurOptions&) const = default;
};
/// Pixels of the picture on a side of a texel of such images: 1, 2 or 4.
[[nodiscard]] GNOMON_API std::uint32_t pixelsPerTexel(ScreenSize size);

} // namespace gnomon
