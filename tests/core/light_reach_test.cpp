// SPDX-License-Identifier: Apache-2.0
// Maps of filters that follow rays to all of the light have room for them.
#include "light_reach.h"
#include "worlds.h"

#include <gnomon/planner.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string_view>

namespace gnomon {
namespace {

using test::Random;

TEST(LightReach, IsWhatARayToTheRimIsOff)
{
    Light sun = test::sun({0.0, -1.0, 0.0});
    sun.angular_diameter_rad = 0.1;
    LightSpace space;
    EXPECT_DOUBLE_EQ(lightReach(sun, space, 2.0, 12.0), std::tan(0.05) * 10.0);
    EXPECT_EQ(lightReach(sun, space, 12.0, 12.0), 0.0);
    Light lamp = test::spot({0.0, 0.0, 0.0}, {0.0, -1.0, 0.0}, 0.5, 20.0);
    lamp.radius_m = 0.2;
    space.perspective = true;
    space.near_m = 0.5;
    // From a point straight below at 10 m to the lamp's rim: at 2 m it is 0.16 m off, which is seen at a tangent of
    // 0.08.
    EXPECT_DOUBLE_EQ(lightReach(lamp, space, 2.0, 10.0), 0.2 * (1.0 - 0.2) / 2.0);
    EXPECT_DOUBLE_EQ(lightReach(lamp, space, 0.1, 10.0), 0.2 * (1.0 / 0.5 - 0.1))
        << "nothing casts before the near plane";
    lamp.radius_m = 0.0;
    EXPECT_EQ(lightReach(lamp, space, 2.0, 10.0), 0.0);
}

/// Posts on a ground, up to 12 m high.
struct Posts {
    ObjectSet set;
    std::vector<Light> lights{test::sun({0.4, -1.0, 0.2})};
    Frame frame;

    Posts()
    {
        set.add(test::boxAt({0, -0.5, 0}, {100, 0.5, 100}), {true, true, false});
        for (int z = -90; z <= 90; z += 15) {
            for (int x = -90; x <= 90; x += 15) {
                set.add(test::boxAt({x, 6, z}, {1, 6, 1}), {true, true, false});
            }
        }
        lights[0].angular_diameter_rad = 8.0 * std::numbers::pi / 180.0;
        frame.camera = test::perspectiveCamera({1.0, 3.0, 80.0}, {0.0, 1.0, 0.0}, 0.9);
        frame.lights = lights;
        frame.objects = &set;
    }
};

/// How many of the rays from what a view serves to the sun's rim leave its map before they are over all posts.
int raysThatLeave(Partition partition, Fit fit, Motion motion, Filter filter)
{
    const Posts posts;
    ShadowOptions options{.technique = kPlainTechnique};
    options.technique.partition = partition;
    options.technique.fit = fit;
    options.technique.motion = motion;
    options.technique.filter = filter;
    options.map_size = 512;
    const Plan plan = Planner(options).plan(posts.frame);
    const Light& light = posts.lights[0];
    const glm::dvec3 to_light = -glm::normalize(light.direction_ws);
    const glm::dvec3 right = glm::normalize(glm::cross(to_light, glm::dvec3(0.0, 0.0, 1.0)));
    const glm::dvec3 up = glm::cross(to_light, right);
    const double tangent = std::tan(0.5 * light.angular_diameter_rad);
    Random random(4);
    int left = 0;
    int served = 0;
    for (int i = 0; i < 20000; ++i) {
        const glm::dvec3 p(random.uniform(-90.0, 90.0), 0.0, random.uniform(-90.0, 90.0));
        const glm::dvec4 clip = posts.frame.camera.clip_from_world * glm::dvec4(p, 1.0);
        if (clip.w <= 0.0 || std::abs(clip.x) > clip.w || std::abs(clip.y) > clip.w) {
            continue;
        }
        const double depth = glm::dot(glm::dvec3(plan.views[0].serves.slice.axis), p - posts.frame.camera.eye_ws);
        const double turn = random.uniform(0.0, 6.2831853);
        const glm::dvec3 ray = to_light + (right * std::cos(turn) + up * std::sin(turn)) * tangent;
        const glm::dvec3 end = p + ray * (12.0 / ray.y);
        for (const View& view : plan.views) {
            if (depth < view.serves.slice.begin_m || depth > view.serves.slice.end_m) {
                continue;
            }
            const glm::dvec4 q = view.projection.clip_from_world * glm::dvec4(end, 1.0);
            left += std::abs(q.x) > q.w || std::abs(q.y) > q.w ? 1 : 0;
            ++served;
        }
    }
    EXPECT_GT(served, 1000);
    return left;
}

TEST(LightReach, NoRayLeavesItsMapTooSoon)
{
    for (const Partition partition : {Partition::single, Partition::cascades}) {
        for (const Fit fit : {Fit::uniform, Fit::lispsm, Fit::tsm, Fit::psm}) {
            EXPECT_EQ(raysThatLeave(partition, fit, Motion::free, Filter::raymarch), 0)
                << nameOf(partition) << ", " << nameOf(fit);
        }
        EXPECT_EQ(raysThatLeave(partition, Fit::uniform, Motion::snap, Filter::raymarch), 0) << nameOf(partition);
    }
}

TEST(LightReach, WithoutRoomRaysDoLeave)
{
    EXPECT_GT(raysThatLeave(Partition::cascades, Fit::uniform, Motion::free, Filter::pcf), 0);
}

Outcome outcomeUnder(const Light& light, Filter filter)
{
    ObjectSet set; // a plate over a ground
    set.add(test::boxAt({0, -0.5, 0}, {100, 0.5, 100}), {true, true, false});
    set.add(test::boxAt({0, 5, 0}, {1, 0.1, 1}), {true, true, false});
    Frame frame;
    frame.camera = test::perspectiveCamera({1.0, 3.0, 30.0}, {0.0, 1.0, 0.0}, 0.9);
    frame.lights = {&light, 1};
    frame.objects = &set;
    ShadowOptions options{.technique = kPlainTechnique};
    options.technique.filter = filter;
    options.map_size = 512;
    return Planner(options).plan(frame).lights[0].outcome;
}

/// Its discs are no way to see what is near and far under a wide light: it showed hard or blotched shadows there.
TEST(WideLights, AreRefusedByPcssAlone)
{
    Light sun = test::sun({0.4, -1.0, 0.2});
    for (const double degrees : {0.5, 8.0, 25.0, 25.5, 30.0, 60.0, 90.0}) {
        sun.angular_diameter_rad = degrees * std::numbers::pi / 180.0;
        const Outcome outcome = outcomeUnder(sun, Filter::pcss);
        EXPECT_EQ(outcome.kind, degrees > 25.0 ? OutcomeKind::refused : OutcomeKind::ok) << degrees;
        EXPECT_EQ(outcome.reason.find("25 degrees") != std::string_view::npos, degrees > 25.0);
        EXPECT_EQ(outcomeUnder(sun, Filter::raymarch).kind, OutcomeKind::ok) << degrees;
        EXPECT_EQ(outcomeUnder(sun, Filter::pcf).kind, OutcomeKind::ok) << degrees;
    }
    Light lamp = test::spot({0.0, 30.0, 0.0}, {0.0, -1.0, 0.0}, 0.5, 60.0);
    for (const double radius_m : {0.1, 1.0, 2.9, 3.2, 5.0}) { // over a ground 30 m below
        lamp.radius_m = radius_m;
        EXPECT_EQ(outcomeUnder(lamp, Filter::pcss).kind, radius_m > 3.0 ? OutcomeKind::refused : OutcomeKind::ok)
            << radius_m;
        EXPECT_EQ(outcomeUnder(lamp, Filter::raymarch).kind, OutcomeKind::ok) << radius_m;
    }
}

/// Its bounds are around the lamp, and say nothing of how near its walls are.
TEST(WideLights, InARoomOfOneObjectAreJudgedByItsCorners)
{
    ObjectSet set;
    set.add(test::boxAt({0, 0, 0}, {5, 3, 5}), {true, true, false});
    Light lamp = test::spot({0.0, 1.0, 0.0}, {0.0, -1.0, 0.0}, 0.5);
    for (const double radius_m : {0.0, 0.001, 0.5, 0.8}) {
        lamp.radius_m = radius_m;
        EXPECT_EQ(widthForPcss(lamp, set).kind, OutcomeKind::ok) << radius_m;
    }
    lamp.radius_m = 1.0;
    EXPECT_EQ(widthForPcss(lamp, set).kind, OutcomeKind::refused);
    lamp.position_ws = {0.0, 100.0, 0.0};
    lamp.range_m = 10.0; // reaches nothing
    lamp.radius_m = 9.0;
    EXPECT_EQ(widthForPcss(lamp, set).kind, OutcomeKind::ok);
}

} // namespace
} // namespace gnomon
