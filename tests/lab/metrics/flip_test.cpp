// SPDX-License-Identifier: Apache-2.0
#include "allocation_count.h"
#include "flip_images.h"
#include "lab/metrics/flip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <optional>

namespace gnomon::lab {
namespace {

using namespace flip_images;

double meanOf(const ImageF& map)
{
    return std::accumulate(map.values.begin(), map.values.end(), 0.0) / static_cast<double>(map.values.size());
}

/// One channel of values 0 or 1 / 255 and up.
ImageF noiseMask(std::uint32_t width, std::uint32_t height, std::uint32_t start)
{
    ImageF mask(width, height, 1);
    Noise noise(start);
    for (float& value : mask.values) {
        value = noise.next();
    }
    return mask;
}

void expectEverywhere(const ImageF& map, double expected, double tolerance)
{
    for (const float value : map.values) {
        ASSERT_NEAR(value, expected, tolerance);
    }
}

TEST(Flip, StaysWithinZeroAndOne)
{
    for (const Pair& pair : {colouredTiles(), saturatedTiles(), colouredNoise(), linesAndDots(), shadowOfDisc()}) {
        const ImageF map = flipMap(pair.test, pair.reference);
        for (const float value : map.values) {
            ASSERT_GE(value, 0.0F);
            ASSERT_LE(value, 1.0F);
        }
        EXPECT_GT(meanOf(map), 0.0);
    }
}

TEST(Flip, ClampsItsPictures)
{
    const float infinity = std::numeric_limits<float>::infinity();
    const Pair pair = saturatedTiles(); // values 0 and 1 only
    ImageF beyond = pair.test;
    for (std::size_t i = 0; i < beyond.values.size(); ++i) {
        const float excess = i % 2 == 0 ? 3.0F : infinity;
        beyond.values[i] = beyond.values[i] > 0.0F ? 1.0F + excess : -excess;
    }
    EXPECT_EQ(flipMap(beyond, pair.reference).values, flipMap(pair.test, pair.reference).values);
    EXPECT_EQ(flipMap(pair.reference, beyond).values, flipMap(pair.reference, pair.test).values);
}

TEST(Flip, DoesNotHideWhatIsNotANumber)
{
    ImageF test = noiseMask(64, 48, 1u);
    const ImageF truth = noiseMask(64, 48, 2u);
    test.values[64 * 20 + 30] = std::numeric_limits<float>::quiet_NaN();
    const std::optional<double> value = flip(test, truth, countAll(64, 48));
    ASSERT_TRUE(value.has_value());
    EXPECT_TRUE(std::isnan(*value));
    Counted without_it = countAll(64, 48);
    without_it.values[64 * 20 + 30] = 0;
    const std::optional<double> rest = flip(test, truth, without_it);
    ASSERT_TRUE(rest.has_value());
    EXPECT_TRUE(std::isfinite(*rest));
}

TEST(Flip, WorksOnTheSmallestPictures)
{
    EXPECT_NEAR(*flipMap(uniform(1, 1, 0, 1, 0), uniform(1, 1, 0, 0, 1)).pixel(0, 0), 1.0, 1e-6);
    const ImageF map = flipMap(uniform(3, 2, 0, 0, 0), uniform(3, 2, 1, 1, 1));
    ASSERT_EQ(map.values.size(), 6u);
    expectEverywhere(map, 0.9673797, 1e-6);
    EXPECT_TRUE(flipMap(ImageF(0, 0, 3), ImageF(0, 0, 3)).values.empty());
    EXPECT_TRUE(flipMap(ImageF(4, 0, 3), ImageF(4, 0, 3)).values.empty());
}

TEST(Flip, WorksAtTheLimitsOfDistance)
{
    const Pair pair = tiny();
    for (const double pixels_per_degree : {kFlipLeastPixelsPerDegree, kFlipMostPixelsPerDegree}) {
        for (const float value : flipMap(pair.test, pair.reference, pixels_per_degree).values) {
            ASSERT_GE(value, 0.0F);
            ASSERT_LE(value, 1.0F);
        }
    }
}

ImageF rowsOf(const ImageF& image, std::uint32_t first, std::uint32_t count)
{
    ImageF rows(image.width, count, image.channels);
    const std::size_t row = std::size_t{image.width} * image.channels;
    std::copy_n(image.values.begin() + static_cast<std::ptrdiff_t>(first * row), count * row, rows.values.begin());
    return rows;
}

// Each part is worked out alone, wherever the whole is cut into strips.
TEST(Flip, OfAPartIsThatOfTheWholeBeyondTheFiltersReach)
{
    constexpr std::uint32_t kHeight = 420;
    constexpr std::uint32_t kPart = 100;
    constexpr std::uint32_t kReach = 10; // at the usual distance
    ImageF test(24, kHeight, 3);
    ImageF reference(24, kHeight, 3);
    Noise noise(99u);
    for (std::size_t i = 0; i < test.values.size(); ++i) {
        test.values[i] = noise.next();
        reference.values[i] = noise.next();
    }
    const ImageF whole = flipMap(test, reference);
    for (std::uint32_t first = 0; first + kPart <= kHeight; first += kPart - 2 * kReach) {
        const ImageF part = flipMap(rowsOf(test, first, kPart), rowsOf(reference, first, kPart));
        const std::uint32_t top = first == 0 ? 0 : kReach; // the picture's own border is the part's too
        const std::uint32_t bottom = first + kPart == kHeight ? kPart : kPart - kReach;
        for (std::uint32_t y = top; y < bottom; ++y) {
            for (std::uint32_t x = 0; x < whole.width; ++x) {
                ASSERT_EQ(*part.pixel(x, y), *whole.pixel(x, first + y)) << x << ", " << first + y;
            }
        }
    }
    EXPECT_NE(flipMap(rowsOf(test, 100, kPart), rowsOf(reference, 100, kPart)).values[0], *whole.pixel(0, 100));
}

TEST(Flip, TakesFewBytesForAPixel)
{
    const ImageF test = noiseMask(96, 1600, 1);
    const ImageF truth = noiseMask(96, 1600, 2);
    const Counted counted = countAll(96, 1600);
    std::optional<double> mean;
    const std::size_t bytes = gnomon::test::heapPeakDuring([&] { mean = flip(test, truth, counted); });
    EXPECT_GT(mean.value(), 0.1);
    EXPECT_GT(bytes, test.values.size() * 8U); // of what is seen and of the differences
    EXPECT_LT(bytes, test.values.size() * 32U);
}

TEST(Flip, ShowsMasksAsGreyLight)
{
    const ImageF test = noiseMask(40, 30, 1u);
    const ImageF truth = noiseMask(40, 30, 2u);
    Pair grey{uniform(40, 30, 0, 0, 0), uniform(40, 30, 0, 0, 0)};
    for (std::uint32_t y = 0; y < 30; ++y) {
        for (std::uint32_t x = 0; x < 40; ++x) {
            setGrey(grey.test, x, y, *test.pixel(x, y));
            setGrey(grey.reference, x, y, *truth.pixel(x, y));
        }
    }
    const std::optional<double> value = flip(test, truth, countAll(40, 30), 50.0);
    ASSERT_TRUE(value.has_value());
    EXPECT_NEAR(*value, meanOf(flipMap(grey.test, grey.reference, 50.0)), 1e-12);
    EXPECT_GT(*value, 0.1);
}

TEST(Flip, LeavesOutPixelsThatDoNotCount)
{
    const ImageF truth = noiseMask(40, 30, 2u);
    Counted counted = countAll(40, 30);
    ImageF test = truth;
    for (std::uint32_t y = 0; y < 30; ++y) {
        for (std::uint32_t x = 0; x < 10; ++x) {
            *counted.pixel(x, y) = 0;
            *test.pixel(x, y) = 1.0F - *truth.pixel(x, y);
        }
    }
    // They hold the truth, so that they do not show in their neighbours either.
    EXPECT_EQ(flip(test, truth, counted), std::optional(0.0));
    EXPECT_GT(flip(test, truth, countAll(40, 30)), std::optional(0.01));
    // The mean is over those that count: one wrong pixel weighs more among fewer.
    *test.pixel(35, 15) = *truth.pixel(35, 15) > 0.5F ? 0.0F : 1.0F;
    const std::optional<double> among_fewer = flip(test, truth, counted);
    ImageF only_that = truth;
    *only_that.pixel(35, 15) = *test.pixel(35, 15);
    const std::optional<double> among_all = flip(only_that, truth, countAll(40, 30));
    ASSERT_TRUE(among_fewer.has_value() && among_all.has_value());
    EXPECT_NEAR(*among_fewer, *among_all * 40.0 / 30.0, 1e-12);
}

TEST(Flip, IsNotThereWhereNothingCounts)
{
    const ImageF mask = noiseMask(8, 8, 3u);
    EXPECT_FALSE(flip(mask, mask, Counted(8, 8, 1, 0)).has_value());
    EXPECT_FALSE(flip(ImageF(0, 0, 1), ImageF(0, 0, 1), Counted(0, 0, 1)).has_value());
}

} // namespace
} // namespace gnomon::lab
