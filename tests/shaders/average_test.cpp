// SPDX-License-Identifier: Apache-2.0
// Averages of values and of what they are logarithms of, against their definition.
#include "cpu_map.h"

#include <gnomon/lib/average.glsl>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace gnomon::shared {
namespace {

struct Taps {
    std::vector<glm::dvec4> values;
    std::vector<double> weights; // sum to 1
};

Taps randomTaps(std::mt19937& rng, int count)
{
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    Taps taps;
    double sum = 0.0;
    for (int i = 0; i < count; ++i) {
        taps.values.emplace_back(unit(rng), unit(rng), 2.0 * unit(rng) - 1.0, unit(rng));
        taps.weights.push_back(0.01 + unit(rng));
        sum += taps.weights.back();
    }
    for (double& w : taps.weights) {
        w /= sum;
    }
    return taps;
}

glm::dvec4 averaged(const Taps& taps, glm::dvec4 k, bool logarithms)
{
    MomentSum sum = startAverage(taps.values[0], taps.weights[0], logarithms);
    for (std::size_t i = 1; i < taps.values.size(); ++i) {
        sum = addToAverage(sum, taps.values[i], taps.weights[i], k, logarithms);
    }
    return finishAverage(sum, k, logarithms);
}

TEST(Average, ofValuesIsTheirWeightedSum)
{
    std::mt19937 rng(1);
    for (int round = 0; round < 1000; ++round) {
        const Taps taps = randomTaps(rng, 1 + round % 31);
        glm::dvec4 expected(0.0);
        for (std::size_t i = 0; i < taps.values.size(); ++i) {
            expected += taps.values[i] * taps.weights[i];
        }
        EXPECT_EQ(averaged(taps, glm::dvec4(0.0), false), expected);
    }
}

TEST(Average, ofLogarithmsIsTheLogarithmOfTheAverage)
{
    std::mt19937 rng(2);
    const glm::dvec4 k(40.0, 80.0, -5.0, -10.0);
    for (int round = 0; round < 1000; ++round) {
        const Taps taps = randomTaps(rng, 1 + round % 31);
        const glm::dvec4 v = averaged(taps, k, true);
        for (int c = 0; c < 4; ++c) {
            double expected = 0.0;
            for (std::size_t i = 0; i < taps.values.size(); ++i) {
                expected += taps.weights[i] * std::exp(k[c] * taps.values[i][c]);
            }
            EXPECT_NEAR(std::exp(k[c] * v[c]), expected, 1e-9 * expected);
        }
    }
}

TEST(Average, ofLogarithmsIsFiniteWhateverTheExponent)
{
    std::mt19937 rng(3);
    for (const double k : {1e4, 1e8, 1e30, -1e4, -1e30}) {
        for (int round = 0; round < 200; ++round) {
            const Taps taps = randomTaps(rng, 9);
            const double v = averaged(taps, glm::dvec4(k), true).x;
            double extreme = taps.values[0].x;
            for (const glm::dvec4& value : taps.values) {
                extreme = k > 0.0 ? std::max(extreme, value.x) : std::min(extreme, value.x);
            }
            // The smallest weight is above 1e-3, so that its logarithm is above -7.
            EXPECT_NEAR(v, extreme, 7.0 / std::abs(k) + 1e-15);
        }
    }
}

TEST(Average, ofFourWeighsAllAlike)
{
    std::mt19937 rng(4);
    const glm::dvec4 k(40.0, 80.0, -5.0, -10.0);
    for (const bool logarithms : {false, true}) {
        Taps taps = randomTaps(rng, 4);
        taps.weights.assign(4, 0.25);
        EXPECT_EQ(averageOfFour(taps.values[0], taps.values[1], taps.values[2], taps.values[3], k, logarithms),
                  averaged(taps, k, logarithms));
    }
}

TEST(Average, exponentsAreThoseOfTheFilter)
{
    MomentRule rule{};
    rule.exponent = 40.0;
    rule.exponent_negative = 5.0;
    for (int filter = 0; filter < 10; ++filter) {
        EXPECT_EQ(averageExponents(filter, rule), glm::dvec4(0.0)) << "values are stored as they are";
    }
    rule.flags = kMomentLogSpace;
    EXPECT_EQ(averageExponents(GNOMON_FILTER_ESM, rule), glm::dvec4(40.0));
    EXPECT_EQ(averageExponents(GNOMON_FILTER_EVSM, rule), glm::dvec4(40.0, 80.0, -5.0, -10.0));
    EXPECT_EQ(averageExponents(GNOMON_FILTER_VSM, rule), glm::dvec4(0.0)) << "vsm has no logarithms";
    EXPECT_EQ(averageExponents(GNOMON_FILTER_MSM, rule), glm::dvec4(0.0));
    EXPECT_FALSE(averagesLogarithms(3, kMomentLogSpace));
    EXPECT_TRUE(averagesLogarithms(GNOMON_FILTER_ESM, kMomentLogSpace));
}

} // namespace
} // namespace gnomon::shared
