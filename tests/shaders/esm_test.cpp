// SPDX-License-Identifier: Apache-2.0
#include "esm_scenes.h"

#include <gnomon/lib/average.glsl>
#include <gtest/gtest.h>

#include <cstdio>
#include <random>

namespace gnomon::shared {
namespace {

constexpr double kBias = 0.0008;

MomentRule esmRule(double exponent, int flags)
{
    MomentRule rule{};
    rule.flags = flags;
    rule.sampling = kSamplingBilinear;
    rule.exponent = exponent;
    rule.power = 1.0;
    return rule;
}

double stored(double depth, const MomentRule& rule)
{
    return encodeEsm({depth, 0.0, glm::dvec4(0.0), glm::dvec4(0.0)}, rule).x;
}

double plain(double texel, double depth, const MomentRule& rule)
{
    return esmVisibility(esmExcess(texel, momentCoordinate(depth, rule.flags), rule));
}

FilterInput inputOf(const MomentRule& rule)
{
    FilterInput f{};
    f.moments = rule;
    f.tile = glm::dvec4(0.0, 0.0, test::kSceneTexels, test::kSceneTexels);
    f.near_over_far = 1.0;
    return f;
}

MapPoint pointAt(glm::dvec2 texel, double depth)
{
    MapPoint point{};
    point.texel = texel;
    point.depth = depth;
    point.cap = std::min(depth, 1.0);
    point.w = 1.0;
    point.texel_depth = kBias;
    return point;
}

TEST(Esm, oneDepthIsAStepWithAnExponentialEdge)
{
    for (const int flags : {0, kMomentRemap, kMomentLogSpace, kMomentLogSpace | kMomentRemap}) {
        for (const double c : {5.0, 11.0, 40.0}) {
            const MomentRule rule = esmRule(c, flags);
            for (double z = 0.0; z <= 1.0; z += 0.1) {
                for (double d = 0.0; d <= 1.0; d += 0.07) {
                    const double edge = std::exp(-c * momentScale(flags) * std::max(d - z, 0.0));
                    EXPECT_NEAR(plain(stored(z, rule), d, rule), edge, 1e-9);
                }
            }
        }
    }
}

TEST(Esm, neverDarkerThanTheTruth)
{
    std::mt19937 rng(5);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const MomentRule rule = esmRule(80.0, 0);
    for (int round = 0; round < 10000; ++round) {
        const double a = unit(rng);
        const double b = unit(rng);
        const double w = unit(rng);
        const double d = unit(rng);
        const double v = plain(w * stored(a, rule) + (1.0 - w) * stored(b, rule), d, rule);
        const double lit = (a >= d ? w : 0.0) + (b >= d ? 1.0 - w : 0.0);
        EXPECT_GE(v, lit - 1e-9);
        // And no lighter than what it is: each occluder's share, before which it is 1 and after which it decays.
        const double sum = w * std::exp(80.0 * (a - d)) + (1.0 - w) * std::exp(80.0 * (b - d));
        EXPECT_NEAR(v, std::min(sum, 1.0), 1e-9);
    }
}

TEST(Esm, logarithmsGiveTheSameAndDoNotOverflow)
{
    std::mt19937 rng(6);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (int round = 0; round < 5000; ++round) {
        const MomentRule linear = esmRule(1.0 + 79.0 * unit(rng), round % 2 == 0 ? 0 : kMomentRemap);
        MomentRule logs = linear;
        logs.flags |= kMomentLogSpace;
        const double a = unit(rng);
        const double b = unit(rng);
        const double w = 0.01 + 0.98 * unit(rng);
        const double d = unit(rng);
        const auto mean = [&](const MomentRule& rule) {
            const bool logarithms = averagesLogarithms(GNOMON_FILTER_ESM, rule.flags);
            const glm::dvec4 k = averageExponents(GNOMON_FILTER_ESM, rule);
            MomentSum sum = startAverage(glm::dvec4(stored(a, rule)), w, logarithms);
            sum = addToAverage(sum, glm::dvec4(stored(b, rule)), 1.0 - w, k, logarithms);
            return finishAverage(sum, k, logarithms).x;
        };
        const double expected = plain(mean(linear), d, linear);
        EXPECT_NEAR(plain(mean(logs), d, logs), expected, 1e-9 * expected);
        logs.exponent = 1e5; // e^100000
        const double far = plain(mean(logs), d, logs);
        EXPECT_TRUE(far >= 0.0 && far <= 1.0);
        if (std::abs(std::max(a, b) - d) > 0.01) {
            EXPECT_NEAR(far, std::max(a, b) >= d ? 1.0 : 0.0, 1e-9);
        }
    }
}

struct Errors {
    double before = 0.0;
    double after = 0.0;
    double darker = 0.0; // than the truth
};

Errors errorsOf(const test::EsmScene& scene, double sigma, int flags)
{
    const MomentRule rule = esmRule(80.0, flags);
    const bool logs = hasFlag(flags, kMomentLogSpace);
    std::vector<double> texels = test::blurred(
        test::sceneTexels([&](double x, double y) { return std::exp(80.0 * (scene.depth(x, y) - 0.5)); }), sigma);
    for (double& texel : texels) {
        texel = logs ? 0.5 + std::log(texel) / 80.0 : texel * std::exp(40.0);
    }
    const test::MomentImage image = test::imageOf(texels);
    const test::MomentImage truth =
        test::imageOf(test::blurred(test::sceneTexels([&](double x, double y) {
                                        return scene.depth(x, y) >= scene.receiver(x, y) - 1e-6 ? 1.0 : 0.0;
                                    }),
                                    sigma));
    test::map_moments = [&](glm::dvec2 texel, double level, double layer) {
        return image.read(texel, level, layer);
    };

    std::mt19937 rng(7);
    std::uniform_real_distribution<double> place(12.0, 84.0);
    Errors e;
    int count = 0;
    while (count < 3000) {
        const glm::dvec2 at(place(rng), place(rng));
        if (!scene.table(at.x, at.y)) {
            continue;
        }
        MapPoint point = pointAt(at, scene.receiver(at.x, at.y) - kBias);
        point.depth_slope = scene.slope;
        const double expected = truth.read(at, 0.0, 0.0).x;
        const double v = filterEsm(point, inputOf(rule));
        e.before += std::abs(plain(image.read(at, 0.0, 0.0).x, point.depth, rule) - expected);
        e.after += std::abs(v - expected);
        e.darker += std::max(expected - v, 0.0);
        ++count;
    }
    return {e.before / count, e.after / count, e.darker / count};
}

// The error is |V - truth|, meant over random receivers on the surface.
TEST(Esm, readsAroundTheReceiverHelpWhereSomethingIsBehindIt)
{
    for (const int flags : {0, kMomentLogSpace}) {
        for (const double sigma : {1.25, 3.0}) {
            for (const test::EsmScene& scene : test::esmScenes()) {
                const Errors e = errorsOf(scene, sigma, flags);
                std::printf("%s sigma %.2f  %-32s plain %.4f  handled %.4f  (darker %.4f)\n",
                            flags == 0 ? "linear" : "log   ", sigma, scene.name.c_str(), e.before, e.after, e.darker);
                EXPECT_LE(e.after, e.before * 1.02 + 1e-4) << scene.name;
                if (scene.name.find("far floor") != std::string::npos) {
                    EXPECT_LT(e.after, e.before * 0.75) << scene.name;
                }
            }
        }
    }
}

TEST(Esm, litSurfacesStayLit)
{
    for (const glm::dvec2 slope : {glm::dvec2(0.0), glm::dvec2(0.002, -0.001), glm::dvec2(-0.006, 0.004)}) {
        const MomentRule rule = esmRule(80.0, 0);
        const std::vector<double> texels = test::sceneTexels(
            [&](double x, double y) { return stored(0.6 + slope.x * (x - 48.0) + slope.y * (y - 48.0), rule); });
        const test::MomentImage image = test::imageOf(texels);
        test::map_moments = [&](glm::dvec2 texel, double level, double layer) {
            return image.read(texel, level, layer);
        };
        for (double x = 20.0; x < 76.0; x += 0.37) {
            const double depth = 0.6 + slope.x * (x - 48.0) + slope.y * (0.9 * x - 48.0);
            MapPoint point = pointAt({x, 0.9 * x}, depth - kBias);
            point.depth_slope = slope;
            EXPECT_EQ(filterEsm(point, inputOf(rule)), 1.0);
        }
    }
}

// A read that would leave the tile is made at its edge, and compared with the receiver's plane there.
TEST(Esm, readsAtTheTilesEdgeCompareWithThePlaneThere)
{
    const MomentRule rule = esmRule(80.0, 0);
    const glm::dvec2 slope(0.006, 0.0);
    const auto depth = [&](double x) {
        return 0.6 + slope.x * (x - 48.0);
    };
    const std::vector<double> texels = test::sceneTexels([&](double x, double) { return stored(depth(x), rule); });
    const test::MomentImage image = test::imageOf(texels);
    test::map_moments = [&](glm::dvec2 texel, double level, double layer) {
        return image.read(texel, level, layer);
    };
    MapPoint point = pointAt({0.6, 48.0}, depth(0.6) - kBias);
    point.depth_slope = slope;
    EXPECT_NEAR(esmExcessAt(point, inputOf(rule), {-kRing, 0.0}, 0.0), 80.0 * kBias, 1e-6);
}

// A receiver's bias of a texel's depth is more in z / w near the light, and still no sign of something behind it.
TEST(Esm, biasUnderALightNearByIsNoSign)
{
    MapPoint point = pointAt({48.0, 48.0}, 0.1);
    FilterInput f = inputOf(esmRule(80.0, kMomentZOverW));
    f.near_over_far = 0.05;
    const auto darkAround = [&](double behind) {
        test::map_moments = [&, behind](glm::dvec2 texel, double, double) {
            const double d = glm::length(texel - point.texel) < 1.0 ? point.depth + behind : 0.02;
            return glm::dvec4(stored(momentDepth(d, kMomentZOverW, f.near_over_far), f.moments));
        };
        return filterEsm(point, f);
    };
    EXPECT_EQ(darkAround(0.9 * point.texel_depth), 1.0);
    EXPECT_LT(darkAround(8.0 * point.texel_depth), 1.0) << "this is one";
}

} // namespace
} // namespace gnomon::shared
