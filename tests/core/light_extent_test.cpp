// SPDX-License-Identifier: Apache-2.0
// What the zeros of a light stand for, and how much of a tile a filter can use.
#include "worlds.h"

#include <gnomon/planner.h>

#include <gtest/gtest.h>

#include <cmath>

namespace gnomon {
namespace {

Light lampOf(double near_m, double range_m)
{
    Light light = test::spot({0, 10, 0}, {0, -1, 0}, 0.5, range_m);
    light.near_m = near_m;
    return light;
}

const Aabb kScene{{-20, 0, -20}, {20, 5, 20}};
const double kFarthest_m = std::sqrt(20.0 * 20.0 * 2.0 + 10.0 * 10.0);

TEST(LightExtent, IsWhatTheLightSaysWhereItSaysSo)
{
    const LightExtent extent = extentOf(lampOf(0.25, 30.0), kScene);
    EXPECT_EQ(extent.near_m, 0.25);
    EXPECT_EQ(extent.reach_m, 30.0);
}

TEST(LightExtent, OfZerosComesFromTheScene)
{
    const LightExtent both = extentOf(lampOf(0.0, 0.0), kScene);
    EXPECT_NEAR(both.reach_m, kFarthest_m, 1e-12);
    EXPECT_NEAR(both.near_m, 0.001 * kFarthest_m, 1e-15);
    EXPECT_NEAR(extentOf(lampOf(0.0, 8.0), kScene).near_m, 0.008, 1e-15);
    // A near distance as far as the scene leaves room behind it.
    EXPECT_EQ(extentOf(lampOf(40.0, 0.0), kScene).reach_m, 80.0);
    // All there is lies at the light itself.
    const LightExtent nowhere = extentOf(lampOf(0.0, 0.0), {{0, 10, 0}, {0, 10, 0}});
    EXPECT_EQ(nowhere.reach_m, 1.0);
    EXPECT_EQ(nowhere.near_m, 0.001);
}

TEST(LightExtent, OfASunIsNothing)
{
    const LightExtent extent = extentOf(test::sun({0, -1, 0}), kScene);
    EXPECT_EQ(extent.near_m, 0.0);
    EXPECT_EQ(extent.reach_m, 0.0);
}

TEST(LightExtent, IsWhereThePlannersMapsBegin)
{
    ObjectSet set;
    set.add({{-20, 0, -20}, {20, 0, 20}});
    set.add({{-0.2F, 9, -0.2F}, {0.2F, 10, 0.2F}}); // up to the light's own place
    for (const double near_m : {0.0, 0.05}) {
        const std::vector<Light> lights{lampOf(near_m, 0.0)};
        Frame frame;
        frame.camera = test::perspectiveCamera({30, 20, 0}, {0, 5, 0}, 1.0);
        frame.lights = lights;
        frame.objects = &set;
        Planner planner(ShadowOptions{.technique = kPlainTechnique});
        const Plan& plan = planner.plan(frame);
        ASSERT_EQ(plan.views.size(), 1U);
        EXPECT_EQ(plan.views[0].metric.near_m, extentOf(lights[0], set.bounds()).near_m);
    }
}

TEST(TileMargin, KeepsEveryTexelThatIsReadInsideTheTile)
{
    constexpr double kSize = 64.0;
    for (const double reach : {0.5, 1.0, 2.0, 4.0, 4.25, 17.0}) {
        SCOPED_TRACE(reach);
        // The outermost texels that have their centre within reach of a place.
        const auto first = [&](double place) {
            return std::ceil(place - reach - 0.5);
        };
        const auto last = [&](double place) {
            return std::floor(place + reach - 0.5);
        };
        const double margin = tileMarginTexels(reach);
        EXPECT_EQ(first(margin), 0.0);
        EXPECT_EQ(last(kSize - margin), kSize - 1.0);
        // A hundredth of a texel nearer to the edge would be too near.
        EXPECT_EQ(first(margin - 0.01), -1.0);
        EXPECT_EQ(last(kSize - margin + 0.01), kSize);
    }
}

} // namespace
} // namespace gnomon
