// SPDX-License-Identifier: Apache-2.0
// Weights and point sets against their closed forms.
#define GNOMON_REAL double
#include <gnomon/shared/discs.h>
#include <gnomon/shared/pcf_weights.h>

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace gnomon::shared {
namespace {

TEST(PcfWeights, sumToOneAndAreSymmetric)
{
    for (const int width : {1, 3, 5, 7}) {
        for (const double sigma : {0.0, 0.3, 1.0, 1.75, 4.0}) {
            const glm::dvec4 w = gaussianWeights(width, sigma);
            double sum = 0.0;
            for (int i = 0; i < width; ++i) {
                sum += tapWeight(w, width, i);
                EXPECT_EQ(tapWeight(w, width, i), tapWeight(w, width, width - 1 - i));
                EXPECT_GT(tapWeight(w, width, i), 0.0);
            }
            EXPECT_NEAR(sum, 1.0, 1e-15);
            EXPECT_EQ(tapWeight(w, width, -1), 0.0);
            EXPECT_EQ(tapWeight(w, width, width), 0.0);
        }
    }
}

TEST(PcfWeights, areGaussian)
{
    const glm::dvec4 w = gaussianWeights(7, 1.3);
    for (int i = 1; i <= 3; ++i) {
        EXPECT_NEAR(w[i] / w[0], std::exp(-0.5 * i * i / (1.3 * 1.3)), 1e-15);
    }
    EXPECT_EQ(gaussianWeights(5, 0.0), gaussianWeights(5, 1.25));
}

TEST(PcfWeights, texelWeightsAreTheTapsBlended)
{
    for (const int width : {1, 3, 5, 7}) {
        const glm::dvec4 w = gaussianWeights(width, 0.0);
        for (const double f : {0.0, 0.25, 0.5, 0.999}) {
            double sum = 0.0;
            double centre = 0.0;
            for (int k = 0; k <= width; ++k) {
                sum += texelWeight(w, width, k, f);
                centre += k * texelWeight(w, width, k, f);
            }
            EXPECT_NEAR(sum, 1.0, 1e-15);
            // The kernel's centre of mass is the receiver itself, or shadows would be shifted.
            EXPECT_NEAR(centre, (width - 1) / 2 + f, 1e-14);
            EXPECT_NEAR(texelWeight(w, width, 0, f), texelWeight(w, width, width, 1.0 - f), 1e-15);
        }
    }
}

TEST(Discs, vogelFillsTheDiscEvenly)
{
    for (const int n : {4, 16, 64}) {
        glm::dvec2 mean(0.0);
        double second = 0.0;
        for (int i = 0; i < n; ++i) {
            const glm::dvec2 p = vogelPoint(i, n);
            EXPECT_LE(glm::length(p), 1.0);
            mean += p / double(n);
            second += glm::dot(p, p) / n;
        }
        EXPECT_LT(glm::length(mean), n == 4 ? 0.25 : 0.1);
        EXPECT_NEAR(second, 0.5, 1e-12) << "the second moment of a unit disc";
    }
}

TEST(Discs, poissonPrefixesAreSpreadOut)
{
    for (const int n : {4, 8, 16, 32, 64}) {
        glm::dvec2 mean(0.0);
        double second = 0.0;
        double nearest = 2.0;
        for (int i = 0; i < n; ++i) {
            const glm::dvec2 p = kPoissonPoints[i];
            EXPECT_LE(glm::length(p), 1.0);
            mean += p / double(n);
            second += glm::dot(p, p) / n;
            for (int j = 0; j < i; ++j) {
                nearest = std::min(nearest, glm::length(p - kPoissonPoints[j]));
            }
        }
        EXPECT_LT(glm::length(mean), n == 4 ? 0.25 : 0.12);
        EXPECT_NEAR(second, 0.5, 0.1);
        // The densest packing of n points in a disc has a distance of about 1.9 / sqrt(n).
        EXPECT_GT(nearest, 1.3 / std::sqrt(double(n))) << n;
    }
}

TEST(Discs, noiseIsSpreadOverNeighbours)
{
    double sum = 0.0;
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
            std::set<int> ninths;
            for (int k = 0; k < 9; ++k) {
                const double v = interleavedGradientNoise({x + k % 3 + 0.5, y + k / 3 + 0.5});
                EXPECT_GE(v, 0.0);
                EXPECT_LT(v, 1.0);
                ninths.insert(static_cast<int>(v * 9.0));
            }
            EXPECT_GE(ninths.size(), 7U);
            sum += interleavedGradientNoise({x + 0.5, y + 0.5});
        }
    }
    EXPECT_NEAR(sum / 4096.0, 0.5, 0.01);
}

} // namespace
} // namespace gnomon::shared
