// SPDX-License-Identifier: Apache-2.0
// Chebyshev's bounds in exponential warps, against random distributions of depth.
#include "cpu_map.h"

#include <gnomon/lib/average.glsl>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>

namespace gnomon::shared {
namespace {

struct Distribution {
    std::vector<double> depths;
    std::vector<double> weights;

    [[nodiscard]] double lit(double receiver) const
    {
        double sum = 0.0;
        for (std::size_t i = 0; i < depths.size(); ++i) {
            sum += depths[i] >= receiver ? weights[i] : 0.0;
        }
        return sum;
    }
};

Distribution randomDistribution(std::mt19937& rng, int points)
{
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    Distribution d;
    double sum = 0.0;
    for (int i = 0; i < points; ++i) {
        d.depths.push_back(unit(rng));
        d.weights.push_back(0.02 + unit(rng));
        sum += d.weights.back();
    }
    for (double& w : d.weights) {
        w /= sum;
    }
    return d;
}

MomentRule evsmRule(double positive, double negative, int flags)
{
    MomentRule rule{};
    rule.flags = flags;
    rule.sampling = kSamplingBilinear;
    rule.exponent = positive;
    rule.exponent_negative = negative;
    rule.power = 1.0;
    return rule;
}

glm::dvec4 encoded(double depth, double variance, const MomentRule& rule)
{
    return encodeEvsm({depth, variance, glm::dvec4(0.0), glm::dvec4(0.0)}, rule);
}

glm::dvec4 averaged(const Distribution& d, const MomentRule& rule)
{
    const glm::dvec4 k = averageExponents(GNOMON_FILTER_EVSM, rule);
    const bool logarithms = averagesLogarithms(GNOMON_FILTER_EVSM, rule.flags);
    MomentSum sum = startAverage(encoded(d.depths[0], 0.0, rule), d.weights[0], logarithms);
    for (std::size_t i = 1; i < d.depths.size(); ++i) {
        sum = addToAverage(sum, encoded(d.depths[i], 0.0, rule), d.weights[i], k, logarithms);
    }
    return finishAverage(sum, k, logarithms);
}

double visibility(const Distribution& d, double receiver, double least, const MomentRule& rule)
{
    return evsmVisibility(averaged(d, rule), momentCoordinate(receiver, rule.flags), least, rule);
}

TEST(Evsm, boundsAreAboveTheTruthAndBothTogetherTighter)
{
    std::mt19937 rng(11);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    double two_sum = 0.0;
    double four_sum = 0.0;
    double vsm_sum = 0.0;
    for (int round = 0; round < 10000; ++round) {
        const Distribution d = randomDistribution(rng, 1 + round % 6);
        const int flags = round % 2 == 0 ? 0 : kMomentRemap;
        const double receiver = unit(rng);
        const double two = visibility(d, receiver, 0.0, evsmRule(20.0, 5.0, flags));
        const double four = visibility(d, receiver, 0.0, evsmRule(20.0, 5.0, flags | kMomentFourChannels));
        double m1 = 0.0;
        double m2 = 0.0;
        for (std::size_t i = 0; i < d.depths.size(); ++i) {
            m1 += d.weights[i] * d.depths[i];
            m2 += d.weights[i] * d.depths[i] * d.depths[i];
        }
        EXPECT_GE(four, d.lit(receiver) - 1e-7);
        EXPECT_LE(four, two);
        EXPECT_LE(two, 1.0);
        two_sum += two - d.lit(receiver);
        four_sum += four - d.lit(receiver);
        vsm_sum += chebyshevBound(m1, m2, receiver, 0.0) - d.lit(receiver);
    }
    std::printf("mean light too much: vsm %.4f, evsm of two %.4f, of four %.4f\n", vsm_sum / 1e4, two_sum / 1e4,
                four_sum / 1e4);
    EXPECT_LT(four_sum, 0.9 * vsm_sum);
    EXPECT_LT(four_sum, 0.9 * two_sum);
}

TEST(Evsm, twoDepthsAreExactAtTheFartherOne)
{
    // Chebyshev's bound is met by two depths, the receiver being one of them.
    for (const int flags :
         {0, kMomentRemap, kMomentLogSpace, kMomentFourChannels, kMomentFourChannels | kMomentLogSpace}) {
        for (double w = 0.1; w < 1.0; w += 0.2) {
            const Distribution d{{0.3, 0.7}, {w, 1.0 - w}};
            EXPECT_NEAR(visibility(d, 0.7, 0.0, evsmRule(20.0, 5.0, flags)), 1.0 - w, 1e-9);
        }
    }
}

TEST(Evsm, logarithmsGiveTheSameAndDoNotOverflow)
{
    std::mt19937 rng(12);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (int round = 0; round < 5000; ++round) {
        const int flags = kMomentFourChannels | (round % 2 == 0 ? 0 : kMomentRemap);
        const Distribution d = randomDistribution(rng, 2 + round % 5);
        const double receiver = unit(rng);
        const double positive = 0.5 + 20.0 * unit(rng);
        const double least = 1e-4;
        const double linear = visibility(d, receiver, least, evsmRule(positive, 5.0, flags));
        const double logs = visibility(d, receiver, least, evsmRule(positive, 5.0, flags | kMomentLogSpace));
        EXPECT_NEAR(logs, linear, 1e-9 * std::max(linear, 1e-3));
        for (const double huge : {500.0, 1e5, 3e38}) {
            const double v = visibility(d, receiver, 1e-12, evsmRule(huge, huge, flags | kMomentLogSpace));
            EXPECT_TRUE(v >= 0.0 && v <= 1.0) << huge;
            // (1e30 times the rounding of a depth is anything.)
            EXPECT_GE(v, huge < 1e6 ? d.lit(receiver) - 1e-6 : 0.0) << huge;
        }
    }
    const Distribution d{{0.2, 0.9}, {0.5, 0.5}};
    EXPECT_FALSE(std::isfinite(averaged(d, evsmRule(500.0, 5.0, 0)).y)) << "or there is nothing to show";
    EXPECT_TRUE(std::isfinite(averaged(d, evsmRule(500.0, 5.0, kMomentLogSpace)).y));
}

TEST(Evsm, leastVarianceIsThatOfDepth)
{
    // Just behind one depth, where the warp is a line: v / (v + (d - z)^2), in each warp.
    const double step = 1e-5;
    const double least = 1e-8;
    for (const int flags : {0, kMomentFourChannels, kMomentLogSpace, kMomentFourChannels | kMomentLogSpace}) {
        for (double z = 0.05; z < 1.0; z += 0.1) {
            const Distribution d{{z}, {1.0}};
            const double v = visibility(d, z + step, least, evsmRule(40.0, 5.0, flags));
            EXPECT_NEAR(v, least / (least + step * step), 2e-4);
        }
    }
}

// Rounding errs by a share of the stored value. On a lit surface that is the receiver's own warp, and neither warp may
// darken it. In a warp that shrinks things before the receiver, a share of that lights nothing.
TEST(Evsm, whatHidesRoundingLightsNoDeepShadow)
{
    const Distribution lit{{0.7}, {1.0}};
    const Distribution deep{{0.1, 0.4}, {0.5, 0.5}};
    for (const int flags : {0, int(kMomentLogSpace)}) {
        for (const double share : {1e-4, 0.1}) {
            MomentRule rule = evsmRule(40.0, 5.0, flags | kMomentFourChannels);
            rule.rounding = share;
            rule.rounding_negative = share;
            // Just behind, by a part of what e^(c x) grows by: s / (s + d^2), the smaller one of both warps'.
            const double behind = 0.1 * std::sqrt(share) / 40.0;
            EXPECT_NEAR(visibility(lit, 0.7 + behind, 0.0, rule), 1.0 / 1.01, 2e-3);
            EXPECT_LT(visibility(deep, 0.7, 0.0, rule), 1e-6);
            MomentRule as_depth = evsmRule(40.0, 5.0, flags); // the same on what is lit, but as a variance of depth
            EXPECT_NEAR(visibility(deep, 0.7, share / 1600.0, as_depth), share / (1.0 + share), 1e-3);
        }
    }
}

// Each warp is given what its own rounding asks for: a large share in one opens only that one.
TEST(Evsm, eachWarpHasItsOwnShare)
{
    const Distribution lit{{0.7}, {1.0}};
    for (const int flags : {0, int(kMomentLogSpace)}) {
        MomentRule rule = evsmRule(40.0, 5.0, flags | kMomentFourChannels);
        const double behind = 0.01;
        rule.rounding = 0.0;
        rule.rounding_negative = 1.0;
        const double positive_alone = visibility(lit, 0.7 + behind, 0.0, rule);
        rule.rounding = 1.0;
        rule.rounding_negative = 0.0;
        const double negative_alone = visibility(lit, 0.7 + behind, 0.0, rule);
        rule.rounding_negative = 1.0;
        const double both = visibility(lit, 0.7 + behind, 0.0, rule);
        EXPECT_LT(positive_alone, 1e-3);
        EXPECT_LT(negative_alone, 1e-3);
        EXPECT_GT(both, 0.8);
    }
}

// The allowance for slopes grows with the square of the exponent. It must not light surfaces in shadow, however large
// an exponent logarithms allow. Slopes stay lit without it.
TEST(Evsm, noExponentLightsDeepShadowForTheSakeOfSlopes)
{
    MapPoint point{};
    point.texel = {8.0, 8.0};
    point.texel_depth = 1.0 / 400.0;
    for (const int flags : {int(kMomentLogSpace), kMomentLogSpace | kMomentFourChannels,
                            kMomentLogSpace | kMomentFourChannels | kMomentRemap}) {
        for (const double c : {40.0, 200.0, 1000.0, 10000.0}) {
            FilterInput f{};
            f.moments = evsmRule(c, 5.0, flags);
            f.moments.min_variance_texels = 0.5;
            f.tile = {0.0, 0.0, 16.0, 16.0};
            f.near_over_far = 1.0;
            Distribution slope;
            for (int i = -4; i <= 4; ++i) {
                slope.depths.push_back(0.7 + 2.0 * point.texel_depth * i);
                slope.weights.push_back(std::exp(-0.32 * i * i) / 3.1324);
            }
            const Distribution dark{{0.3}, {1.0}};
            const auto read = [&](const Distribution& d, double receiver) {
                test::map_moments = [&](glm::dvec2, double, double) {
                    return averaged(d, f.moments);
                };
                point.depth = receiver;
                return filterEvsm(point, f);
            };
            EXPECT_LT(read(dark, 0.7), 0.011) << flags << ' ' << c;
            EXPECT_GT(read(slope, 0.7 - 0.2 * point.texel_depth), 0.98) << flags << ' ' << c;
        }
    }
}

TEST(Evsm, varianceOfATexelScalesWithTheSlopeOfTheWarp)
{
    const double variance = 1e-6;
    for (const int remap : {0, int(kMomentRemap)}) {
        for (double z = 0.05; z < 0.95; z += 0.1) {
            const MomentRule rule = evsmRule(20.0, 5.0, kMomentFourChannels | remap);
            const double scale = momentScale(remap);
            const glm::dvec4 m = encoded(z, variance, rule);
            EXPECT_NEAR(m.y / (m.x * m.x), 1.0 + 400.0 * variance * scale * scale, 1e-12);
            EXPECT_NEAR(m.w / (m.z * m.z), 1.0 + 25.0 * variance * scale * scale, 1e-12);
            const MomentRule logs = evsmRule(20.0, 5.0, rule.flags | kMomentLogSpace);
            const glm::dvec4 v = encoded(z, variance, logs);
            const glm::dvec4 k = averageExponents(GNOMON_FILTER_EVSM, logs);
            EXPECT_NEAR(std::exp(k.y * v.y), m.y, 1e-9 * m.y);
            EXPECT_NEAR(std::exp(k.w * v.w), m.w, 1e-9 * m.w);
        }
    }
    // At the far plane it would not fit the format: it is as much as fits.
    const MomentRule rule = evsmRule(5.54, 5.54, kMomentFourChannels);
    EXPECT_LE(encoded(1.0, 0.5, rule).y, 65504.0);
    EXPECT_LE(encoded(0.0, 0.5, evsmRule(5.54, 5.54, kMomentFourChannels | kMomentRemap)).w, 65504.0);
}

} // namespace
} // namespace gnomon::shared
