// SPDX-License-Identifier: Apache-2.0
// A picture whose pixels are coloured by kind, with a legend that names the kinds.
#pragma once

#include "image/image.h"

#include <cstdint>
#include <string>
#include <vector>

namespace gnomon::lab {

/// How many kinds have a colour of their own.
inline constexpr std::size_t kMostTints = 8;

struct TintLegend {
    std::string title; // ASCII, at most 43 letters
    std::string subtitle;
    std::vector<std::string> kinds; // names of kinds 1, 2, ...; at most kMostTints
};

/// `picture` (RGB) with each pixel of kind k > 0 in that kind's colour, as bright as it was, and those of kind 0 grey.
/// The colours can be told apart with any of the usual colour deficiencies. RGB, with the legend below. Precondition:
/// one size, one channel of kinds, none beyond legend.kinds.
[[nodiscard]] Image8 tintedPicture(const Image8& picture, const ImageOf<std::uint8_t>& kinds, const TintLegend& legend);

/// tintedPicture() where a pixel may be of several kinds at once: channel k - 1 of `shares`, which add up to at most 1,
/// is its share of kind k. Colours are mixed as light; the rest to 1 is grey. It has as many channels as legend.kinds,
/// or more, which are grey too.
[[nodiscard]] Image8 tintedPicture(const Image8& picture, const ImageF& shares, const TintLegend& legend);

} // namespace gnomon::lab
