// SPDX-License-Identifier: Apache-2.0
#define GNOMON_REAL double
#include <gnomon/shared/octahedral.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace gnomon::shared {
namespace {

glm::dvec3 randomDirection(std::mt19937& rng)
{
    std::normal_distribution<double> normal;
    return glm::normalize(glm::dvec3(normal(rng), normal(rng), normal(rng)));
}

TEST(Octahedral, roundTripIsExact)
{
    std::mt19937 rng(1);
    for (int i = 0; i < 10000; ++i) {
        const glm::dvec3 n = randomDirection(rng);
        const glm::dvec2 e = octahedralEncode(n);
        EXPECT_LE(std::max(std::abs(e.x), std::abs(e.y)), 1.0);
        EXPECT_LT(glm::length(octahedralDecode(e) - n), 1e-14);
    }
}

// The automatic bias allows for so much, and no vector needs more.
TEST(Octahedral, whatStoringTurnsAVectorByIsBounded)
{
    for (const double steps : {127.0, 2047.0, 32767.0}) {
        const double bound = kOctahedralStretch * 0.5 / steps;
        std::mt19937 rng(2);
        double worst = 0.0;
        for (int i = 0; i < 100000; ++i) {
            const glm::dvec3 n = randomDirection(rng);
            const glm::dvec2 stored = glm::round(octahedralEncode(n) * steps) / steps;
            worst = std::max(worst, glm::length(octahedralDecode(stored) - n));
        }
        EXPECT_LT(worst, bound * (1.0 + 1.0 / steps));
        EXPECT_GT(worst, 0.9 * bound);
    }
}

TEST(Octahedral, turnsMostInTheMiddleOfAFace)
{
    const double off = 1e-6;
    const glm::dvec3 n = glm::normalize(glm::dvec3(1.0));
    const glm::dvec3 turned = octahedralDecode(octahedralEncode(n) + glm::dvec2(off));
    EXPECT_NEAR(glm::length(turned - n) / off, 3.0 * std::sqrt(2.0), 1e-4);
}

} // namespace
} // namespace gnomon::shared
