// SPDX-License-Identifier: Apache-2.0
// The meaning of a light's zeros, and the part of a tile that a filter can use.
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
        // Bounds around the light do not tell how near the caster is.
        const LightExtent extent = extentOf(lights[0], set.bounds());
        EXPECT_EQ(plan.views[0].projection.metric.near_m, near_m > 0.0 ? near_m : 0.00025 * extent.reach_m);
    }
}

TEST(NearDistance, IsBeforeTheNearestBoundsOfACaster)
{
    // A caster so far below the lamp, and the near distance, in a world of which a thousandth of the reach is 4.2 m.
    const std::vector<std::pair<float, double>> all{{9.0F, 4.0}, {0.7F, 0.25}, {0.3F, 0.125}, {0.06F, 0.04243}};
    for (const auto& [below_m, near_m] : all) {
        SCOPED_TRACE(below_m);
        for (const bool is_point : {false, true}) {
            ObjectSet set;
            set.add({{-3000, 0, -3000}, {3000, 0, 3000}});
            set.add({{-0.2F, 9.9F - below_m, -0.2F}, {0.2F, 10.0F - below_m, 0.2F}});
            set.add({{-0.01F, 9.99F, -0.01F}, {0.01F, 9.995F, 0.01F}}, {.casts = false});
            std::vector<Light> lights{lampOf(0.0, 0.0)};
            lights[0].type = is_point ? LightType::point : LightType::spot;
            Frame frame;
            frame.camera = test::perspectiveCamera({30, 20, 0}, {0, 0, 0}, 1.0);
            frame.lights = lights;
            frame.objects = &set;
            ShadowOptions options{.technique = kPlainTechnique};
            options.technique.partition = is_point ? Partition::cube : Partition::single;
            Planner planner(options);
            const Plan& plan = planner.plan(frame);
            ASSERT_FALSE(plan.views.empty());
            double nearest_m = plan.views[0].projection.metric.near_m;
            for (const View& view : plan.views) {
                nearest_m = std::min(nearest_m, view.projection.metric.near_m);
            }
            EXPECT_GT(nearest_m, 0.999 * near_m);
            EXPECT_LT(nearest_m, std::max(1.0 * below_m, 1.01 * near_m));
            EXPECT_EQ(lights[0].near_m, 0.0) << "the host's own";
        }
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
