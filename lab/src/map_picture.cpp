// SPDX-License-Identifier: Apache-2.0
#include "lab/map_picture.h"

#include "legend.h"
#include "lettering.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace gnomon::lab {
namespace {

constexpr std::uint32_t kGap_px = 4;
constexpr std::uint32_t kNameHeight_px = 18;
constexpr Colour kNameInk{236, 236, 236};

Colour greyOf(double share)
{
    const auto grey = static_cast<std::uint8_t>(std::lround(share * 255.0));
    return {grey, grey, grey};
}

void paintPanel(Image8& picture, const MapPanel& panel, const ValueRange& range, std::uint32_t left, std::uint32_t top)
{
    const float span = range.greatest - range.least;
    for (std::uint32_t y = 0; y < panel.values.height; ++y) {
        for (std::uint32_t x = 0; x < panel.values.width; ++x) {
            const float value = *panel.values.pixel(x, y);
            const bool has_share = span > 0.0F && std::isfinite(value);
            const double share = has_share ? static_cast<double>((value - range.least) / span) : 0.0;
            setPixel(picture, left + x, top + y, greyOf(share));
        }
    }
}

Image8 paintAll(std::span<const MapPanel> panels, const ValueRange& range)
{
    const auto count = static_cast<std::uint32_t>(panels.size());
    const auto columns = static_cast<std::uint32_t>(std::ceil(std::sqrt(static_cast<double>(count))));
    const std::uint32_t rows = (count + columns - 1) / columns;
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    for (const MapPanel& panel : panels) {
        width = std::max(width, panel.values.width);
        height = std::max(height, panel.values.height);
    }
    const std::uint32_t name_height = count > 1 ? kNameHeight_px : 0;
    const std::uint32_t step_y = height + name_height + kGap_px;
    Image8 picture(columns * (width + kGap_px) - kGap_px, rows * step_y - kGap_px, 3);
    fillRectangle(picture, 0, 0, picture.width, picture.height, kLegendGround);
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t left = i % columns * (width + kGap_px);
        const std::uint32_t top = i / columns * step_y;
        if (count > 1) {
            drawText(picture, left + 2, top + 2, panels[i].name, Font::normal, 1, kNameInk);
        }
        paintPanel(picture, panels[i], range, left, top + name_height);
    }
    return picture;
}

} // namespace

ValueRange rangeOf(std::span<const MapPanel> panels)
{
    constexpr float kNone = std::numeric_limits<float>::infinity();
    ValueRange range{kNone, -kNone};
    for (const MapPanel& panel : panels) {
        for (const float value : panel.values.values) {
            if (std::isfinite(value)) {
                range = {std::min(range.least, value), std::max(range.greatest, value)};
            }
        }
    }
    return range;
}

Image8 mapPicture(std::span<const MapPanel> panels, const MapLegend& legend)
{
    assert(!panels.empty());
    const ValueRange range = rangeOf(panels);
    Legend shown;
    shown.title = legend.title;
    shown.subtitle = legend.subtitle;
    shown.bar = ScaleBar{greyOf, {}, legend.low, "", legend.high};
    for (const double place : {0.0, 1.0, 0.5, 0.25, 0.75}) { // the ends come first
        if (range.least <= range.greatest) {
            const double value = static_cast<double>(range.least) +
                                 place * (static_cast<double>(range.greatest) - static_cast<double>(range.least));
            shown.bar->ticks.push_back({place, legend.text_of(value)});
        }
    }
    return addLegend(paintAll(panels, range), shown);
}

} // namespace gnomon::lab
