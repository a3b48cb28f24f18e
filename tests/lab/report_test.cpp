// SPDX-License-Identifier: Apache-2.0
// The report's pictures: what each pixel shows, and that a legend is there whatever the size.
#include "lab/report.h"
#include "lab/src/false_colour.h"
#include "lab/src/legend.h"
#include "lab/src/lettering.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

namespace gnomon::lab {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

Colour at(const Image8& picture, std::uint32_t x, std::uint32_t y)
{
    const std::uint8_t* const rgb = picture.pixel(x, y);
    return {rgb[0], rgb[1], rgb[2]};
}

TEST(ReportError, EveryPixelHasItsColour)
{
    ImageF test(400, 1, 1, 0.5F);
    ImageF truth(400, 1, 1, 0.5F);
    Counted counted = countAll(400, 1);
    test.values[1] = 0.0F;
    truth.values[1] = 1.0F;
    test.values[2] = 1.0F;
    truth.values[2] = 0.0F;
    test.values[3] = 0.75F;
    test.values[4] = kNan;
    truth.values[5] = kNan;
    test.values[6] = kNan;
    counted.values[6] = 0;
    counted.values[7] = 0;
    const Image8 picture = errorPicture(test, truth, counted);
    const Image8 alone = errorPixels(test, truth, counted); // without its legend
    EXPECT_EQ(alone.width, test.width);
    EXPECT_EQ(alone.height, test.height);
    const std::array<Colour, 8> expected = {kWhite,      errorColour(-1.0), errorColour(1.0), errorColour(0.25),
                                            kNotANumber, kNotANumber,       kLeftOut,         kLeftOut};
    for (std::uint32_t x = 0; x < expected.size(); ++x) {
        EXPECT_EQ(at(picture, x, 0), expected[x]) << x;
        EXPECT_EQ(at(alone, x, 0), expected[x]) << x;
    }
}

TEST(ReportClasses, ColourIsAsStrongAsTheError)
{
    ImageOf<ErrorClass> classes(400, 1, 1, ErrorClass::correct);
    ImageF test(400, 1, 1, 1.0F);
    ImageF truth(400, 1, 1, 1.0F);
    classes.values[1] = ErrorClass::left_out;
    classes.values[2] = ErrorClass::acne;
    test.values[2] = 0.0F;
    classes.values[3] = ErrorClass::acne;
    test.values[3] = 0.75F;
    classes.values[4] = ErrorClass::edge; // without error
    classes.values[5] = ErrorClass::bleeding;
    truth.values[5] = 0.0F;
    truth.values[6] = test.values[6] = 0.0F;
    classes.values[7] = ErrorClass::detached;
    test.values[7] = kNan;
    const Image8 picture = classPicture(classes, test, truth);
    const std::array<Colour, 8> expected = {kFaintLight,
                                            kLeftOut,
                                            classColour(ErrorClass::acne),
                                            mixLight(kFaintLight, classColour(ErrorClass::acne), 0.5),
                                            kFaintLight,
                                            classColour(ErrorClass::bleeding),
                                            kFaintDark,
                                            kNotANumber};
    for (std::uint32_t x = 0; x < expected.size(); ++x)
        EXPECT_EQ(at(picture, x, 0), expected[x]) << x;
}

TEST(ReportDensity, ALineMarksWhereItPassesThroughOne)
{
    ImageF density(400, 2, 1);
    for (std::uint32_t x = 0; x < 400; ++x) {
        for (std::uint32_t y = 0; y < 2; ++y) // a slope through 1 between 199 and 200, and two jumps over it
            *density.pixel(x, y) = x >= 300   ? 4.0F
                                   : x >= 290 ? 0.25F
                                              : std::exp2((static_cast<float>(x) - 199.5F) / 50.0F);
    }
    *density.pixel(350, 0) = 0.0F;
    const Image8 picture = densityPicture(density);
    for (std::uint32_t x = 0; x < 400; ++x) {
        for (std::uint32_t y = 0; y < 2; ++y) {
            const Colour expected = x == 199 || x == 200 ? kWhite : densityColour(*density.pixel(x, y));
            EXPECT_EQ(at(picture, x, y), expected) << x << " " << y;
        }
    }
}

} // namespace
} // namespace gnomon::lab
