// SPDX-License-Identifier: Apache-2.0
// Based on: M. Okabe, K. Ito, "Color Universal Design", 2002: the colours. Departure: a grey-blue in place of black,
// which could not be tinted with.
#include "lab/tint.h"

#include "false_colour.h"
#include "image/srgb.h"
#include "legend.h"
#include "lettering.h"

#include <array>
#include <cassert>

namespace gnomon::lab {
namespace {

// Neighbours in this order are far apart in lightness too.
constexpr std::array<Colour, kMostTints> kTints{{{230, 159, 0},
                                                 {0, 114, 178},
                                                 {240, 228, 66},
                                                 {213, 94, 0},
                                                 {86, 180, 233},
                                                 {0, 158, 115},
                                                 {204, 121, 167},
                                                 {112, 128, 144}}};

// The luminance of light as a colourless surface would send it; Rec. 709.
double luminance(const std::uint8_t* rgb)
{
    return 0.2126 * decodeSrgb(rgb[0] / 255.0) + 0.7152 * decodeSrgb(rgb[1] / 255.0) +
           0.0722 * decodeSrgb(rgb[2] / 255.0);
}

// Shadows keep enough of the colour to recognise it. A pixel that is half as bright to the eye has half the strength.
constexpr double kDarkest = 0.25;

Colour tinted(Colour tint, double light)
{
    const double strength = kDarkest + (1.0 - kDarkest) * (encodeSrgb(light) / 255.0);
    const auto channel = [&](std::uint8_t c) {
        return encodeSrgb(decodeSrgb(c / 255.0) * strength);
    };
    return {channel(tint.red), channel(tint.green), channel(tint.blue)};
}

/// `colour_of` takes a pixel's place and its luminance.
template <typename ColourOf>
Image8 paint(const Image8& picture, const TintLegend& legend, const ColourOf& colour_of)
{
    assert(picture.channels == 3);
    assert(legend.kinds.size() <= kMostTints);
    Image8 result(picture.width, picture.height, 3);
    for (std::uint32_t y = 0; y < picture.height; ++y) {
        for (std::uint32_t x = 0; x < picture.width; ++x) {
            setPixel(result, x, y, colour_of(x, y, luminance(picture.pixel(x, y))));
        }
    }
    Legend shown;
    shown.title = legend.title;
    shown.subtitle = legend.subtitle;
    for (std::size_t i = 0; i < legend.kinds.size(); ++i) {
        shown.swatches.push_back({tinted(kTints[i], 0.0), kTints[i], legend.kinds[i]});
    }
    return addLegend(result, shown);
}

Colour greyOf(double light)
{
    const std::uint8_t grey = encodeSrgb(light);
    return {grey, grey, grey};
}

} // namespace

Colour tintColour(std::size_t kind)
{
    return kTints[kind % kTints.size()];
}

Image8 tintedPicture(const Image8& picture, const ImageOf<std::uint8_t>& kinds, const TintLegend& legend)
{
    assert(kinds.channels == 1 && picture.width == kinds.width && picture.height == kinds.height);
    return paint(picture, legend, [&](std::uint32_t x, std::uint32_t y, double light) {
        const std::uint8_t kind = *kinds.pixel(x, y);
        return kind == 0 ? greyOf(light) : tinted(kTints[kind - 1U], light);
    });
}

Image8 tintedPicture(const Image8& picture, const ImageF& shares, const TintLegend& legend)
{
    assert(shares.channels >= legend.kinds.size());
    assert(picture.width == shares.width && picture.height == shares.height);
    return paint(picture, legend, [&](std::uint32_t x, std::uint32_t y, double light) {
        Colour colour = greyOf(light);
        double sum = 0.0;
        // One kind after the other, each for its share of what there is so far.
        for (std::size_t i = legend.kinds.size(); i > 0; --i) {
            const double share = shares.pixel(x, y)[i - 1];
            sum += share;
            colour = share > 0.0 ? mixLight(colour, tinted(kTints[i - 1], light), share / sum) : colour;
        }
        return sum < 1.0 ? mixLight(greyOf(light), colour, sum) : colour;
    });
}

} // namespace gnomon::lab
