// SPDX-License-Identifier: Apache-2.0
// The leaning depth of parallel light, and that filterable maps hold their receivers.
#include "worlds.h"

#include <gnomon/planner.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace gnomon {
namespace {

const glm::dvec3 kSun = glm::normalize(glm::dvec3(0.8, -0.9, -0.35));

struct Ground {
    ObjectSet set;
    std::vector<Light> lights{test::sun(kSun)};

    Ground()
    {
        set.add({{-40, 0, -40}, {40, 0.01F, 40}}, {false, true, false}); // level, so spared where it may be
        set.add({{-1, 0, -1}, {1, 4, 1}});
        set.add({{5, 0, 8}, {6, 3, 9}});
    }
    Plan plan(ShadowOptions options, Filter filter = Filter::vsm)
    {
        options.technique.filter = filter;
        Planner planner(options);
        Frame frame;
        frame.objects = &set;
        frame.lights = lights;
        frame.camera = test::orthographicCamera({0, 500, 0}, {0, 0, 0}, 60.0);
        return planner.plan(frame);
    }
};

double metricAt(const View& view, const glm::dvec3& p)
{
    return glm::dot(view.projection.metric.metric_ws, glm::dvec4(p, 1.0));
}

double spreadOverGround(const View& view)
{
    const double range_m = view.projection.metric.far_m - view.projection.metric.near_m;
    double low = 1e9;
    double high = -1e9;
    for (const glm::dvec3& p :
         {glm::dvec3(-40, 0, -40), glm::dvec3(40, 0, -40), glm::dvec3(-40, 0, 40), glm::dvec3(40, 0, 40)}) {
        low = std::min(low, metricAt(view, p) * range_m);
        high = std::max(high, metricAt(view, p) * range_m);
    }
    return high - low;
}

TEST(LevelDepth, LevelGroundIsLevelInDepthUnderASlantedSun)
{
    Ground ground;
    ShadowOptions options{.technique = kPlainTechnique};
    const View level = ground.plan(options).views.at(0);
    options.level_depth = false;
    const View along_axis = ground.plan(options).views.at(0);
    EXPECT_GT(spreadOverGround(along_axis), 50.0); // metres: the sun is 46 degrees high, the ground 80 m wide
    // The share of the axes is rounded to 1/128, and boxes on the ground pull at the plane a little.
    EXPECT_LT(spreadOverGround(level), 2.0);
    // Less range is more digits in every format.
    EXPECT_LT(level.projection.metric.far_m - level.projection.metric.near_m,
              0.5 * (along_axis.projection.metric.far_m - along_axis.projection.metric.near_m));
}

TEST(LevelDepth, IsForMapsThatAreAveraged)
{
    Ground ground;
    const View bare = ground.plan({}, Filter::hard).views.at(0);
    const glm::dvec3 gradient =
        glm::dvec3(bare.projection.metric.metric_ws) * (bare.projection.metric.far_m - bare.projection.metric.near_m);
    EXPECT_LT(glm::length(gradient - kSun), 1e-9);
}

TEST(LevelDepth, GrowsByOneMetrePerMetreAlongTheRay)
{
    Ground ground;
    const View view = ground.plan({}).views.at(0);
    const double range_m = view.projection.metric.far_m - view.projection.metric.near_m;
    for (const glm::dvec3& p : {glm::dvec3(0, 0, 0), glm::dvec3(30, 2, -20), glm::dvec3(-7, 3, 11)})
        EXPECT_NEAR((metricAt(view, p + kSun * 2.5) - metricAt(view, p)) * range_m, 2.5, 1e-9);
    // The rasteriser's depth is the metric still, so a bare depth map holds it.
    const glm::dvec4 clip = view.projection.clip_from_world * glm::dvec4(3, 1, 2, 1);
    EXPECT_NEAR(clip.z / clip.w, metricAt(view, {3, 1, 2}), 1e-12);
}

TEST(LevelDepth, LeavesSpotsAloneAndObjectsThatMove)
{
    Ground ground;
    const View before = ground.plan({}).views.at(0);
    ground.set.add({{-30, 0, 20}, {-20, 25, 30}}, {true, true, true});
    const View after = ground.plan({}).views.at(0);
    const double before_m = before.projection.metric.far_m - before.projection.metric.near_m;
    const double after_m = after.projection.metric.far_m - after.projection.metric.near_m;
    EXPECT_LT(glm::length(glm::dvec3(before.projection.metric.metric_ws) * before_m -
                          glm::dvec3(after.projection.metric.metric_ws) * after_m),
              1e-12);
    ground.lights[0] = test::sun(kSun);
    ground.lights[0].type = LightType::spot;
    ground.lights[0].position_ws = {-8, 12, 4};
    ground.lights[0].outer_half_angle_rad = 0.6;
    const View spot = ground.plan({}).views.at(0);
    const glm::dvec3 gradient =
        glm::dvec3(spot.projection.metric.metric_ws) * (spot.projection.metric.far_m - spot.projection.metric.near_m);
    EXPECT_LT(glm::length(gradient - kSun), 1e-9);
}

TEST(LevelDepth, FilterableMapsHoldTheirReceivers)
{
    Ground ground;
    const Plan spared = ground.plan({}, Filter::pcf);
    EXPECT_EQ(std::count(spared.casters.begin(), spared.casters.end(), 0U), 0);
    const Plan drawn = ground.plan({});
    EXPECT_EQ(std::count(drawn.casters.begin(), drawn.casters.end(), 0U), 1);
}

// An object that does not cast, drawn for its own shadow alone, would shade objects behind it.
TEST(LevelDepth, ReceiversThatDoNotCastAreLeftOutUnlessTheCameraSeesThem)
{
    Ground ground;
    const std::uint32_t first = ground.set.size();
    const glm::vec3 at(-150.0 * kSun); // beside what the camera sees, and in the way of the sun's rays to it
    const Aabb box{at - 1.0F, at + 1.0F};
    ground.set.add(box, {false, true, false});
    const Plan plan = ground.plan({});
    EXPECT_EQ(std::count(plan.casters.begin(), plan.casters.end(), 0U), 1);
    EXPECT_EQ(std::count(plan.casters.begin(), plan.casters.end(), first), 0);
    ground.set.add(box, {true, true, false});
    const Plan cast = ground.plan({});
    EXPECT_EQ(std::count(cast.casters.begin(), cast.casters.end(), first + 1), 1) << "it is in the way of the rays";
    EXPECT_EQ(std::count(cast.casters.begin(), cast.casters.end(), first), 0);
}

TEST(LevelDepth, ReceiversAloneThrowNoShadow)
{
    ObjectSet set;
    set.add({{-40, 0, -40}, {40, 0.01F, 40}}, {false, true, false});
    ShadowOptions options{.technique = kPlainTechnique};
    options.technique.filter = Filter::vsm;
    Planner planner(options);
    Frame frame;
    const std::vector<Light> lights{test::sun(kSun)};
    frame.objects = &set;
    frame.lights = lights;
    frame.camera = test::orthographicCamera({0, 500, 0}, {0, 0, 0}, 60.0);
    EXPECT_EQ(planner.plan(frame).lights.at(0).outcome.kind, OutcomeKind::no_caster);
}

} // namespace
} // namespace gnomon
