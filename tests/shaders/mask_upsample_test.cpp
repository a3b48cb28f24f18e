// SPDX-License-Identifier: Apache-2.0
// The value of a pixel from a mask of half the size, in double precision.
#define GNOMON_REAL double
#include <gnomon/shared/mask_upsample.h>
#include <gnomon/shared/screen_blur.h>

#include <gtest/gtest.h>

#include <cmath>

namespace gnomon::shared {
namespace {

TEST(MaskUpsample, TexelsLieOnThePixelsThatTheyStandFor)
{
    for (const int scale : {2, 4}) {
        for (int texel = 0; texel < 9; ++texel) {
            EXPECT_EQ(texelOfPixel(pixelOfTexel(texel, scale), scale), texel) << scale;
        }
    }
    EXPECT_EQ(texelOfPixel(0, 2), -0.5) << "before the first one";
}

TEST(MaskUpsample, CornersAreWeighedAsBetweenTexels)
{
    // A value that is affine on the picture stays the same.
    const auto value = [](double x, double y) {
        return 0.25 + 0.03 * x - 0.05 * y;
    };
    for (int y = 0; y < 8; ++y) {
        for (int x = 0; x < 8; ++x) {
            const real2 place(texelOfPixel(x, 2), texelOfPixel(y, 2));
            const real2 cell = glm::floor(place);
            double sum = 0.0;
            double weights = 0.0;
            for (int i = 0; i < 4; ++i) {
                const double weight = cornerShare(place - cell, i);
                sum += weight * value(pixelOfTexel(static_cast<int>(cell.x) + (i & 1), 2),
                                      pixelOfTexel(static_cast<int>(cell.y) + (i >> 1), 2));
                weights += weight;
            }
            EXPECT_NEAR(weights, 1.0, 1e-15);
            EXPECT_NEAR(sum, value(x, y), 1e-14) << x << ", " << y;
        }
    }
}

TEST(MaskUpsample, HoldsWhereEnoughOfTheSurfaceAgrees)
{
    EXPECT_TRUE(upsampleHolds(1.0, 0.0));
    EXPECT_TRUE(upsampleHolds(0.5, 0.0)) << "one texel of two, two of four";
    EXPECT_FALSE(upsampleHolds(0.25, 0.0)) << "one of four";
    EXPECT_FALSE(upsampleHolds(0.0, 0.0)) << "no texel of the surface";
    EXPECT_TRUE(upsampleHolds(1.0, kUpsampleApart));
    EXPECT_FALSE(upsampleHolds(1.0, kUpsampleApart + 1.0 / 255.0)) << "the edge of a shadow";
    EXPECT_FALSE(upsampleHolds(std::nan(""), 0.0));
    EXPECT_FALSE(upsampleHolds(1.0, std::nan("")));
}

} // namespace
} // namespace gnomon::shared
