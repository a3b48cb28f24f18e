// SPDX-License-Identifier: Apache-2.0
#include "legend.h"

#include "lettering.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace gnomon::lab {
namespace {

constexpr Colour kInk{236, 236, 236};
constexpr Colour kFaintInk{176, 176, 176};

// All in px at scale 1.
constexpr std::int64_t kMargin = 8;
constexpr std::int64_t kLine = 16; // from one line of text to the next
constexpr std::int64_t kGap = 6;   // between parts
constexpr std::int64_t kBarHeight = 16;
constexpr std::int64_t kBarWidthMax = 640;
constexpr std::int64_t kTickHeight = 4;
constexpr std::int64_t kSwatchWidth = 28;
constexpr std::int64_t kSwatchHeight = 11;
constexpr std::int64_t kSwatchSpacing = 14; // between one swatch's text and the next swatch
constexpr std::int64_t kLabelSpacing = 4;   // at least, between labels of ticks

struct Place {
    std::int64_t x = 0;
    std::int64_t y = 0;
};

// A picture 1280 px wide is mostly looked at in half its size; a flat strip is not made mostly legend.
std::int64_t scaleFor(const Image8& picture)
{
    const std::int64_t side = std::min<std::int64_t>(picture.width, 2LL * picture.height);
    return std::clamp<std::int64_t>(side / 640, 1, 4);
}

std::int64_t swatchExtent(const Swatch& swatch)
{
    return kSwatchWidth + kGap + textWidth(swatch.text, Font::normal);
}

// In lines from left to right, each as full as it can be.
std::vector<Place> placeSwatches(const std::vector<Swatch>& swatches, std::int64_t room)
{
    std::vector<Place> places;
    Place next;
    for (const Swatch& swatch : swatches) {
        const std::int64_t extent = swatchExtent(swatch);
        if (next.x > 0 && next.x + extent > room) {
            next = {0, next.y + kLine};
        }
        places.push_back(next);
        next.x += extent + kSwatchSpacing;
    }
    return places;
}

// Draws at scale 1's coordinates into a picture of any scale, from `top` down.
class LegendPainter {
public:
    LegendPainter(Image8& picture, std::int64_t scale, std::int64_t top_px)
        : picture_(picture), scale_(scale), top_px_(top_px)
    {
    }
    void write(std::int64_t x, std::int64_t y, std::string_view text, Font font, Colour colour)
    {
        drawText(picture_, x * scale_, top_px_ + y * scale_, text, font, scale_, colour);
    }
    void fill(std::int64_t x, std::int64_t y, std::int64_t width, std::int64_t height, Colour colour)
    {
        fillRectangle(picture_, x * scale_, top_px_ + y * scale_, width * scale_, height * scale_, colour);
    }
    // Column by column of the picture, so that the colours run smoothly at every scale.
    void fillGradient(std::int64_t x, std::int64_t y, std::int64_t width, std::int64_t height,
                      const std::function<Colour(double)>& colour_at)
    {
        const std::int64_t width_px = width * scale_;
        for (std::int64_t i = 0; i < width_px; ++i) {
            const double place = static_cast<double>(i) / static_cast<double>(width_px - 1);
            fillRectangle(picture_, x * scale_ + i, top_px_ + y * scale_, 1, height * scale_, colour_at(place));
        }
    }
    void drawBar(const ScaleBar& bar, std::int64_t y, std::int64_t width);
    void drawSwatch(const Swatch& swatch, Place place);

private:
    void drawTicks(const ScaleBar& bar, std::int64_t y, std::int64_t width);

    Image8& picture_;
    std::int64_t scale_;
    std::int64_t top_px_;
};

void LegendPainter::drawTicks(const ScaleBar& bar, std::int64_t y, std::int64_t width)
{
    struct Span {
        std::int64_t from;
        std::int64_t to;
    };
    std::vector<Span> taken;
    for (const Tick& tick : bar.ticks) {
        const std::int64_t at = std::llround(tick.place * static_cast<double>(width - 1));
        const std::int64_t label = textWidth(tick.label, Font::normal);
        const std::int64_t from = std::clamp<std::int64_t>(at - label / 2, 0, width - label);
        const Span span{from - kLabelSpacing, from + label + kLabelSpacing};
        const bool free = std::none_of(taken.begin(), taken.end(), [&](const Span& other) {
            return span.from + kLabelSpacing < other.to && other.from + kLabelSpacing < span.to;
        });
        fill(kMargin + at, y, 1, free ? kTickHeight : kTickHeight / 2, kInk);
        if (!free) {
            continue;
        }
        taken.push_back(span);
        write(kMargin + from, y + kTickHeight, tick.label, Font::normal, kInk);
    }
}

void LegendPainter::drawBar(const ScaleBar& bar, std::int64_t y, std::int64_t width)
{
    fillGradient(kMargin, y, width, kBarHeight, bar.colour_at);
    drawTicks(bar, y + kBarHeight, width);
    const std::int64_t words_y = y + kBarHeight + kTickHeight + kLine;
    write(kMargin, words_y, bar.low, Font::normal, kFaintInk);
    write(kMargin + (width - textWidth(bar.middle, Font::normal)) / 2, words_y, bar.middle, Font::normal, kFaintInk);
    write(kMargin + width - textWidth(bar.high, Font::normal), words_y, bar.high, Font::normal, kFaintInk);
}

void LegendPainter::drawSwatch(const Swatch& swatch, Place place)
{
    // The rim keeps a box visible whose colour is near the ground's.
    const std::int64_t box_y = place.y + (kLetterHeight - kSwatchHeight) / 2;
    fill(place.x, box_y, kSwatchWidth, kSwatchHeight, kFaintInk);
    fillGradient(place.x + 1, box_y + 1, kSwatchWidth - 2, kSwatchHeight - 2,
                 [&](double t) { return mixLight(swatch.from, swatch.to, t); });
    write(place.x + kSwatchWidth + kGap, place.y, swatch.text, Font::normal, kInk);
}

Image8 enlarge(const Image8& picture, std::uint32_t times)
{
    Image8 large(picture.width * times, picture.height * times, picture.channels);
    for (std::uint32_t y = 0; y < large.height; ++y) {
        for (std::uint32_t x = 0; x < large.width; ++x) {
            std::copy_n(picture.pixel(x / times, y / times), picture.channels, large.pixel(x, y));
        }
    }
    return large;
}

Image8 makeCanvas(const Image8& picture, std::uint32_t legend_height)
{
    Image8 canvas(std::max(picture.width, kLegendMinimumWidth), picture.height + legend_height, 3);
    fillRectangle(canvas, 0, 0, canvas.width, canvas.height, kLegendGround);
    const std::uint32_t left = (canvas.width - picture.width) / 2;
    for (std::uint32_t y = 0; y < picture.height; ++y) {
        std::copy_n(picture.pixel(0, y), static_cast<std::size_t>(picture.width) * 3, canvas.pixel(left, y));
    }
    return canvas;
}

} // namespace

std::uint32_t enlargementOf(std::uint32_t width, std::uint32_t height)
{
    return std::max(1U, kLegendMinimumWidth / std::max({width, height, 1U}));
}

Image8 addLegend(const Image8& original, const Legend& legend)
{
    assert(original.channels == 3);
    const std::uint32_t times = enlargementOf(original.width, original.height);
    const Image8 larger = times > 1 ? enlarge(original, times) : Image8();
    const Image8& picture = times > 1 ? larger : original;
    const std::int64_t scale = scaleFor(picture);
    const std::int64_t room = std::max<std::int64_t>(picture.width, kLegendMinimumWidth) / scale - 2 * kMargin;
    const std::vector<Place> places = placeSwatches(legend.swatches, room);

    constexpr std::int64_t bar_extent = kBarHeight + kTickHeight + 2 * kLine;
    const std::int64_t bar_y = kMargin + kLine + (legend.subtitle.empty() ? 0 : kLine) + kGap / 2;
    const std::int64_t swatches_y = bar_y + (legend.bar ? bar_extent + kGap : 0);
    const std::int64_t swatches_end = places.empty() ? swatches_y - kGap : swatches_y + places.back().y + kLetterHeight;

    Image8 canvas = makeCanvas(picture, static_cast<std::uint32_t>((swatches_end + kMargin) * scale));
    LegendPainter painter(canvas, scale, picture.height);
    painter.write(kMargin, kMargin, legend.title, Font::bold, kInk);
    painter.write(kMargin, kMargin + kLine, legend.subtitle, Font::normal, kFaintInk);
    if (legend.bar) {
        painter.drawBar(*legend.bar, bar_y, std::min(room, kBarWidthMax));
    }
    for (std::size_t i = 0; i < places.size(); ++i) {
        painter.drawSwatch(legend.swatches[i], {kMargin + places[i].x, swatches_y + places[i].y});
    }
    return canvas;
}

} // namespace gnomon::lab
