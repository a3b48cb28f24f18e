// SPDX-License-Identifier: Apache-2.0
// The expected bleeding of a pair of casters, by which layers are placed.
#define GNOMON_REAL double
#include <gnomon/shared/layer_gaps.h>
#include <gnomon/shared/moments.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace gnomon::shared {
namespace {

TEST(LayerGaps, weighAPairByTheSquareOfItsLight)
{
    for (const double a : {0.0, 0.1, 0.4}) {
        for (const double b : {0.45, 0.6}) {
            for (const double c : {0.65, 0.8, 1.0}) {
                const double mean = 0.5 * (a + b);
                const double light = chebyshevBound(mean, 0.5 * (a * a + b * b), c, 0.0);
                EXPECT_NEAR(gapWeight(a, b, c), 16384.0 * light * light * (c - b), 0.5 + 1e-9)
                    << a << ' ' << b << ' ' << c;
            }
        }
    }
    EXPECT_EQ(gapWeight(0.1, 0.5, 0.5), 0) << "the same surface";
    EXPECT_EQ(gapWeight(0.1, 0.5, 0.3), 0) << "not below";
    EXPECT_EQ(gapWeight(0.1, 0.5, -1.0), 0) << "nothing there";
}

TEST(LayerGaps, sumsFitThirtyTwoBits)
{
    int largest = 0;
    for (int g = 1; g <= 100; ++g) {
        for (int h = 1; g + h <= 100; ++h) {
            largest = std::max(largest, gapWeight(0.0, 0.01 * g, 0.01 * (g + h)));
        }
    }
    // 256 x 256 texels, two pairs each, eight receivers to a pair.
    EXPECT_LE(largest, (1LL << 32) / (256 * 256 * 2 * 8));
    EXPECT_GT(largest, 100);
}

TEST(LayerGaps, aNearEndReachesBackByTheOverlap)
{
    EXPECT_EQ(nearBin(128, 256, 0.0), 128);
    EXPECT_EQ(nearBin(128, 256, 0.05), 121);
    EXPECT_EQ(nearBin(2, 256, 0.05), 0);
    EXPECT_EQ(kLeastBins, static_cast<int>(kLeastLayerWidth * kGapBins));
}

TEST(LayerGaps, aLayerLosesALittleForItsWidth)
{
    EXPECT_LT(2.0 * layerLoss(0.0, 100.0, 128), layerLoss(0.0, 100.0, 256));
    EXPECT_LT(2.0 * layerLoss(0.0, 0.0, 128), layerLoss(0.0, 0.0, 256)) << "where nothing bleeds, too";
    EXPECT_GT(layerLoss(1000.0, 1e5, 1), layerLoss(0.0, 1e5, 256)) << "less than a hundredth of all";
    EXPECT_TRUE(isLossAlike(1.1, 1.0, 0.0));
    EXPECT_FALSE(isLossAlike(1.2, 1.0, 0.0));
    EXPECT_TRUE(isLossAlike(layerLoss(0.0, 1e6, 256), 2.0 * layerLoss(0.0, 1e6, 128), 1e6)) << "no more than widths";
}

TEST(LayerGaps, haveToSaveTheMoreTheMoreLayersThereAre)
{
    EXPECT_TRUE(savesEnough(0.06, 1.0, 2, kConvincingShare));
    EXPECT_FALSE(savesEnough(0.07, 1.0, 2, kConvincingShare));
    EXPECT_TRUE(savesEnough(0.07, 1.0, 2, kHeldGapsShare));
    EXPECT_FALSE(savesEnough(0.005, 1.0, 8, kConvincingShare));
    EXPECT_TRUE(savesEnough(0.003, 1.0, 8, kConvincingShare));
    for (int count = 2; count <= 8; ++count) {
        EXPECT_EQ(uniformBin(0, count), 0);
        EXPECT_EQ(uniformBin(count, count), kGapBins);
        for (int i = 1; i < count; ++i) {
            EXPECT_NEAR(uniformBin(i, count), uniformBegin(i, count) * kGapBins, 0.5);
        }
    }
}

} // namespace
} // namespace gnomon::shared
