// SPDX-License-Identifier: Apache-2.0
// The filters against plain loops over random maps.
#include "cpu_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace gnomon::shared {
namespace {

class Filters : public testing::Test {
protected:
    Filters() : texels(64 * 64)
    {
        std::uniform_real_distribution<double> depth(0.3, 0.7);
        for (double& texel : texels) {
            texel = depth(rng);
        }
        test::map_texels = [this](int x, int y) {
            return texels.at(static_cast<std::size_t>(y * 64 + x));
        };
    }

    MapPoint randomPoint()
    {
        std::uniform_real_distribution<double> place(12.0, 52.0);
        std::uniform_real_distribution<double> slope(-0.02, 0.02);
        MapPoint point{};
        point.texel = {place(rng), place(rng)};
        point.depth = 0.5;
        point.cap = 0.52;
        point.depth_slope = {slope(rng), slope(rng)};
        point.w_slope = {slope(rng), slope(rng)};
        point.w = 1.0;
        return point;
    }

    static double naiveBilinear(const MapPoint& point, glm::dvec2 offset)
    {
        const glm::dvec2 at = point.texel + offset - 0.5;
        const glm::dvec2 cell = glm::floor(at);
        const glm::dvec2 f = at - cell;
        double sum = 0.0;
        for (int k = 0; k < 4; ++k) {
            const glm::dvec2 texel = cell + glm::dvec2(k % 2, k / 2);
            const double weight = (k % 2 == 0 ? 1.0 - f.x : f.x) * (k / 2 == 0 ? 1.0 - f.y : f.y);
            sum += weight * compareTexel(point, texel + 0.5 - point.texel, mapTexel(texel, 0.0, 0.0));
        }
        return sum;
    }

    std::mt19937 rng{3};
    std::vector<double> texels;
};

TEST_F(Filters, mergedGathersAreTheSumOfTheTaps)
{
    for (const int width : {1, 3, 5, 7}) {
        FilterInput input{};
        input.kernel_width = width;
        input.kernel = gaussianWeights(width, 0.0);
        for (int round = 0; round < 500; ++round) {
            const MapPoint point = randomPoint();
            double expected = 0.0;
            for (int j = 0; j < width; ++j) {
                for (int i = 0; i < width; ++i) {
                    const double weight = tapWeight(input.kernel, width, i) * tapWeight(input.kernel, width, j);
                    expected += weight * naiveBilinear(point, glm::dvec2(i, j) - double((width - 1) / 2));
                }
            }
            EXPECT_NEAR(filterPcf(point, input), expected, 1e-12);
        }
    }
}

TEST_F(Filters, ninePointsAreTheMeanOfTheTexelsAround)
{
    FilterInput input{};
    input.kernel_width = kBoxKernel;
    for (int round = 0; round < 300; ++round) {
        MapPoint point = randomPoint();
        double expected = 0.0;
        for (int i = 0; i < 9; ++i) {
            const glm::dvec2 texel = glm::floor(point.texel) + glm::dvec2(i % 3 - 1, i / 3 - 1);
            expected += compareTexel(point, texel + 0.5 - point.texel, mapTexel(texel, 0.0, 0.0)) / 9.0;
        }
        EXPECT_NEAR(filterPcf(point, input), expected, 1e-12);
    }
}

TEST_F(Filters, ninePointsAsPublishedAreNearlyOne)
{
    FilterInput input{};
    input.kernel_width = kProjectedKernel;
    int others = 0;
    for (int round = 0; round < 1000; ++round) {
        MapPoint point = randomPoint();
        point.w = 10.0; // metres from the lamp: offsets of a tenth of a texel
        const glm::dvec2 part = point.texel - glm::floor(point.texel);
        const bool near_a_border = std::min(part.x, part.y) < 0.1 || std::max(part.x, part.y) > 0.9;
        const bool same = std::abs(filterPcf(point, input) - filterHard(point, input)) < 1e-12;
        EXPECT_TRUE(same || near_a_border);
        others += same ? 0 : 1;
        point.w = 0.5; // and never farther apart than meant
        FilterInput box = input;
        box.kernel_width = kBoxKernel;
        EXPECT_EQ(filterPcf(point, input), filterPcf(point, box));
    }
    EXPECT_LT(others, 400) << "of 1000 pixels, those whose nine points are not all in one texel";
}

TEST_F(Filters, discIsTheMeanOfItsTurnedTaps)
{
    FilterInput input{};
    input.disc_taps = 24;
    input.disc_radius = 3.0;
    for (int round = 0; round < 200; ++round) {
        input.pixel = {round + 0.5, 7.5};
        const MapPoint point = randomPoint();
        const double angle = interleavedGradientNoise(input.pixel) * 6.2831853;
        double expected = 0.0;
        for (int i = 0; i < input.disc_taps; ++i) {
            const glm::dvec2 p = kPoissonPoints[i] * 3.0;
            const glm::dvec2 turned(p.x * std::cos(angle) - p.y * std::sin(angle),
                                    p.x * std::sin(angle) + p.y * std::cos(angle));
            expected += naiveBilinear(point, turned) / input.disc_taps;
        }
        EXPECT_NEAR(filterPcf(point, input), expected, 1e-12);
    }
}

TEST_F(Filters, hardReadsTheTexelThatTheReceiverIsIn)
{
    for (int round = 0; round < 500; ++round) {
        MapPoint point = randomPoint();
        point.depth_slope = glm::dvec2(0.0);
        point.w_slope = glm::dvec2(0.0);
        const double stored = mapTexel(glm::floor(point.texel), 0.0, 0.0);
        EXPECT_EQ(filterHard(point, {}), stored >= point.depth ? 1.0 : 0.0);
    }
}

// Where a map holds what a lamp's perspective makes of depth, the same comes out as of linear depths.
TEST_F(Filters, zOverWIsUndoneWhereItIsRead)
{
    const double r = 0.02;
    FilterInput input{};
    input.kernel_width = 3;
    input.kernel = gaussianWeights(3, 0.0);
    for (int round = 0; round < 500; ++round) {
        const MapPoint point = randomPoint();
        FilterInput over_w = input;
        over_w.moments.flags = kMomentZOverW;
        over_w.near_over_far = r;
        const double hard = filterHard(point, input);
        const double pcf = filterPcf(point, input);
        FilterInput points = input; // nine single reads
        points.kernel_width = -1;
        const double nine = filterPcf(point, points);
        points.moments = over_w.moments;
        points.near_over_far = r;
        const auto linear = test::map_texels;
        test::map_texels = [linear, r](int x, int y) {
            return zOverW(linear(x, y), r);
        };
        EXPECT_NEAR(storedMetric(over_w, glm::dvec4(zOverW(0.37, r))).x, 0.37, 1e-12);
        EXPECT_EQ(storedMetric(over_w, glm::dvec4(1.0)).x, 1.0);
        EXPECT_EQ(filterHard(point, over_w), hard);
        EXPECT_NEAR(filterPcf(point, over_w), pcf, 1e-12);
        EXPECT_EQ(filterPcf(point, points), nine);
        test::map_texels = linear;
    }
}

TEST_F(Filters, numbersInTheTableAreThoseOfTheEnum)
{
    const MapPoint point = randomPoint();
    FilterInput input{};
    input.kernel_width = 3;
    input.kernel = gaussianWeights(3, 0.0);
    EXPECT_EQ(applyFilter(GNOMON_FILTER_HARD, point, input), filterHard(point, input));
    EXPECT_EQ(applyFilter(GNOMON_FILTER_PCF, point, input), filterPcf(point, input));
    EXPECT_EQ(applyFilter(GNOMON_FILTER_ID, point, input), filterId(point, input));
    EXPECT_EQ(applyFilter(GNOMON_FILTER_DEPTH_ID, point, input), filterDepthId(point, input));
    EXPECT_EQ(applyFilter(99, point, input), 1.0);
}

TEST_F(Filters, anEmptyMapLightsEverything)
{
    test::map_texels = [](int, int) {
        return 1.0;
    };
    FilterInput input{};
    input.kernel_width = 7;
    input.kernel = gaussianWeights(7, 0.0);
    MapPoint point = randomPoint();
    point.depth = 3.0; // beyond the far plane
    point.cap = 1.0;
    EXPECT_NEAR(filterPcf(point, input), 1.0, 1e-14);
    EXPECT_EQ(filterHard(point, input), 1.0);
}

TEST(BoundedVisibility, staysInRange)
{
    EXPECT_EQ(boundedVisibility(-0.1), 0.0);
    EXPECT_EQ(boundedVisibility(0.25), 0.25);
    EXPECT_EQ(boundedVisibility(1.1), 1.0);
    EXPECT_EQ(boundedVisibility(std::numeric_limits<double>::quiet_NaN()), 1.0);
}

} // namespace
} // namespace gnomon::shared
