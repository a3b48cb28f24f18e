// SPDX-License-Identifier: Apache-2.0
// The judge is judged first.
#include "compare_images.h"

#include <gtest/gtest.h>

#include <limits>

namespace gnomon::golden {
namespace {

TEST(CompareImages, EqualImagesPassWithNoTolerance)
{
    const ImageF image(4, 4, 3, 0.5F);
    EXPECT_TRUE(compare(image, image, {0.0F, 0.0F, 0.0F}).same);
}

TEST(CompareImages, OnePixelTooFarOffFailsTheLargestDifference)
{
    const ImageF wanted(10, 10, 1, 0.5F);
    ImageF actual = wanted;
    *actual.pixel(3, 7) = 0.9F;
    EXPECT_FALSE(compare(actual, wanted, {0.3F, 0.1F, 1.0F}).same);
    EXPECT_TRUE(compare(actual, wanted, {0.5F, 0.1F, 0.01F}).same);
}

TEST(CompareImages, TooManyPixelsALittleOffFailTheShare)
{
    const ImageF wanted(10, 10, 1, 0.5F);
    ImageF actual = wanted;
    for (std::uint32_t x = 0; x < 10; ++x) {
        *actual.pixel(x, 0) = 0.55F;
    }
    EXPECT_FALSE(compare(actual, wanted, {1.0F, 0.01F, 0.05F}).same);
    EXPECT_TRUE(compare(actual, wanted, {1.0F, 0.1F, 0.0F}).same);
    EXPECT_TRUE(compare(actual, wanted, {1.0F, 0.01F, 0.1F}).same);
}

TEST(CompareImages, NanAndInfinityFailWhateverTheTolerances)
{
    const ImageF wanted(2, 2, 1);
    for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        ImageF actual = wanted;
        actual.values[1] = bad;
        EXPECT_FALSE(compare(actual, wanted, {1e9F, 1e9F, 1.0F}).same);
        EXPECT_FALSE(compare(wanted, actual, {1e9F, 1e9F, 1.0F}).same);
    }
}

TEST(CompareImages, AnotherSizeOrAnotherNumberOfChannelsFails)
{
    EXPECT_FALSE(compare(ImageF(2, 3, 1), ImageF(3, 2, 1), {}).same);
    EXPECT_FALSE(compare(ImageF(2, 2, 1), ImageF(2, 2, 3), {}).same);
}

TEST(CompareImages, ShiftMovesAndRepeatsTheEdge)
{
    ImageF image(3, 1, 1);
    image.values = {0.1F, 0.2F, 0.3F};
    EXPECT_EQ(shifted(image, 1, 0).values, (std::vector<float>{0.1F, 0.1F, 0.2F}));
    EXPECT_EQ(shifted(image, -1, 0).values, (std::vector<float>{0.2F, 0.3F, 0.3F}));
}

} // namespace
} // namespace gnomon::golden
