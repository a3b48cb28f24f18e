// SPDX-License-Identifier: Apache-2.0
#include "lab/metrics/error.h"

#include "masks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::lab {
namespace {

using test::constantMask;
using test::noiseMask;

/// A row of pixels whose errors are 1/n, 2/n ... 1 of a truth of 0, from the largest down.
ImageF stairs(std::uint32_t n)
{
    ImageF mask(n, 1, 1);
    for (std::uint32_t i = 0; i < n; ++i) {
        mask.values[i] = static_cast<float>(n - i) / static_cast<float>(n);
    }
    return mask;
}

TEST(Error, EqualMasksHaveNone)
{
    const ImageF mask = noiseMask(31, 17, 1);
    const auto numbers = errorNumbers(mask, mask, countAll(31, 17));
    ASSERT_TRUE(numbers);
    EXPECT_EQ(numbers->rmse, 0.0);
    EXPECT_EQ(numbers->mae, 0.0);
    EXPECT_EQ(numbers->bias, 0.0);
    EXPECT_EQ(numbers->p99, 0.0);
}

TEST(Error, ConstantOffsetIsEveryNumber)
{
    for (const float offset : {0.25F, -0.25F, 0.0625F, -0.5F}) {
        const auto numbers =
            errorNumbers(constantMask(40, 30, 0.5F + offset), constantMask(40, 30, 0.5F), countAll(40, 30));
        ASSERT_TRUE(numbers);
        EXPECT_DOUBLE_EQ(numbers->rmse, std::abs(offset));
        EXPECT_DOUBLE_EQ(numbers->mae, std::abs(offset));
        EXPECT_DOUBLE_EQ(numbers->bias, offset);
        EXPECT_DOUBLE_EQ(numbers->p99, std::abs(offset));
    }
}

TEST(Error, HalfThePixelsOffByD)
{
    const double d = 0.375;
    ImageF test(20, 10, 1);
    std::fill_n(test.values.begin(), 100, static_cast<float>(d));
    const auto numbers = errorNumbers(test, constantMask(20, 10, 0.0F), countAll(20, 10));
    ASSERT_TRUE(numbers);
    EXPECT_DOUBLE_EQ(numbers->rmse, d * std::sqrt(0.5));
    EXPECT_DOUBLE_EQ(numbers->mae, d / 2.0);
    EXPECT_DOUBLE_EQ(numbers->bias, d / 2.0);
    EXPECT_DOUBLE_EQ(numbers->p99, d);
}

TEST(Error, OppositeErrorsCancelInTheBiasOnly)
{
    ImageF test(8, 8, 1, 0.75F);
    std::fill_n(test.values.begin(), 32, 0.25F);
    const auto numbers = errorNumbers(test, constantMask(8, 8, 0.5F), countAll(8, 8));
    ASSERT_TRUE(numbers);
    EXPECT_EQ(numbers->bias, 0.0);
    EXPECT_DOUBLE_EQ(numbers->mae, 0.25);
    EXPECT_DOUBLE_EQ(numbers->rmse, 0.25);
}

TEST(Error, PercentileIsOfNearestRank)
{
    // ceil(0.99 n): 1, 50, 99, 100, 198, 199, 990.
    struct Case {
        std::uint32_t pixels;
        std::uint32_t rank;
    };
    for (const Case& c : {Case{1, 1}, Case{50, 50}, Case{99, 99}, Case{100, 99}, Case{101, 100}, Case{199, 198},
                          Case{200, 198}, Case{201, 199}, Case{1000, 990}}) {
        const auto numbers = errorNumbers(stairs(c.pixels), constantMask(c.pixels, 1, 0.0F), countAll(c.pixels, 1));
        ASSERT_TRUE(numbers);
        EXPECT_EQ(numbers->p99, static_cast<float>(c.rank) / static_cast<float>(c.pixels)) << c.pixels;
    }
}

TEST(Error, PercentilePassesOverOnePixelInAHundred)
{
    ImageF test(100, 10, 1, 0.125F);
    std::fill_n(test.values.begin(), 10, 1.0F);
    const ImageF truth = constantMask(100, 10, 0.0F);
    EXPECT_EQ(errorNumbers(test, truth, countAll(100, 10))->p99, 0.125);
    test.values[10] = 1.0F; // an eleventh
    EXPECT_EQ(errorNumbers(test, truth, countAll(100, 10))->p99, 1.0);
}

TEST(Error, OnlyCountedPixelsMatter)
{
    ImageF test = constantMask(10, 10, 0.5F);
    ImageF truth = constantMask(10, 10, 0.25F);
    Counted counted = countAll(10, 10);
    for (std::size_t i = 0; i < 70; ++i) {
        counted.values[i] = 0;
        test.values[i] = i % 2 == 0 ? 1.0F : std::numeric_limits<float>::quiet_NaN();
        truth.values[i] = 0.0F;
    }
    const auto numbers = errorNumbers(test, truth, counted);
    ASSERT_TRUE(numbers);
    EXPECT_DOUBLE_EQ(numbers->rmse, 0.25);
    EXPECT_DOUBLE_EQ(numbers->mae, 0.25);
    EXPECT_DOUBLE_EQ(numbers->bias, 0.25);
    EXPECT_DOUBLE_EQ(numbers->p99, 0.25);
}

TEST(Error, NothingWhenNoPixelCounts)
{
    const ImageF mask = constantMask(4, 4, 0.5F);
    EXPECT_FALSE(errorNumbers(mask, mask, Counted(4, 4, 1)));
    EXPECT_FALSE(errorNumbers(ImageF(0, 0, 1), ImageF(0, 0, 1), countAll(0, 0)));
}

TEST(Error, OneNanMakesEveryNumberNan)
{
    for (const std::size_t place : {std::size_t{0}, std::size_t{200}, std::size_t{398}, std::size_t{399}}) {
        ImageF test = noiseMask(20, 20, 2);
        test.values[place] = std::numeric_limits<float>::quiet_NaN();
        const auto numbers = errorNumbers(test, noiseMask(20, 20, 3), countAll(20, 20));
        ASSERT_TRUE(numbers);
        EXPECT_TRUE(std::isnan(numbers->rmse)) << place;
        EXPECT_TRUE(std::isnan(numbers->mae)) << place;
        EXPECT_TRUE(std::isnan(numbers->bias)) << place;
        EXPECT_TRUE(std::isnan(numbers->p99)) << place;
    }
}

TEST(Error, NumbersAreInTheirOrder)
{
    for (std::uint64_t seed = 10; seed < 30; ++seed) {
        const ImageF test = noiseMask(37, 23, seed);
        const ImageF truth = noiseMask(37, 23, seed + 100);
        const Counted counted = test::countSome(37, 23, 0.5, seed + 200);
        const auto numbers = errorNumbers(test, truth, counted);
        const auto swapped = errorNumbers(truth, test, counted);
        ASSERT_TRUE(numbers && swapped);
        EXPECT_LE(std::abs(numbers->bias), numbers->mae);
        EXPECT_LT(numbers->mae, numbers->rmse);
        EXPECT_LT(numbers->rmse, numbers->p99);
        EXPECT_LE(numbers->p99, 1.0);
        EXPECT_EQ(swapped->bias, -numbers->bias);
        EXPECT_EQ(swapped->rmse, numbers->rmse);
    }
}

TEST(Error, UniformNoiseHasTheRmseOfItsDistribution)
{
    // |x - y| of two uniform numbers: density 2 (1 - t), mean 1/3, mean square 1/6, 99 % below 0.9.
    const auto numbers = errorNumbers(noiseMask(512, 512, 7), noiseMask(512, 512, 8), countAll(512, 512));
    ASSERT_TRUE(numbers);
    EXPECT_NEAR(numbers->rmse, std::sqrt(1.0 / 6.0), 0.003);
    EXPECT_NEAR(numbers->mae, 1.0 / 3.0, 0.003);
    EXPECT_NEAR(numbers->bias, 0.0, 0.004);
    EXPECT_NEAR(numbers->p99, 0.9, 0.003);
}

TEST(CountAll, CountsEveryPixel)
{
    const Counted counted = countAll(7, 5);
    EXPECT_EQ(counted.width, 7U);
    EXPECT_EQ(counted.height, 5U);
    EXPECT_EQ(counted.channels, 1U);
    EXPECT_EQ(std::count(counted.values.begin(), counted.values.end(), 1), 35);
}

} // namespace
} // namespace gnomon::lab
