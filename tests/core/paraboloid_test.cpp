// SPDX-License-Identifier: Apache-2.0
// The two half spaces of a point light: which there are, where they have what, and what options they come with.
#include "hall.h"

#include <gnomon/plan_views.h>

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace gnomon {
namespace {

test::Hall paraboloidHall()
{
    test::Hall hall;
    hall.options.technique.partition = Partition::paraboloid;
    hall.options.map_size = 256;
    return hall;
}

TEST(Paraboloids, ALampOverAFloorHasAMapBelowAlone)
{
    test::Hall hall = paraboloidHall();
    hall.addLamp({0.0, 3.0, 0.0}, 12.0);
    hall.look({0.0, 12.0, 20.0}, {0.0, 0.0, 0.0});
    Planner planner(hall.options);
    const Plan& plan = planner.plan(hall.frame);
    ASSERT_EQ(plan.views.size(), 1U) << "nothing is above the lamp";
    const View& view = plan.views[0];
    EXPECT_TRUE(view.projection.paraboloid);
    EXPECT_FALSE(view.projection.orthographic);
    EXPECT_FALSE(view.projection.parallel);
    EXPECT_TRUE(view.serves.sector.bounded());
    EXPECT_TRUE(view.serves.sector.holds({5.0, 2.9, -1.0}));
    EXPECT_FALSE(view.serves.sector.holds({5.0, 3.1, -1.0}));
    EXPECT_NE(toJson(plan).find("\"paraboloid\": true"), std::string::npos);
    // A caster above it gives it the other one, too.
    hall.set.add(test::boxAt({2.0, 5.0, 0.0}, {0.5, 0.5, 0.5}));
    hall.set.add(test::boxAt({4.0, 7.0, 0.0}, {1.0, 0.5, 1.0}));
    const Plan& both = planner.plan(hall.frame);
    ASSERT_EQ(both.views.size(), 2U);
    EXPECT_TRUE(both.views[0].serves.sector.holds({0.0, 4.0, 0.0})) << "above comes first";
    EXPECT_TRUE(both.views[1].serves.sector.holds({0.0, 2.0, 0.0}));
}

TEST(Paraboloids, PlacesAndDepthsAreThoseOfTheFormula)
{
    test::Hall hall = paraboloidHall();
    const glm::dvec3 lamp(1.0, 3.0, -2.0);
    hall.addLamp(lamp, 12.0);
    hall.look({0.0, 12.0, 20.0}, {0.0, 0.0, 0.0});
    Planner planner(hall.options);
    const View view = planner.plan(hall.frame).views.at(0);
    const auto place = [&](const glm::dvec3& ray) {
        return placeOnMap(view, lamp + ray).value();
    };
    const double radius = 1.0 - 2.0 * 4.0 / 256.0; // the border has 4 texels
    EXPECT_NEAR(glm::length(place({0.0, -2.0, 0.0})), 0.0, 1e-12);
    for (const glm::dvec3 ray : {glm::dvec3(1, 0, 0), glm::dvec3(0, 0, -3), glm::dvec3(2, 0, 2)}) {
        EXPECT_NEAR(glm::length(place(ray)), radius, 1e-12) << "the rim";
    }
    const double angle = 0.8;
    EXPECT_NEAR(glm::length(place({std::sin(angle), -std::cos(angle), 0.0})), radius * std::tan(0.4), 1e-12);
    EXPECT_EQ(placeOnMap(view, lamp + glm::dvec3(0.0, 2.0, 0.0)), std::nullopt) << "straight behind";
    for (const double metres : {view.projection.metric.near_m, 3.0, view.projection.metric.far_m}) {
        const double expected =
            (metres - view.projection.metric.near_m) / (view.projection.metric.far_m - view.projection.metric.near_m);
        EXPECT_NEAR(depthOnMap(view, lamp + glm::normalize(glm::dvec3(3.0, -1.0, 2.0)) * metres), expected, 1e-12);
    }
    // As wide as is said: a texel in the middle, and at the rim.
    EXPECT_NEAR(view.fit.coarsest_texel.x, 4.0 / (radius * 256.0), 1e-12);
    EXPECT_NEAR(view.fit.finest_texel.x, 2.0 / (radius * 256.0), 1e-12);
    EXPECT_EQ(view.projection.texel_m, view.fit.coarsest_texel.x);
}

TEST(Paraboloids, AutoIsPcfAndUniform)
{
    ShadowOptions options;
    options.technique = {.partition = Partition::paraboloid};
    const ResolvedOptions resolved = resolvedOrThrow(options);
    EXPECT_EQ(resolved.filter(), Filter::pcf);
    EXPECT_EQ(resolved.technique().fit, Fit::uniform);
    options.technique.partition = Partition::cube;
    EXPECT_EQ(resolvedOrThrow(options).filter(), Filter::raymarch);
    options.technique = {.partition = Partition::paraboloid, .filter = Filter::pcf};
    options.faces = CasterFaces::midpoint;
    EXPECT_NE(resolve(options).refusal.find("first surfaces"), std::string::npos);
    options.faces = CasterFaces::back;
    EXPECT_TRUE(resolve(options).refusal.empty());
}

TEST(Paraboloids, MapSizeAutoHalvesBothMapsAlike)
{
    test::Hall hall = paraboloidHall();
    hall.options.map_size.reset();
    hall.options.max_texels = 8192 * 8192;
    hall.addLamp({0.0, 3.0, 0.0}, 12.0);
    hall.look({0.0, 12.0, 20.0}, {0.0, 0.0, 0.0});
    Planner planner(hall.options);
    const std::uint32_t from_near = planner.plan(hall.frame).views.at(0).place.tile.width;
    EXPECT_LE(from_near, 4096U) << "two maps share the texels of one, in squares";
    hall.look({0.0, 80.0, 130.0}, {0.0, 0.0, 0.0});
    hall.frame.cut = true;
    planner.reset();
    EXPECT_LT(planner.plan(hall.frame).views.at(0).place.tile.width, from_near);
}

TEST(Paraboloids, WhatMovesIsDrawnOverAllOfAMapThatIsKept)
{
    test::Hall hall = paraboloidHall();
    hall.options.keep_still = KeepStill::always;
    hall.addLamp({0.0, 3.0, 0.0}, 12.0);
    hall.look({0.0, 12.0, 20.0}, {0.0, 0.0, 0.0});
    const ObjectId mover = hall.set.add(test::boxAt({2.0, 1.0, 0.0}, {0.3, 0.3, 0.3}), {.dynamic = true});
    Planner planner(hall.options);
    (void)planner.plan(hall.frame);
    (void)planner.plan(hall.frame);
    hall.set.update(mover, test::boxAt({2.2, 1.0, 0.0}, {0.3, 0.3, 0.3}));
    const View& view = planner.plan(hall.frame).views.at(0);
    ASSERT_NE(view.contents.kept_layer, kNoIndex);
    EXPECT_EQ(view.contents.dirty.width, view.place.tile.width);
    EXPECT_EQ(view.contents.dirty.height, view.place.tile.height);
}

} // namespace
} // namespace gnomon
