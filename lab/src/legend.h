// SPDX-License-Identifier: Apache-2.0
// The meaning of a picture's colours, written below it.
#pragma once

#include "false_colour.h"
#include "image/image.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::lab {

inline constexpr std::uint32_t kLegendMinimumWidth = 320; // px
inline constexpr Colour kLegendGround{18, 18, 18};

struct Tick {
    double place = 0.0; // along the bar, [0, 1]
    std::string label;
};
/// A bar of colours with ticks below it. Where labels would touch, those of later ticks are left out, so the most
/// important come first.
struct ScaleBar {
    std::function<Colour(double)> colour_at; // the colour of a place in [0, 1]
    std::vector<Tick> ticks;
    std::string low; // below the bar's left end, middle and right end
    std::string middle;
    std::string high;
};
/// A box that goes from one colour to another, and its meaning.
struct Swatch {
    Colour from;
    Colour to;
    std::string text;
};
/// ASCII. A line of text has room for 43 bold or 50 normal letters in the narrowest legend.
struct Legend {
    std::string title;
    std::string subtitle;
    std::optional<ScaleBar> bar;
    std::vector<Swatch> swatches;
};

/// By how many times a picture is shown larger, so that one of a few pixels is more than a dot above its legend: the
/// largest whole number that keeps width and height within kLegendMinimumWidth, 1 at least.
[[nodiscard]] std::uint32_t enlargementOf(std::uint32_t width, std::uint32_t height);

/// `picture` is RGB. The result holds it on top, each pixel a square of enlargementOf() px, in the middle when it is
/// narrower than kLegendMinimumWidth. Letters grow with the picture, so that they can be read when it is shown smaller.
[[nodiscard]] Image8 addLegend(const Image8& picture, const Legend& legend);

} // namespace gnomon::lab
