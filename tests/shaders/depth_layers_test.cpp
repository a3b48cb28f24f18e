// SPDX-License-Identifier: Apache-2.0
// Layers of depth: metric, placement, Lloyd relaxation as the compute pass does it.
#define GNOMON_REAL double
#include <gnomon/shared/depth_layers.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace gnomon::shared {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr int kBins = 256;

// begins(0 .. count), with begins(count) = 1.
std::vector<double> relax(const std::vector<int>& bins, int count, int rounds)
{
    int lowest = kBins;
    int highest = -1;
    for (int b = 0; b < kBins; ++b) {
        if (bins[static_cast<std::size_t>(b)] > 0) {
            lowest = std::min(lowest, b);
            highest = b;
        }
    }
    std::vector<double> means;
    for (int i = 0; i < count; ++i) {
        means.push_back(lloydStart(i, count, binCentre(lowest, kBins), binCentre(highest, kBins)));
    }
    std::vector<double> begins(static_cast<std::size_t>(count) + 1, 0.0);
    for (int round = 0; round < rounds; ++round) {
        for (int i = 1; i < count; ++i) {
            const auto k = static_cast<std::size_t>(i);
            begins[k] = lloydSplit(i, count, means[k - 1], means[k], begins[k - 1]);
        }
        begins.back() = 1.0;
        for (std::size_t k = 0; k < means.size(); ++k) {
            double depths = 0.0;
            double sum = 0.0;
            for (int b = 0; b < kBins; ++b) {
                if (layerHoldsBin(b, kBins, begins[k], begins[k + 1])) {
                    depths += bins[static_cast<std::size_t>(b)];
                    sum += bins[static_cast<std::size_t>(b)] * binCentre(b, kBins);
                }
            }
            means[k] = lloydMean(depths, sum, means[k]);
        }
    }
    return begins;
}

std::vector<int> clusters(std::initializer_list<std::array<double, 3>> centre_width_count)
{
    std::vector<int> bins(kBins, 0);
    std::mt19937 rng(5);
    for (const auto& c : centre_width_count) {
        std::uniform_real_distribution<double> u(c[0] - c[1], c[0] + c[1]);
        for (int i = 0; i < static_cast<int>(c[2]); ++i) {
            ++bins[static_cast<std::size_t>(binOf(u(rng), kBins))];
        }
    }
    return bins;
}

TEST(LayerMetric, isLinearMonotoneAndClamped)
{
    const glm::dvec4 layer(0.25, 0.75, 0.3, 0.5);
    EXPECT_EQ(layerMetric(0.25, layer), 0.0);
    EXPECT_EQ(layerMetric(0.5, layer), 0.5);
    EXPECT_EQ(layerMetric(0.75, layer), 1.0);
    EXPECT_EQ(layerMetric(-5.0, layer), 0.0);
    EXPECT_EQ(layerMetric(5.0, layer), 1.0);
    EXPECT_EQ(layerMetric(kNan, layer), 1.0);
    double last = 0.0;
    for (int i = 0; i <= 1000; ++i) {
        const double d = i / 1000.0;
        const double x = layerMetric(d, layer);
        EXPECT_GE(x, last);
        last = x;
        if (d >= layer.x && d <= layer.y) {
            EXPECT_NEAR(layer.x + x * (layer.y - layer.x), d, 1e-15) << "round trip";
        }
    }
    EXPECT_TRUE(std::isfinite(layerMetric(0.5, glm::dvec4(0.5, 0.5, 0.5, 0.5)))) << "of no width";
}

TEST(LayerPlacement, uniformLayersShareTheRangeAndOverlap)
{
    for (int count = 2; count <= 8; ++count) {
        for (const double overlap : {0.0, 0.05, 0.5}) {
            for (int i = 0; i < count; ++i) {
                const glm::dvec4 layer = uniformLayer(i, count, overlap);
                EXPECT_NEAR(layer.z, i / static_cast<double>(count), 1e-15);
                EXPECT_NEAR(layer.x, std::max(0.0, (i - overlap) / count), 1e-15);
                EXPECT_NEAR(layer.y, std::min(1.0, (i + 1 + overlap) / count), 1e-15);
                EXPECT_NEAR(layer.w, (i + 0.5) / count, 1e-15);
                EXPECT_TRUE(isLayer(layer));
            }
            EXPECT_EQ(uniformLayer(0, count, overlap).x, 0.0);
            EXPECT_EQ(uniformLayer(count - 1, count, overlap).y, 1.0);
        }
    }
    EXPECT_FALSE(isLayer(noLayer()));
    EXPECT_FALSE(beginsBefore(noLayer(), 1.0));
    EXPECT_FALSE(beginsBefore(uniformLayer(1, 2, 0.0), kNan));
}

TEST(LayerPlacement, byHandTheOuterEndsAreThoseOfTheMap)
{
    const std::array<double, 2> splits{0.2, 0.7};
    const glm::dvec4 first = layerByHand(0, 3, 99.0, splits[0], 0.1);
    const glm::dvec4 second = layerByHand(1, 3, splits[0], splits[1], 0.1);
    const glm::dvec4 third = layerByHand(2, 3, splits[1], 99.0, 0.1);
    EXPECT_LT(glm::length(first - glm::dvec4(0.0, 0.22, 0.0, 0.1)), 1e-15);
    EXPECT_LT(glm::length(second - glm::dvec4(0.15, 0.75, 0.2, 0.45)), 1e-15);
    EXPECT_LT(glm::length(third - glm::dvec4(0.67, 1.0, 0.7, 0.85)), 1e-15);
}

TEST(LloydLayers, twoClustersAreSplitBetweenThem)
{
    // Clusters of equal and very unequal weight, also all in a small part of the range.
    for (const double share : {5000.0, 100.0}) {
        const double split = relax(clusters({{0.2, 0.03, 5000.0}, {0.8, 0.05, share}}), 2, 16)[1];
        EXPECT_NEAR(split, 0.5, 0.01);
        const double near_split = relax(clusters({{0.1, 0.01, 5000.0}, {0.16, 0.01, share}}), 2, 16)[1];
        EXPECT_NEAR(near_split, 0.13, 0.005);
    }
    const std::vector<double> three =
        relax(clusters({{0.1, 0.02, 900.0}, {0.5, 0.02, 900.0}, {0.9, 0.02, 900.0}}), 3, 16);
    EXPECT_NEAR(three[1], 0.3, 0.01);
    EXPECT_NEAR(three[2], 0.7, 0.01);
}

TEST(LloydLayers, relaxationConvergesAndLowersTheError)
{
    const std::vector<int> bins = clusters({{0.3, 0.29, 4000.0}, {0.7, 0.02, 3000.0}, {0.15, 0.05, 2000.0}});
    for (int count = 2; count <= 8; ++count) {
        const std::vector<double> some = relax(bins, count, 60);
        EXPECT_EQ(some, relax(bins, count, 61)) << count << " layers: a fixed point";
        const auto spread = [&](const std::vector<double>& begins) { // sum of squares around the layers' means
            double total = 0.0;
            for (std::size_t k = 0; k + 1 < begins.size(); ++k) {
                double n = 0.0;
                double m1 = 0.0;
                double m2 = 0.0;
                for (int b = 0; b < kBins; ++b) {
                    if (layerHoldsBin(b, kBins, begins[k], begins[k + 1])) {
                        const double c = binCentre(b, kBins);
                        n += bins[static_cast<std::size_t>(b)];
                        m1 += bins[static_cast<std::size_t>(b)] * c;
                        m2 += bins[static_cast<std::size_t>(b)] * c * c;
                    }
                }
                total += n > 0.0 ? m2 - m1 * m1 / n : 0.0;
            }
            return total;
        };
        double last = 1e9;
        for (const int rounds : {1, 2, 4, 8, 60}) {
            const double now = spread(relax(bins, count, rounds));
            EXPECT_LE(now, last * (1.0 + 1e-12));
            last = now;
        }
    }
}

TEST(LloydLayers, aSmallChangeMovesSplitsLittle)
{
    std::vector<int> bins = clusters({{0.2, 0.1, 20000.0}, {0.6, 0.2, 20000.0}});
    const std::vector<double> before = relax(bins, 4, 16);
    for (int b = 40; b < 140; b += 7) {
        bins[static_cast<std::size_t>(b)] += 20; // 0.7 % more
    }
    const std::vector<double> after = relax(bins, 4, 16);
    for (std::size_t i = 0; i < before.size(); ++i) {
        EXPECT_NEAR(after[i], before[i], 0.01);
    }
}

TEST(LloydLayers, emptyAndSingleDepthsStillGiveLayers)
{
    std::vector<int> one(kBins, 0);
    for (const int bin : {0, 77, kBins - 1}) {
        one.assign(kBins, 0);
        one[static_cast<std::size_t>(bin)] = 1000;
        for (int count = 2; count <= 8; ++count) {
            const std::vector<double> begins = relax(one, count, 16);
            EXPECT_EQ(begins.front(), 0.0);
            EXPECT_EQ(begins.back(), 1.0);
            for (std::size_t i = 1; i < begins.size(); ++i) {
                EXPECT_GE(begins[i] - begins[i - 1], kLeastLayerWidth - 1e-12);
            }
        }
    }
    EXPECT_EQ(lloydMean(0.0, 0.0, 0.4), 0.4) << "keeps its place";
    EXPECT_EQ(lloydSplit(1, 2, kNan, 0.5, 0.0), kLeastLayerWidth);
    EXPECT_EQ(lloydSplit(1, 2, 1.0, 1.0, 0.0), 1.0 - kLeastLayerWidth);
}

TEST(LloydLayers, aHeldSplitIsOffByAShareOfTheWayBetweenItsMeans)
{
    EXPECT_FALSE(isSplitOff(0.5, 0.5, 0.4, 0.6));
    EXPECT_FALSE(isSplitOff(0.5, 0.524, 0.4, 0.6));
    EXPECT_FALSE(isSplitOff(0.5, 0.476, 0.4, 0.6));
    EXPECT_TRUE(isSplitOff(0.5, 0.526, 0.4, 0.6));
    EXPECT_TRUE(isSplitOff(0.5, 0.474, 0.4, 0.6));
    EXPECT_FALSE(isSplitOff(0.5, 0.526, 0.3, 0.7));
    EXPECT_FALSE(isSplitOff(0.5, 0.5, 0.5, 0.5)) << "nothing to part";
}

TEST(LloydLayers, binsCoverTheRange)
{
    EXPECT_EQ(binOf(0.0, 64), 0);
    EXPECT_EQ(binOf(1.0, 64), 63);
    EXPECT_EQ(binOf(-1.0, 64), 0);
    EXPECT_EQ(binOf(1e30, 64), 63);
    EXPECT_EQ(binOf(kNan, 64), 63);
    for (int b = 0; b < 64; ++b) {
        EXPECT_EQ(binOf(binCentre(b, 64), 64), b);
    }
}

} // namespace
} // namespace gnomon::shared
