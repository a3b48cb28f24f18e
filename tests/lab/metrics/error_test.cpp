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

} // namespace
} // namespace gnomon::lab
