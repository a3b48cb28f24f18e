// SPDX-License-Identifier: Apache-2.0
// The report's pictures: what each pixel shows, and that a legend is there whatever the size.
#include "lab/report.h"
#include "lab/src/false_colour.h"
#include "lab/src/legend.h"
#include "lab/src/lettering.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::lab {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

Colour at(const Image8& picture, std::uint32_t x, std::uint32_t y)
{
    const std::uint8_t* const rgb = picture.pixel(x, y);
    return {rgb[0], rgb[1], rgb[2]};
}

std::size_t countColour(const Image8& picture, std::uint32_t from_row, Colour colour)
{
    std::size_t count = 0;
    for (std::uint32_t y = from_row; y < picture.height; ++y) {
        for (std::uint32_t x = 0; x < picture.width; ++x)
            count += at(picture, x, y) == colour ? 1U : 0U;
    }
    return count;
}

// Nothing is written into the margins, so nothing is cut at the border.
void expectLegend(const Image8& picture, std::uint32_t image_height)
{
    ASSERT_EQ(picture.channels, 3U);
    ASSERT_GE(picture.width, kLegendMinimumWidth);
    ASSERT_GT(picture.height, image_height + 60U);
    std::size_t drawn = 0;
    for (std::uint32_t y = image_height; y < picture.height; ++y) {
        for (std::uint32_t x = 0; x < picture.width; ++x) {
            if (at(picture, x, y) == kLegendGround)
                continue;
            ++drawn;
            EXPECT_TRUE(x >= 8 && x + 8 < picture.width && y + 8 < picture.height) << x << " " << y;
        }
    }
    EXPECT_GT(drawn, 500U); // letters
}

struct Size {
    std::uint32_t width;
    std::uint32_t height;
};
constexpr std::array<Size, 6> kSizes = {{{1, 1}, {319, 7}, {320, 200}, {641, 480}, {1280, 720}, {4000, 10}}};

TEST(ReportPictures, KeepTheirSizeAboveALegend)
{
    for (const Size size : kSizes) {
        SCOPED_TRACE(std::to_string(size.width) + "x" + std::to_string(size.height));
        const ImageF one(size.width, size.height, 1, 1.0F);
        const ImageOf<ErrorClass> classes(size.width, size.height, 1, ErrorClass::acne);
        for (const Image8& picture : {errorPicture(one, one, countAll(size.width, size.height)),
                                      classPicture(classes, one, one), densityPicture(one)}) {
            EXPECT_EQ(picture.width, std::max(size.width, kLegendMinimumWidth));
            expectLegend(picture, size.height * enlargementOf(size.width, size.height));
        }
    }
}

TEST(ReportPictures, SmallOnesAreShownLargerInTheMiddle)
{
    EXPECT_EQ(enlargementOf(1, 1), 320U);
    EXPECT_EQ(enlargementOf(7, 3), 45U);
    EXPECT_EQ(enlargementOf(3, 7), 45U);
    EXPECT_EQ(enlargementOf(161, 1), 1U);
    EXPECT_EQ(enlargementOf(20, 4000), 1U);
    EXPECT_EQ(enlargementOf(0, 0), 320U);
    ImageF dark(100, 4, 1, 0.0F);
    const ImageF lit(100, 4, 1, 1.0F);
    *dark.pixel(99, 3) = 1.0F;
    const Image8 picture = errorPicture(dark, lit, countAll(100, 4));
    ASSERT_EQ(picture.width, 320U); // three px for one, and 10 on each side
    for (std::uint32_t y = 0; y < 12; ++y) {
        for (std::uint32_t x = 0; x < 320; ++x) {
            const Colour inside = x >= 307 && y >= 9 ? kWhite : errorColour(-1.0);
            EXPECT_EQ(at(picture, x, y), x >= 10 && x < 310 ? inside : kLegendGround) << x << " " << y;
        }
    }
}

TEST(ReportPictures, AnEmptyPictureIsALegend)
{
    const ImageF none(0, 0, 1);
    expectLegend(errorPicture(none, none, Counted(0, 0, 1)), 0);
    expectLegend(densityPicture(none), 0);
}

TEST(ReportPictures, LegendsGrowWithThePicture)
{
    const auto legendHeight = [](std::uint32_t width, std::uint32_t height) {
        return densityPicture(ImageF(width, height, 1, 1.0F)).height - height;
    };
    EXPECT_EQ(legendHeight(1280, 720), 2 * legendHeight(640, 360));
    EXPECT_EQ(legendHeight(4000, 10), legendHeight(640, 360)); // a strip keeps small letters
}

TEST(ReportPictures, LegendsOfNarrowPicturesWrap)
{
    const auto legendHeight = [](std::uint32_t width) {
        const ImageF one(width, 100, 1, 1.0F);
        return classPicture(ImageOf<ErrorClass>(width, 100, 1, ErrorClass::edge), one, one).height - 100;
    };
    EXPECT_GT(legendHeight(320), legendHeight(639));
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

TEST(ReportError, TheScaleIsInTheLegend)
{
    const ImageF one(640, 10, 1, 1.0F);
    const Image8 picture = errorPicture(one, one, countAll(640, 10));
    // The bar's first and last column, and the middle.
    EXPECT_GE(countColour(picture, 10, errorColour(-1.0)), 16U);
    EXPECT_GE(countColour(picture, 10, errorColour(1.0)), 16U);
    EXPECT_GE(countColour(picture, 10, kWhite), 16U);
    EXPECT_GE(countColour(picture, 10, kLeftOut), 200U);
}

TEST(ReportLegend, NamesNotANumberOnlyWhereThereIsOne)
{
    ImageF one(640, 10, 1, 1.0F);
    const ImageOf<ErrorClass> classes(640, 10, 1, ErrorClass::edge);
    EXPECT_EQ(countColour(densityPicture(one), 0, kNotANumber), 0U);
    EXPECT_EQ(countColour(errorPicture(one, one, countAll(640, 10)), 0, kNotANumber), 0U);
    EXPECT_EQ(countColour(classPicture(classes, one, one), 0, kNotANumber), 0U);
    const ImageF truth = one;
    one.values[5] = kNan;
    EXPECT_GT(countColour(densityPicture(one), 10, kNotANumber), 100U);
    EXPECT_GT(countColour(errorPicture(one, truth, countAll(640, 10)), 10, kNotANumber), 100U);
    EXPECT_GT(countColour(classPicture(classes, one, truth), 10, kNotANumber), 100U);
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

TEST(ReportLettering, DrawsLettersAndCutsAtTheBorder)
{
    const auto letters = [](const char* text, std::int64_t x, std::int64_t y, std::int64_t scale) {
        Image8 picture(40, 30, 3);
        drawText(picture, x, y, text, Font::normal, scale, kWhite);
        return countColour(picture, 0, kWhite);
    };
    const std::size_t plain = letters("Ab", 2, 2, 1);
    EXPECT_GT(plain, 15U);
    EXPECT_LT(plain, 80U);
    EXPECT_NE(plain, letters("ii", 2, 2, 1));
    EXPECT_EQ(letters("Ab", 2, 2, 2), 4 * plain);
    EXPECT_EQ(letters("", 2, 2, 1), 0U);
    EXPECT_EQ(letters("Ab", 100, 100, 1), 0U);
    EXPECT_LT(letters("Ab", -6, -4, 1), plain);
    EXPECT_GT(letters("Ab", -6, -4, 1), 0U);
    EXPECT_EQ(textWidth("Ab", Font::normal), 12);
    EXPECT_EQ(textWidth("Ab", Font::bold), 14);
}

TEST(ReportLegend, LabelsThatWouldTouchAreLeftAway)
{
    const auto lettersBelowBar = [](std::vector<Tick> ticks) {
        Legend legend;
        legend.bar = ScaleBar{[](double) { return kLegendGround; }, std::move(ticks), "", "", ""};
        const Image8 picture = addLegend(Image8(320, 1, 3), legend);
        std::set<std::uint32_t> columns;
        for (std::uint32_t y = 1; y < picture.height; ++y) {
            for (std::uint32_t x = 0; x < picture.width; ++x) {
                if (!(at(picture, x, y) == kLegendGround))
                    columns.insert(x);
            }
        }
        return columns.size();
    };
    const std::size_t one = lettersBelowBar({{0.5, "888"}});
    EXPECT_GT(one, 10U);
    EXPECT_LE(lettersBelowBar({{0.5, "888"}, {0.52, "888"}}), one + 1);
    EXPECT_EQ(lettersBelowBar({{0.5, "888"}, {0.9, "888"}}), 2 * one);
}

} // namespace
} // namespace gnomon::lab
