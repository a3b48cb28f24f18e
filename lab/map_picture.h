// SPDX-License-Identifier: Apache-2.0
// The values of maps as greys, with a legend for the greys.
#pragma once

#include "image/image.h"

#include <functional>
#include <span>
#include <string>

namespace gnomon::lab {

/// One map; ASCII, as all text here.
struct MapPanel {
    std::string name; // shown above it where there are several
    ImageF values;    // one channel; values that are not finite are black
};
struct MapLegend {
    std::string title;    // at most 43 letters
    std::string subtitle; // at most 50
    std::string low;      // texts for the least value, and the greatest
    std::string high;
    std::function<std::string(double)> text_of; // the text of a value, with its unit
};
/// The least and the greatest finite value; least > greatest where there is none.
struct ValueRange {
    float least = 0.0F;
    float greatest = 0.0F;
};
[[nodiscard]] ValueRange rangeOf(std::span<const MapPanel> panels);

/// The panels beside each other, row by row in a square, all from black (the least value of any) to white (the
/// greatest), with the legend below. A single value is black. RGB. Precondition: one panel at least, none without a
/// texel.
[[nodiscard]] Image8 mapPicture(std::span<const MapPanel> panels, const MapLegend& legend);

} // namespace gnomon::lab
