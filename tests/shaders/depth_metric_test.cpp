// SPDX-License-Identifier: Apache-2.0
#define GNOMON_REAL double
#include <gnomon/lib/caster.glsl>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace gnomon::shared {
namespace {

TEST(DepthMetric, isLinearBetweenNearAndFar)
{
    EXPECT_EQ(depthMetricLinear(2.0, 2.0, 10.0), 0.0);
    EXPECT_EQ(depthMetricLinear(10.0, 2.0, 10.0), 1.0);
    EXPECT_EQ(depthMetricLinear(4.0, 2.0, 10.0), 0.25);
    EXPECT_EQ(casterStored(-0.5), 0.0);
    EXPECT_EQ(casterStored(1.5), 1.0);
    EXPECT_EQ(casterStored(0.5), 0.5);
}

// Marinescu 2011, section 4: computed at the vertices and interpolated, or computed at the point, is the same.
TEST(DepthMetric, interpolationOverATriangleIsExact)
{
    std::mt19937 rng(9);
    std::uniform_real_distribution<double> u(-1.0, 1.0);
    const auto random3 = [&] {
        return glm::dvec3(u(rng), u(rng), u(rng));
    };
    for (int i = 0; i < 1000; ++i) {
        const glm::dvec3 a = random3();
        const glm::dvec3 b = random3();
        const glm::dvec3 c = random3();
        const glm::dvec4 metric(random3(), u(rng));
        const double s = (u(rng) + 1.0) / 4.0;
        const double t = (u(rng) + 1.0) / 4.0;
        const double interpolated =
            casterMetric(a, metric) * (1.0 - s - t) + casterMetric(b, metric) * s + casterMetric(c, metric) * t;
        EXPECT_NEAR(casterMetric(a * (1.0 - s - t) + b * s + c * t, metric), interpolated, 1e-14);
    }
}

TEST(CasterMidpoint, LiesBetweenTwoSurfacesOrOnTheOnlyOne)
{
    EXPECT_EQ(casterMidpoint(0.25, 0.5), 0.375);
    EXPECT_EQ(casterMidpoint(0.25, 1.0), 0.25) << "what is open casts";
    EXPECT_EQ(casterMidpoint(1.0, 1.0), 1.0) << "nothing casts there";
}

TEST(CasterMidpoint, WhatIsWithinTheRoundingIsTheSameSurface)
{
    EXPECT_FALSE(casterBehind(0.5, 0.5, 0.0));
    EXPECT_FALSE(casterBehind(0.5001, 0.5, 0.001));
    EXPECT_TRUE(casterBehind(0.502, 0.5, 0.001));
    EXPECT_FALSE(casterBehind(0.4, 0.5, 0.001));
}

// Depth of [0, 1] that is scaled as OpenGL's depth of [-1, 1] lies in [0.5, 1] and has half the codes. Maps store the
// metric, from 0 to 1 whatever the camera's clip space.
TEST(DepthMetric, theUpperHalfAloneRoundsTwiceAsCoarsely)
{
    const auto rounded = [](double depth) {
        return std::round(depth * 65535.0) / 65535.0;
    };
    double worst = 0.0;
    double worst_of_half = 0.0;
    for (int i = 0; i <= 1000000; ++i) {
        const double depth = casterStored(i / 1e6);
        worst = std::max(worst, std::abs(rounded(depth) - depth));
        const double read = 2.0 * (rounded(0.5 + 0.5 * depth) - 0.5);
        worst_of_half = std::max(worst_of_half, std::abs(read - depth));
    }
    EXPECT_NEAR(worst, 0.5 / 65535.0, 1e-8);
    EXPECT_NEAR(worst_of_half, 1.0 / 65535.0, 1e-8);
}

} // namespace
} // namespace gnomon::shared
