// SPDX-License-Identifier: Apache-2.0
// Smoothies against closed forms: what is packed, where edges are, and how visible a receiver beside one is.
#include "cpu_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace gnomon::shared {
namespace {

TEST(Smoothies, ComeBackFromTheirPacking)
{
    for (const double depth : {0.0, 0.25, 0.7, 1.0}) {
        for (const double distance : {0.0, 0.5, 17.25, 45.2}) {
            const Smoothie s = unpackSmoothie(packSmoothie({depth, distance}));
            EXPECT_NEAR(s.depth, depth, 0.51 / 65535.0);
            EXPECT_NEAR(s.distance, distance, 0.51 / kSmoothieSteps);
        }
    }
    EXPECT_LT(unpackSmoothie(packSmoothie({0.5, -1.0})).distance, 0.0);
    // The farthest that a reach allows is still told from none.
    EXPECT_GT(unpackSmoothie(packSmoothie({0.5, std::sqrt(2.0) * kMostSmoothieReach})).distance, 45.0);
}

TEST(Smoothies, EdgesAreWhereDepthFallsAndNotWhereASurfaceLeans)
{
    constexpr double kQuantum = 1e-5;
    EXPECT_TRUE(isEdge(0.2, 0.2, 0.6, 0.6, kQuantum));
    EXPECT_TRUE(isEdge(0.18, 0.2, 0.6, 0.62, kQuantum)); // between two that lean
    EXPECT_FALSE(isEdge(0.6, 0.6, 0.2, 0.2, kQuantum));  // the farther one has none
    for (const double slope : {0.001, 0.01, 0.1}) {
        EXPECT_FALSE(isEdge(0.2, 0.2 + slope, 0.2 + 2 * slope, 0.2 + 3 * slope, kQuantum)) << slope;
        EXPECT_FALSE(isEdge(0.2, 0.2, 0.2 + slope, 0.2 + 2 * slope, kQuantum)) << "a crease of " << slope;
    }
    EXPECT_FALSE(isEdge(0.2, 0.2, 0.2 + 1.9 * kQuantum, 0.2, kQuantum)) << "rounding";
}

TEST(Smoothies, AlphaGrowsEvenlyOverTheFin)
{
    EXPECT_DOUBLE_EQ(smoothieAlpha(0.0, 8.0, 16.0), 0.0);
    EXPECT_DOUBLE_EQ(smoothieAlpha(2.0, 8.0, 16.0), 0.25);
    EXPECT_DOUBLE_EQ(smoothieAlpha(8.0, 8.0, 16.0), 1.0);
    EXPECT_DOUBLE_EQ(smoothieAlpha(30.0, 8.0, 16.0), 1.0);
    // Where a penumbra is wider than its edge was made, nothing jumps at the edge's end.
    EXPECT_DOUBLE_EQ(smoothieAlpha(8.0, 100.0, 16.0), 0.5);
    EXPECT_DOUBLE_EQ(smoothieAlpha(16.0, 100.0, 16.0), 1.0);
    // In contact there is no penumbra.
    EXPECT_DOUBLE_EQ(smoothieAlpha(0.01, 0.0, 16.0), 1.0);
}

/// A half plane, x < 0, over the plane z = 0; the map is 64 texels wide and the edge in its middle.
struct HalfPlane {
    MapRows rows{};
    glm::dvec3 toward{};
    double spread = 0.0;
    double caster_depth = 0.0;

    [[nodiscard]] double visibility(const glm::dvec3& p, double reach = 32.0) const
    {
        test::map_texels = [this](int x, int) {
            return x < 32 ? caster_depth : 1.0;
        };
        test::map_smoothie = [this, reach](int x, int) {
            const bool near = x >= 32 && x < 32 + reach;
            return packSmoothie({caster_depth, near ? edgeDistance(x - 31, 0.0) : -1.0});
        };
        FilterInput f{};
        f.rows = rows;
        f.n = {0.0, 0.0, 1.0};
        f.toward = toward;
        f.spread = spread;
        f.smoothies = reach;
        return applyFilter(GNOMON_FILTER_HARD, projectReceiver(rows, {}, p, f.n), f);
    }
};

/// Under a sun from straight above, whose light comes 8 m down; a texel is `texel` metres wide.
HalfPlane underTheSun(double height, double tangent, double texel)
{
    HalfPlane scene;
    scene.rows.x = {1.0 / texel, 0.0, 0.0, 32.0};
    scene.rows.y = {0.0, 1.0 / texel, 0.0, 32.0};
    scene.rows.w = {0.0, 0.0, 0.0, 1.0};
    scene.rows.metric = {0.0, 0.0, -0.1, 0.9};
    scene.rows.texel_m = texel;
    scene.rows.range_m = 10.0;
    scene.toward = {0.0, 0.0, 1.0};
    scene.spread = tangent;
    scene.caster_depth = 0.9 - 0.1 * height;
    return scene;
}

TEST(Smoothies, UnderTheSunAPenumbraIsAsWideAsTheCastersHeightAsks)
{
    constexpr double kTangent = 0.05;
    for (const double height : {1.0, 2.0, 4.0}) {
        for (const double texels : {8.0, 16.0}) {
            const double width = height * kTangent;
            const double texel = width / texels;
            const HalfPlane scene = underTheSun(height, kTangent, texel);
            for (double share = 0.1; share < 1.4; share += 0.1) {
                // Two texels are averaged, and the one that is in shadow counts as 0.
                EXPECT_NEAR(scene.visibility({share * width, 0.0, 0.0}), std::min(share, 1.0), 0.75 / texels)
                    << height << " m, " << texels << " texels, at " << share;
            }
            EXPECT_DOUBLE_EQ(scene.visibility({-0.5 * width, 0.0, 0.0}), 0.0) << "the umbra of a point light";
        }
    }
}

TEST(Smoothies, InContactAShadowIsAsSharpAsItsMap)
{
    constexpr double kTexel = 0.02;
    const HalfPlane scene = underTheSun(0.1, 0.05, kTexel); // 10 cm above: a quarter of a texel
    EXPECT_DOUBLE_EQ(scene.visibility({1.51 * kTexel, 0.0, 0.0}), 1.0);
    EXPECT_DOUBLE_EQ(scene.visibility({-0.1 * kTexel, 0.0, 0.0}), 0.0);
}

/// Chan and Durand: alpha' = alpha / (1 - b / r), alpha being the share of a fin as wide as the lamp's radius, b and r
/// the lamp's distances to caster and receiver.
TEST(Smoothies, UnderALampTheyAreThoseOfChanAndDurand)
{
    constexpr double kLamp = 10.0;   // m above the receiver
    constexpr double kRadius = 0.2;  // m
    constexpr double kFocal = 512.0; // texels
    for (const double height : {1.0, 2.5, 5.0}) {
        HalfPlane scene;
        scene.rows.x = {kFocal, 0.0, -32.0, 32.0 * kLamp};
        scene.rows.y = {0.0, kFocal, -32.0, 32.0 * kLamp};
        scene.rows.w = {0.0, 0.0, -1.0, kLamp};
        scene.rows.metric = {0.0, 0.0, -0.09, 0.9};
        scene.rows.range_m = 1.0 / 0.09;
        scene.spread = kRadius;
        scene.caster_depth = 0.9 - 0.09 * height;
        const double b = kLamp - height;
        const double fin = kRadius / b * kFocal; // texels
        for (double texels = 1.5; texels < 20.0; texels += 1.0) {
            const glm::dvec3 p(texels / kFocal * kLamp, 0.0, 0.0);
            scene.toward = glm::dvec3(0.0, 0.0, kLamp) - p;
            const double expected = std::min(texels / fin / (1.0 - b / kLamp), 1.0);
            EXPECT_NEAR(scene.visibility(p), expected, 0.04) << height << " m, " << texels << " texels";
        }
    }
}

TEST(Smoothies, WhatIsBehindTheReceiverDoesNotDarkenIt)
{
    HalfPlane scene = underTheSun(2.0, 0.05, 0.02);
    EXPECT_LT(scene.visibility({0.03, 0.0, 0.0}), 0.9);
    EXPECT_DOUBLE_EQ(scene.visibility({0.03, 0.0, 3.0}), 1.0) << "above the caster";
}

} // namespace
} // namespace gnomon::shared
