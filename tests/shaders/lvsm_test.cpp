// SPDX-License-Identifier: Apache-2.0
// Layered variance shadow maps: the right layer alone is read, layers do not bleed into each other, no seam shows.
#include "cpu_map.h"

#include <gnomon/lib/encoders.glsl>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <vector>

namespace gnomon::shared {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
class Lvsm : public testing::Test {
protected:
    Lvsm()
    {
        input.tile = {0.0, 0.0, 64.0, 8.0};
        input.moments.sampling = 1;
        input.moments.power = 1.0;
        point.texel = {4.0, 4.0};
        test::depth_layers = [this](int slot, int i) {
            EXPECT_EQ(slot, input.slot);
            return layers.at(static_cast<std::size_t>(i));
        };
        place(2, 0.05);
    }
    void place(int count, double overlap)
    {
        input.moments.layers = count;
        layers.assign(kDepthLayers, noLayer());
        for (int i = 0; i < count; ++i) {
            layers[static_cast<std::size_t>(i)] = uniformLayer(i, count, overlap);
        }
    }
    [[nodiscard]] glm::dvec4 encode(double depth, int image_layer, double variance = 0.0) const
    {
        EncodeInput e{};
        e.depth = depth;
        e.variance = variance;
        e.first = layers[static_cast<std::size_t>(2 * image_layer)];
        e.second = layers[static_cast<std::size_t>(2 * image_layer + 1)];
        return encodeLvsm(e, input.moments);
    }
    /// A map whose every texel is this mixture of depths and weights.
    void fill(const std::vector<glm::dvec2>& mixture)
    {
        test::map_moments = [this, mixture](glm::dvec2, double, double layer) {
            ++reads[static_cast<int>(layer)];
            glm::dvec4 sum(0.0);
            for (const glm::dvec2& part : mixture) {
                sum += encode(part.x, static_cast<int>(layer)) * part.y;
            }
            return sum;
        };
    }
    double visibility(double depth)
    {
        point.depth = depth;
        return filterLvsm(point, input);
    }

    FilterInput input{};
    MapPoint point{};
    std::vector<glm::dvec4> layers;
    std::map<int, int> reads; // by image layer
};

TEST_F(Lvsm, isExactForAParallelOccluderAndReceiverInOneLayer)
{
    for (int count = 2; count <= 8; ++count) {
        for (const int flags : {0, kMomentRemap}) {
            place(count, 0.05);
            input.moments.flags = flags;
            for (int i = 0; i < count; ++i) {
                const double occluder = (i + 0.2) / count;
                const double receiver = (i + 0.9) / count;
                for (int k = 0; k < 20; ++k) {
                    fill({{occluder, k / 20.0}, {receiver, 1.0 - k / 20.0}});
                    EXPECT_NEAR(visibility(receiver), 1.0 - k / 20.0, 1e-6);
                }
            }
        }
    }
}

TEST_F(Lvsm, readsTheReceiversLayerOnly)
{
    for (int count = 2; count <= 8; ++count) {
        place(count, 0.1);
        const int image_layers = (count + 1) / 2;
        input.layer = 3.0;
        for (int i = 0; i < count; ++i) {
            reads.clear();
            // Only this layer's two channels hold anything but noise.
            const double t = layerMetric((i + 0.5) / count, layers[static_cast<std::size_t>(i)]);
            test::map_moments = [&](glm::dvec2, double, double layer) {
                ++reads[static_cast<int>(layer)];
                const glm::dvec2 own(t - 0.1, (t - 0.1) * (t - 0.1) + 0.01);
                return i % 2 == 0 ? glm::dvec4(own, kNan, kNan) : glm::dvec4(kNan, kNan, own);
            };
            EXPECT_NEAR(visibility((i + 0.5) / count), 0.5, 1e-9) << i << " of " << count;
            EXPECT_EQ(reads, (std::map<int, int>{{3 * image_layers + i / 2, 1}}));
        }
    }
}

TEST_F(Lvsm, occludersOfANearerLayerLeaveNextToNothing)
{
    input.moments.min_variance = 0.0001;
    for (const double share : {0.1, 0.5, 0.9}) {
        for (const double receiver : {0.6, 0.8, 1.0}) {
            fill({{0.1, share}, {0.4, 1.0 - share}});
            const double t = layerMetric(receiver, layers[1]);
            const double v = visibility(receiver);
            EXPECT_NEAR(v, std::min(0.0001 / (0.0001 + t * t), 0.0001 / t), 1e-12);
            // The same with one layer: light bleeds through.
            const double mean = 0.1 * share + 0.4 * (1.0 - share);
            const double variance = share * (1.0 - share) * 0.09;
            EXPECT_GT(chebyshevBound(mean, mean * mean + variance, receiver, 0.0001), 5.0 * v);
        }
    }
}

TEST_F(Lvsm, boundsEveryDistributionFromAbove)
{
    std::mt19937 rng(22);
    std::uniform_real_distribution<double> u(0.0, 1.0);
    for (int round = 0; round < 10000; ++round) {
        place(2 + round % 7, 0.05);
        const int n = 1 + round % 16;
        std::vector<glm::dvec2> mixture;
        for (int i = 0; i < n; ++i) {
            mixture.emplace_back(u(rng), 1.0 / n);
        }
        fill(mixture);
        const double t = u(rng);
        double lit = 0.0;
        for (const glm::dvec2& part : mixture) {
            lit += part.x >= t ? part.y : 0.0;
        }
        EXPECT_GE(visibility(t), lit - 1e-9);
    }
}

// A plane across the split, blurred: its own lit value, along the map.
double largestDifference(const FilterInput& input, const std::vector<glm::dvec4>& layers, double slope)
{
    const double sigma = 1.25;
    test::MomentImage image(64, 8);
    for (int y = 0; y < 8; ++y) {
        for (int x = 0; x < 64; ++x) {
            glm::dvec4 sum(0.0);
            double weights = 0.0;
            for (int k = -4; k <= 4; ++k) {
                EncodeInput e{};
                e.depth = 0.5 + slope * (x + k + 0.5 - 32.0);
                e.first = layers[0];
                e.second = layers[1];
                const double weight = std::exp(-0.5 * k * k / (sigma * sigma));
                sum += encodeLvsm(e, input.moments) * weight;
                weights += weight;
            }
            image.at(x, y) = sum / weights;
        }
    }
    test::map_moments = [&](glm::dvec2 texel, double level, double layer) {
        return image.read(texel, level, layer);
    };
    double largest = 0.0;
    MapPoint point{};
    for (double x = 8.0; x < 56.0; x += 0.01) {
        point.texel = {x, 4.0};
        point.depth = 0.5 + slope * (x - 32.0);
        largest = std::max(largest, 1.0 - filterLvsm(point, input));
    }
    return largest;
}

TEST_F(Lvsm, overlapHidesTheSeam)
{
    // The kernel reaches 4.5 texels, and the overlap is 5 % of half the range: slopes up to 0.0055 a texel.
    for (const double slope : {0.0001, 0.001, 0.005, -0.005}) {
        EXPECT_LT(largestDifference(input, layers, slope), 1.0 / 255.0) << slope;
    }
    place(2, 0.0);
    EXPECT_GT(largestDifference(input, layers, 0.005), 0.1) << "without it a seam shows";
}

TEST_F(Lvsm, aMissingSecondLayerIsLit)
{
    place(3, 0.05);
    for (const int flags : {0, kMomentRemap}) {
        input.moments.flags = flags;
        const glm::dvec4 m = encode(0.2, 1, 0.01);
        EXPECT_EQ(m.z, 1.0);
        EXPECT_EQ(m.w, 1.0);
        EXPECT_LT(m.x, 0.0 + (flags == 0 ? 1e-12 : -1.0 + 1e-12)) << "before its layer: at the near end";
    }
}

TEST_F(Lvsm, derivativesAreStretchedWithTheLayerAndEndWithIt)
{
    const double width = layers[0].y - layers[0].x;
    EXPECT_NEAR(encode(0.3, 0, 1e-4).y - encode(0.3, 0).y, 1e-4 / (width * width), 1e-15);
    EXPECT_EQ(encode(0.3, 0, 1e-4).w, encode(0.3, 0).w) << "clamped in the other layer, where nothing varies";
}

TEST_F(Lvsm, leastVarianceOfASlopeIsStretchedWithTheLayer)
{
    place(4, 0.0);
    input.moments.min_variance_texels = 0.5;
    point.texel_depth = 0.02;
    fill({{0.30, 1.0}});
    const double t = 0.6; // of a layer as wide as a quarter
    const double deviation = 0.5 * 0.02 * 4.0;
    const double beyond = t - (0.30 - 0.25) * 4.0;
    EXPECT_NEAR(visibility(0.25 + t / 4.0), deviation * deviation / (deviation * deviation + beyond * beyond), 1e-12);
}

// Half a texel of depth on a steep wall may be more than all that a thin layer leaves between its near end and the
// wall.
TEST_F(Lvsm, aSteepReceiverInAThinLayerIsDarkBelowNearerOccluders)
{
    place(8, 0.05);
    input.moments.min_variance_texels = 0.5;
    point.texel_depth = 0.1;
    const double begins = 5.0 / 8.0;
    for (const int flags : {0, kMomentRemap}) {
        input.moments.flags = flags;
        for (const double receiver : {begins + 0.001, begins + 0.05, begins + 0.12}) {
            fill({{0.1, 0.5}, {0.4, 0.5}});
            EXPECT_LT(visibility(receiver), 1.0 / 255.0) << receiver;
            const glm::dvec4& layer = layers[5];
            const double t = layerMetric(receiver, layer);
            const double deviation = 0.5 * point.texel_depth / (layer.y - layer.x);
            EXPECT_GT(chebyshevBound(0.0, 0.0, t, deviation * deviation), 0.1) << "the least variance alone leaks";
            fill({{0.1, 0.3}, {receiver, 0.7}});
            EXPECT_NEAR(visibility(receiver), 0.7, 1e-9) << "and an edge stays where it is";
            fill({{receiver, 1.0}});
            EXPECT_EQ(visibility(receiver), 1.0);
        }
    }
}

TEST_F(Lvsm, numbersInTheTablesAreThoseOfTheEnum)
{
    fill({{0.6, 0.5}, {0.9, 0.5}});
    point.depth = 0.9;
    EXPECT_EQ(applyFilter(GNOMON_FILTER_LVSM, point, input), filterLvsm(point, input));
    EXPECT_NEAR(filterLvsm(point, input), 0.5, 1e-9);
    EncodeInput e{};
    e.depth = 0.3;
    e.first = layers[0];
    e.second = layers[1];
    EXPECT_EQ(encodeDepth(GNOMON_FILTER_LVSM, e, input.moments), encodeLvsm(e, input.moments));
}

class LvsmOfTheWorld : public Lvsm {
protected:
    void placeWorld(const std::vector<glm::dvec2>& spans)
    {
        input.moments.layers = static_cast<int>(spans.size());
        layers.assign(kDepthLayers, noLayer());
        for (std::size_t i = 0; i < spans.size(); ++i) {
            layers[i] = layerOfWorld(i == 0, i > 0 ? spans[i - 1].y : 0.0, spans[i].x, spans[i].y);
        }
    }
};

TEST_F(LvsmOfTheWorld, receiversReadTheLayerThatHoldsThemOrTheNearest)
{
    placeWorld({{-0.5, 0.2}, {0.3, 0.6}, {0.55, 1.4}});
    const auto readBy = [&](double depth) {
        int held = 0;
        for (int i = 1; i < input.moments.layers; ++i) {
            held = beginsBefore(layers[static_cast<std::size_t>(i)], depth) ? i : held;
        }
        return held;
    };
    EXPECT_EQ(readBy(0.0), 0);
    EXPECT_EQ(readBy(0.2), 0);
    EXPECT_EQ(readBy(0.24), 0) << "between two layers, nearer to the first";
    EXPECT_EQ(readBy(0.26), 1);
    EXPECT_EQ(readBy(0.57), 1) << "in both";
    EXPECT_EQ(readBy(0.58), 2);
    EXPECT_EQ(readBy(1.0), 2);
    placeWorld({{0.1, 0.5}, {3.0, 4.0}}); // no receiver is there
    EXPECT_EQ(readBy(1.0), 0);
    EXPECT_TRUE(isLayer(layers[1])) << "but it is stored";
}

TEST_F(LvsmOfTheWorld, aLayerIsEquation5ClampedBeyondItsEnds)
{
    placeWorld({{-0.5, 0.2}, {0.3, 0.6}});
    for (int i = 0; i <= 100; ++i) {
        const double d = i / 100.0;
        EXPECT_NEAR(layerMetric(d, layers[0]), std::clamp((d + 0.5) / 0.7, 0.0, 1.0), 1e-15);
        EXPECT_NEAR(layerMetric(d, layers[1]), std::clamp((d - 0.3) / 0.3, 0.0, 1.0), 1e-15);
    }
}

TEST_F(LvsmOfTheWorld, noSeamShowsWhereLayersOverlap)
{
    // Under an occluder, and half under it, across the border at 0.35.
    placeWorld({{-0.2, 0.4}, {0.3, 0.7}});
    input.moments.min_variance = 1e-6;
    for (const double share : {0.0, 0.25, 1.0}) {
        for (const double above : {0.01, 0.02, 0.045}) {
            double before = -1.0;
            for (int i = -20; i <= 20; ++i) {
                const double receiver = 0.35 + 0.0002 * i;
                fill({{receiver - above, share}, {receiver, 1.0 - share}});
                const double v = visibility(receiver);
                EXPECT_NEAR(v, 1.0 - share, 0.02) << above;
                if (before >= 0.0) {
                    EXPECT_NEAR(v, before, 0.02);
                }
                before = v;
            }
        }
    }
    // Without an overlap there is one: below its near end a layer knows of no depth. This must fail.
    placeWorld({{-0.2, 0.35}, {0.35, 0.7}});
    fill({{0.33, 1.0}});
    EXPECT_LT(visibility(0.3499), 0.02);
    input.moments.min_variance = 0.01;
    EXPECT_GT(visibility(0.3502), 0.5);
}

TEST_F(LvsmOfTheWorld, precisionIsALayersOwn)
{
    // At 16 bits a plate one part in 10,000 above a plane throws a shadow in a layer of a twentieth of the depths, and
    // none where one layer spans all.
    const auto seen = [&](const std::vector<glm::dvec2>& spans) {
        placeWorld(spans);
        input.moments.min_variance = varianceOfRounding(1.0 / 65535.0);
        const double receiver = 0.52;
        fill({{receiver - 0.0005, 1.0}});
        const auto rounded = test::map_moments;
        test::map_moments = [rounded](glm::dvec2 at, double level, double layer) {
            return glm::round(rounded(at, level, layer) * 65535.0) / 65535.0;
        };
        return visibility(receiver);
    };
    EXPECT_GT(seen({{0.0, 1.0}, {1.0, 2.0}}), 0.9);
    EXPECT_LT(seen({{0.0, 0.3}, {0.5, 0.55}}), 0.5);
}

} // namespace
} // namespace gnomon::shared
