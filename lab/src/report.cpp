// SPDX-License-Identifier: Apache-2.0
#include "lab/report.h"

#include "false_colour.h"
#include "lab/metrics/same_shape.h"
#include "legend.h"
#include "lettering.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

namespace gnomon::lab {
namespace {

// `colour_of` takes the number of a pixel, from the first row's left.
template <typename ColourOf>
Image8 paint(std::uint32_t width, std::uint32_t height, const ColourOf& colour_of)
{
    Image8 picture(width, height, 3);
    std::size_t i = 0;
    for (std::uint32_t y = 0; y < height; ++y) {
        for (std::uint32_t x = 0; x < width; ++x, ++i) {
            setPixel(picture, x, y, colour_of(i));
        }
    }
    return picture;
}

// Not a number is named only where it is seen.
Image8 withLegend(const Image8& picture, Legend legend)
{
    bool any = false;
    for (std::size_t i = 0; i < picture.values.size() && !any; i += 3) {
        any = Colour{picture.values[i], picture.values[i + 1], picture.values[i + 2]} == kNotANumber;
    }
    if (any) {
        legend.swatches.push_back({kNotANumber, kNotANumber, "not a number"});
    }
    return addLegend(picture, legend);
}

Legend errorLegend()
{
    ScaleBar bar;
    bar.colour_at = [](double place) {
        const double s = 2.0 * place - 1.0;
        return errorColour(s * std::abs(s));
    };
    bar.ticks.push_back({0.5, "0"});
    constexpr std::pair<double, const char*> marks[] = {{1.0, "1"},     {0.1, "0.1"},   {0.5, "0.5"},
                                                        {0.01, "0.01"}, {0.25, "0.25"}, {0.75, "0.75"}};
    for (const auto& [error, number] : marks) {
        bar.ticks.push_back({0.5 - 0.5 * std::sqrt(error), std::string("-") + number});
        bar.ticks.push_back({0.5 + 0.5 * std::sqrt(error), std::string("+") + number});
    }
    bar.low = "too dark";
    bar.middle = "no error";
    bar.high = "too bright";
    return {"Error: technique - truth",
            "scale: square root, to show small errors",
            bar,
            {{kLeftOut, kLeftOut, "left out"}}};
}

Legend classLegend()
{
    // From the grey that the class lies over.
    const auto swatch = [](Colour over, ErrorClass error_class, const char* text) {
        return Swatch{over, classColour(error_class), text};
    };
    return {"Where the error comes from",
            "stronger colour: larger error (square root)",
            std::nullopt,
            {swatch(kFaintDark, ErrorClass::edge, "edge: aliasing, penumbra width"),
             swatch(kFaintLight, ErrorClass::acne, "acne: false self-shadowing"),
             swatch(kFaintDark, ErrorClass::detached, "detached: peter-panning"),
             swatch(kFaintDark, ErrorClass::bleeding, "bleeding: light leaks"),
             swatch(kFaintDark, ErrorClass::terminator, "terminator: smooth body turns away"),
             swatch(kFaintDark, ErrorClass::correct, "no error: the truth in grey"),
             {kLeftOut, kLeftOut, "left out"}}};
}

Legend densityLegend()
{
    ScaleBar bar;
    bar.colour_at = [](double place) {
        return std::abs(place - 0.5) < 0.002 ? kWhite : densityColour(std::exp2((2.0 * place - 1.0) * kDensityOctaves));
    };
    constexpr std::array<const char*, 9> labels = {"1/16", "1/8", "1/4", "1/2", "1", "2", "4", "8", "16"};
    for (std::size_t i = 0; i < labels.size(); ++i) {
        bar.ticks.push_back({static_cast<double>(i) / (labels.size() - 1), labels[i]});
    }
    bar.low = "blocky";
    bar.middle = "one to one";
    bar.high = "finer than pixels";
    return {"Shadow texels per screen pixel",
            "along the worse axis; scale: logarithmic",
            bar,
            {{kWhite, kWhite, "passes through 1"}, {kLeftOut, kLeftOut, "left out"}}};
}

Legend lightCountLegend()
{
    ScaleBar bar;
    bar.colour_at = [](double place) {
        return lightCountColour(static_cast<std::uint32_t>(std::lround(std::exp2(place * kLightOctaves))));
    };
    for (int octave = 0; octave <= static_cast<int>(kLightOctaves); ++octave) {
        bar.ticks.push_back({octave / kLightOctaves, std::to_string(1 << octave)});
    }
    bar.low = "one light";
    bar.high = "32 or more";
    return {"Lights with a shadow that reach a pixel",
            "facing it, within range and cone; scale: logarithmic",
            bar,
            {{kLeftOut, kLeftOut, "none"}}};
}

// Two neighbours on different sides of 1 are a line, unless they lie farther apart than a factor of 2: then they are
// two surfaces, and nothing passes through 1.
bool passesThroughOne(float a, float b)
{
    return a > 0.0F && b > 0.0F && (a >= 1.0F) != (b >= 1.0F) && a <= 2.0F * b && b <= 2.0F * a;
}

void drawLineAtOne(Image8& picture, const ImageF& density)
{
    const auto mark = [&](std::uint32_t x, std::uint32_t y, std::uint32_t to_x, std::uint32_t to_y) {
        if (passesThroughOne(*density.pixel(x, y), *density.pixel(to_x, to_y))) {
            setPixel(picture, x, y, kWhite);
            setPixel(picture, to_x, to_y, kWhite);
        }
    };
    for (std::uint32_t y = 0; y < density.height; ++y) {
        for (std::uint32_t x = 0; x < density.width; ++x) {
            if (x + 1 < density.width) {
                mark(x, y, x + 1, y);
            }
            if (y + 1 < density.height) {
                mark(x, y, x, y + 1);
            }
        }
    }
}

} // namespace

Image8 errorPixels(const ImageF& test, const ImageF& truth, const Counted& counted)
{
    assert(areMasksOfOneSize(test, truth) && areMasksOfOneSize(test, counted));
    const auto colour_of = [&](std::size_t i) {
        return counted.values[i] == 0 ? kLeftOut : errorColour(test.values[i] - truth.values[i]);
    };
    return paint(test.width, test.height, colour_of);
}

Image8 errorPicture(const ImageF& test, const ImageF& truth, const Counted& counted)
{
    return withLegend(errorPixels(test, truth, counted), errorLegend());
}

std::array<std::uint8_t, 3> errorRgb(double error)
{
    const Colour colour = errorColour(error);
    return {colour.red, colour.green, colour.blue};
}

std::array<std::uint8_t, 3> classRgb(ErrorClass error_class)
{
    const Colour colour = classColour(error_class);
    return {colour.red, colour.green, colour.blue};
}

Image8 classPixels(const ImageOf<ErrorClass>& classes, const ImageF& test, const ImageF& truth)
{
    assert(areMasksOfOneSize(classes, test) && areMasksOfOneSize(test, truth));
    const auto colour_of = [&](std::size_t i) {
        if (classes.values[i] == ErrorClass::left_out) {
            return kLeftOut;
        }
        const double error = std::abs(static_cast<double>(test.values[i]) - truth.values[i]);
        if (std::isnan(error)) {
            return kNotANumber;
        }
        const Colour grey = mixLight(kFaintDark, kFaintLight, std::clamp(truth.values[i], 0.0F, 1.0F));
        return classes.values[i] == ErrorClass::correct
                   ? grey
                   : mixLight(grey, classColour(classes.values[i]), std::sqrt(std::min(error, 1.0)));
    };
    return paint(classes.width, classes.height, colour_of);
}

Image8 classPicture(const ImageOf<ErrorClass>& classes, const ImageF& test, const ImageF& truth)
{
    return withLegend(classPixels(classes, test, truth), classLegend());
}

Image8 densityPixels(const ImageF& texels_per_pixel)
{
    assert(texels_per_pixel.channels == 1);
    Image8 picture = paint(texels_per_pixel.width, texels_per_pixel.height,
                           [&](std::size_t i) { return densityColour(texels_per_pixel.values[i]); });
    drawLineAtOne(picture, texels_per_pixel);
    return picture;
}

Image8 densityPicture(const ImageF& texels_per_pixel)
{
    return withLegend(densityPixels(texels_per_pixel), densityLegend());
}

std::array<std::uint8_t, 3> densityRgb(double texels_per_pixel)
{
    const Colour colour = densityColour(texels_per_pixel);
    return {colour.red, colour.green, colour.blue};
}

Image8 lightCountPicture(const ImageOf<std::uint8_t>& lights)
{
    assert(lights.channels == 1);
    return addLegend(
        paint(lights.width, lights.height, [&](std::size_t i) { return lightCountColour(lights.values[i]); }),
        lightCountLegend());
}

} // namespace gnomon::lab
