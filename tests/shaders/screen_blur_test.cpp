// SPDX-License-Identifier: Apache-2.0
// The weights of soften=blur in double precision, beside those that were published.
#define GNOMON_REAL double
#include <gnomon/shared/discs.h>
#include <gnomon/shared/screen_blur.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace gnomon::shared {
namespace {

struct ScreenTap {
    double place = 0.0;
    double weight = 0.0;
};

/// Divided by their sum, as the pass does.
std::vector<ScreenTap> symmetricTaps(int kernel, int scale)
{
    std::vector<ScreenTap> taps;
    double sum = 0.0;
    const int aside = screenTapsAside(scale);
    for (int i = -aside; i <= aside; ++i) {
        taps.push_back({screenTapPlace(i, scale), screenTapWeight(kernel, i, scale)});
        sum += taps.back().weight;
    }
    for (ScreenTap& tap : taps) {
        tap.weight /= sum;
    }
    return taps;
}

std::vector<ScreenTap> publishedTaps()
{
    std::vector<ScreenTap> taps;
    for (int i = 0; i < kPublishedTaps; ++i) {
        taps.push_back({publishedPlace(i), publishedWeight(i)});
    }
    return taps;
}

double sumOf(const std::vector<ScreenTap>& taps)
{
    double sum = 0.0;
    for (const ScreenTap& tap : taps) {
        sum += tap.weight;
    }
    return sum;
}

double meanOf(const std::vector<ScreenTap>& taps)
{
    double sum = 0.0;
    for (const ScreenTap& tap : taps) {
        sum += tap.weight * tap.place;
    }
    return sum / sumOf(taps);
}

double deviationOf(const std::vector<ScreenTap>& taps)
{
    const double mean = meanOf(taps);
    double sum = 0.0;
    for (const ScreenTap& tap : taps) {
        sum += tap.weight * (tap.place - mean) * (tap.place - mean);
    }
    return std::sqrt(sum / sumOf(taps));
}

TEST(ScreenBlur, HasAsManyTapsAsWereUsedAndFewerOnSmallImages)
{
    EXPECT_EQ(symmetricTaps(kScreenGaussian, 1).size(), 15U);
    EXPECT_EQ(symmetricTaps(kScreenGaussian, 2).size(), 9U);
    EXPECT_EQ(symmetricTaps(kScreenGaussian, 4).size(), 5U);
}

TEST(ScreenBlur, SumsToOneAndIsTheSameToBothSides)
{
    for (const int kernel : {kScreenGaussian, kScreenBox}) {
        for (const int scale : {1, 2, 4}) {
            const auto taps = symmetricTaps(kernel, scale);
            EXPECT_NEAR(sumOf(taps), 1.0, 1e-15);
            EXPECT_NEAR(meanOf(taps), 0.0, 1e-15);
            for (std::size_t i = 0; i < taps.size(); ++i) {
                EXPECT_EQ(taps[i].weight, taps[taps.size() - 1 - i].weight);
                EXPECT_GT(taps[i].weight, 0.0);
            }
        }
    }
}

TEST(ScreenBlur, IsAsWideAtEverySize)
{
    // A Gaussian of 3 that ends at 7 has a deviation of 2.866; a box of 15 has sqrt((15^2 - 1) / 12).
    EXPECT_NEAR(deviationOf(symmetricTaps(kScreenGaussian, 1)), 2.866, 0.0005);
    EXPECT_NEAR(deviationOf(symmetricTaps(kScreenBox, 1)), std::sqrt(224.0 / 12.0), 1e-12);
    for (const int kernel : {kScreenGaussian, kScreenBox}) {
        const double full = deviationOf(symmetricTaps(kernel, 1));
        for (const int scale : {2, 4}) {
            const double most = kernel == kScreenBox && scale == 4 ? 0.07 : 0.05; // five taps are few for a box
            EXPECT_NEAR(deviationOf(symmetricTaps(kernel, scale)) / full, 1.0, most) << kernel << ' ' << scale;
        }
    }
}

TEST(ScreenBlur, DiscIsAsWideAsTheGaussian)
{
    double sum = 0.0;
    for (const auto& point : kPoissonPoints) {
        sum += kScreenDiscRadius * kScreenDiscRadius * dot(point, point) / 2.0;
    }
    EXPECT_NEAR(std::sqrt(sum / 64.0), kScreenSigma, 0.15);
}

TEST(PublishedBlur, BrightensAndShifts)
{
    const auto taps = publishedTaps();
    EXPECT_NEAR(sumOf(taps), 1.06649, 0.00001);
    EXPECT_NEAR(sumOf(taps) * sumOf(taps), 1.1374, 0.0001) << "over both passes";
    EXPECT_NEAR(std::abs(meanOf(taps)), 0.41, 0.005) << "pixels off";
    double heavier = 0.0;
    double lighter = 0.0;
    for (const ScreenTap& tap : taps) {
        EXPECT_TRUE(tap.place == 0.0 || std::fmod(std::abs(tap.place), 2.0) == 1.0) << "odd offsets alone";
        heavier += tap.place > 0.0 ? tap.weight : 0.0;
        lighter += tap.place < 0.0 ? tap.weight : 0.0;
    }
    EXPECT_GT(heavier, 1.2 * lighter);
    // The middle one is that of a width of 2, and would be 0.133 with the width of the others.
    EXPECT_NEAR(publishedWeight(0), 0.1995, 0.0001);
}

TEST(ScreenBlur, WholeNumbersAreTheNearestToBothSides)
{
    for (const double place : {0.0, 0.25, 0.49, 0.5, 0.51, 1.5, 2.75, 7.0}) {
        EXPECT_EQ(nearestPixel(-place), -nearestPixel(place));
        EXPECT_LE(std::abs(nearestPixel(place) - place), 0.5);
    }
}

TEST(ScreenBlurEdges, ASurfaceIsItsOwnAndAStepIsNot)
{
    EXPECT_EQ(screenDepthShare(0.0), 1.0);
    EXPECT_EQ(screenDepthShare(1.0), 1.0);
    EXPECT_NEAR(screenDepthShare(1.5), 0.5, 1e-15);
    EXPECT_EQ(screenDepthShare(2.0), 0.0);
    EXPECT_EQ(screenDepthShare(1e9), 0.0);
    EXPECT_EQ(screenNormalShare(1.0), 1.0);
    EXPECT_EQ(screenNormalShare(std::cos(0.31)), 1.0); // 17.8 degrees
    EXPECT_EQ(screenNormalShare(std::cos(0.65)), 0.0); // 37.2 degrees
    EXPECT_EQ(screenNormalShare(0.0), 0.0);
    EXPECT_EQ(screenNormalShare(-1.0), 0.0);
    for (int i = 0; i < 20; ++i) { // never more for what is farther off
        EXPECT_GE(screenDepthShare(0.1 * i), screenDepthShare(0.1 * i + 0.1));
        EXPECT_LE(screenNormalShare(0.05 * i), screenNormalShare(0.05 * i + 0.05));
    }
}

TEST(ScreenBlurEdges, ATexelStandsForAPixelOfItsOwn)
{
    EXPECT_EQ(pixelOfTexel(5, 1), 5);
    for (const int scale : {2, 4}) {
        for (int texel = 0; texel < 9; ++texel) {
            EXPECT_EQ(pixelOfTexel(texel, scale) / scale, texel);
        }
    }
}

} // namespace
} // namespace gnomon::shared
