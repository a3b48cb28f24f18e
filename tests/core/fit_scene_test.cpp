// SPDX-License-Identifier: Apache-2.0
// fit=scene: one map around all of the scene, which no camera moves (Marinescu 2011, eq. 6).
#include "fit/scene.h"
#include "random_scenes.h"
#include "scene_memory.h"
#include "worlds.h"

#include <gnomon/planner.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace gnomon {
namespace {

using test::Random;

constexpr Technique kScene{Partition::single, Fit::scene, Filter::pcf, Soften::none, Motion::free};

ShadowOptions ofScene(Filter filter = Filter::pcf)
{
    ShadowOptions options{.technique = kScene};
    options.technique.filter = filter;
    options.map_size = 512;
    return options;
}

struct Field {
    ObjectSet set;
    std::vector<Light> lights{test::sun({0.5, -1.0, 0.25})};
    ObjectId kite;
    Frame frame;

    Field()
    {
        set.add({{-50, -1, -30}, {50, 0, 30}});
        for (int i = -4; i <= 4; ++i) {
            set.add(test::boxAt({10 * i, 1, 3 * i}, {1, 1, 1}));
        }
        kite = set.add(test::boxAt({0, 40, 0}, {1, 1, 1}), {true, true, true});
        frame.objects = &set;
        frame.lights = lights;
        look({0, 5, 20});
    }
    void look(const glm::dvec3& eye) { frame.camera = test::perspectiveCamera(eye, {0, 1, 0}, 0.8); }
};

TEST(FitScene, TheLightStandsWhereEquation6PutsIt)
{
    Field field;
    Planner planner(ofScene(Filter::hard));
    const View view = planner.plan(field.frame).views.at(0);
    const Aabb box = field.set.bounds();
    glm::dvec3 sum(0.0);
    for (int i = 0; i < 8; ++i) {
        sum += glm::dvec3(box.corner(i));
    }
    const glm::dvec3 dir = field.lights[0].direction_ws;
    const glm::dvec3 back = sum / 8.0 - view.projection.light_place_ws;
    const double distance = glm::dot(back, dir);
    EXPECT_LT(glm::length(back - dir * distance), 1e-9) << "backed out against the light and nowhere else";
    // As far as needed for all corners to be in front, and no farther except for rounding.
    double nearest = 1e9;
    for (int i = 0; i < 8; ++i) {
        nearest = std::min(nearest, glm::dot(dir, glm::dvec3(box.corner(i)) - view.projection.light_place_ws));
    }
    EXPECT_GT(nearest, 0.0);
    EXPECT_LT(nearest, 0.05);
    EXPECT_NEAR(view.projection.metric.near_m, 0.0, 1e-9) << "depths are counted from there";
    EXPECT_TRUE(view.projection.orthographic);
}

TEST(FitScene, NoCameraMovesItAndNothingIsDrawnAgain)
{
    for (const Filter filter : {Filter::hard, Filter::pcf, Filter::pcss, Filter::raymarch, Filter::vsm, Filter::lvsm}) {
        Field field;
        Planner planner(ofScene(filter));
        const View first = planner.plan(field.frame).views.at(0);
        EXPECT_TRUE(first.contents.redraw);
        const std::vector<std::uint32_t> casters = planner.plan(field.frame).casters;
        EXPECT_EQ(casters.size(), field.set.size()) << "everything is drawn, in sight or not";
        Random random(5);
        for (int i = 0; i < 50; ++i) {
            field.look(random.inBox({-60, 0.5, -40}, {60, 60, 40}));
            const Plan& plan = planner.plan(field.frame);
            if (plan.views.empty()) { // the camera sees nothing, but the map is kept
                continue;
            }
            const View& view = plan.views.at(0);
            EXPECT_FALSE(view.contents.redraw) << nameOf(filter) << " " << i;
            EXPECT_EQ(view.projection.clip_from_world, first.projection.clip_from_world);
            EXPECT_EQ(view.projection.metric.metric_ws, first.projection.metric.metric_ws);
            EXPECT_EQ(view.projection.light_place_ws, first.projection.light_place_ws);
            EXPECT_EQ(plan.casters, casters);
        }
        // The uniform fit follows the camera: what must fail does.
        ShadowOptions uniform = ofScene(filter);
        uniform.technique.fit = Fit::uniform;
        Planner other(uniform);
        field.look({0, 5, 20});
        (void)other.plan(field.frame);
        field.look({4, 6, 15});
        EXPECT_TRUE(other.plan(field.frame).views.at(0).contents.redraw);
    }
}

TEST(FitScene, WhatMovesInsideLeavesTheMatricesAndWhatLeavesMakesRoomOnce)
{
    Field field;
    Planner planner(ofScene());
    const glm::dmat4 first = planner.plan(field.frame).views.at(0).projection.clip_from_world;
    field.set.update(field.kite, test::boxAt({20, 30, 5}, {1, 1, 1}));
    const View moved = planner.plan(field.frame).views.at(0);
    EXPECT_EQ(moved.projection.clip_from_world, first);
    EXPECT_TRUE(moved.contents.redraw);
    field.set.update(field.kite, test::boxAt({20, 44, 5}, {1, 1, 1}));
    const glm::dmat4 second = planner.plan(field.frame).views.at(0).projection.clip_from_world;
    EXPECT_NE(second, first);
    for (const double height : {44.5, 45.0, 46.0}) {
        field.set.update(field.kite, test::boxAt({20, height, 5}, {1, 1, 1}));
        EXPECT_EQ(planner.plan(field.frame).views.at(0).projection.clip_from_world, second) << height;
    }
    planner.reset();
    EXPECT_NE(planner.plan(field.frame).views.at(0).projection.clip_from_world, second) << "reset() makes it anew";
}

TEST(FitScene, HoldsEveryCasterAndReceiver)
{
    int planned = 0;
    for (std::uint64_t seed = 0; seed < 2000; ++seed) {
        test::RandomScene scene = test::randomScene(seed, kPlainTechnique);
        scene.options.technique = kScene;
        scene.options.technique.filter = seed % 2 == 0 ? Filter::hard : Filter::vsm;
        Planner planner(scene.options);
        const Plan& plan = planner.plan(scene.frame());
        for (const View& view : plan.views) {
            ++planned;
            ASSERT_EQ(scene.lights[view.light].type, LightType::directional);
            const double size = scene.options.map_size.value_or(2048);
            for (std::uint32_t object = 0; object < scene.set.size(); ++object) {
                if (!scene.set.alive(object) || scene.set.bounds(object).empty()) {
                    continue;
                }
                for (int i = 0; i < 8; ++i) {
                    const glm::dvec4 clip = view.projection.clip_from_world *
                                            glm::dvec4(glm::dvec3(scene.set.bounds(object).corner(i)), 1.0);
                    // With room for the kernel on all sides.
                    const double margin = 2.0 * (resolve(scene.options)->borderOf(view.place.tile.width) - 0.01) / size;
                    ASSERT_LE(std::abs(clip.x), 1.0 - margin) << seed;
                    ASSERT_LE(std::abs(clip.y), 1.0 - margin) << seed;
                    ASSERT_GE(clip.z, 0.0) << seed;
                    ASSERT_LE(clip.z, 1.0) << seed;
                }
            }
            for (std::uint32_t object = 0; object < scene.set.size(); ++object) {
                const bool drawn = std::find(plan.casters.begin() + view.casters.first,
                                             plan.casters.begin() + view.casters.first + view.casters.count,
                                             object) != plan.casters.begin() + view.casters.first + view.casters.count;
                if (scene.set.alive(object) && scene.set.flags(object).casts && !scene.set.bounds(object).empty()) {
                    ASSERT_TRUE(drawn) << seed << " " << object;
                }
            }
        }
    }
    EXPECT_GT(planned, 1000);
}

TEST(FitScene, OfOneSunAndOneMap)
{
    const auto reason = [](LightType light, const Technique& technique) {
        return std::string(refusal(light, technique).value_or(""));
    };
    EXPECT_EQ(reason(LightType::directional, kScene), "");
    Technique technique = kScene;
    technique.partition = Partition::cascades;
    EXPECT_EQ(reason(LightType::directional, technique),
              "scene is one map around all of the scene, whatever is seen of it; it needs partition single or auto, "
              "which is single then");
    technique.partition = Partition::automatic;
    EXPECT_EQ(reason(LightType::directional, technique), "");
    EXPECT_EQ(resolvedOrThrow({.technique = technique}).technique().partition, Partition::single);
    EXPECT_EQ(reason(LightType::spot, kScene), "scene backs a sun out until all of the scene is before it; a light "
                                               "with a place stands where it stands, and needs another fit");
    technique = kScene;
    technique.soften = Soften::converge;
    EXPECT_NE(reason(LightType::directional, technique), "");
}

TEST(FitScene, StepsWithTheSun)
{
    Field field;
    ShadowOptions options = ofScene();
    options.technique.motion = Motion::step_blend;
    Planner planner(options);
    std::size_t most_views = 0;
    for (int i = 0; i < 20; ++i) {
        field.lights[0].direction_ws = glm::normalize(glm::dvec3(0.5 + 0.01 * i, -1.0, 0.25));
        const Plan& plan = planner.plan(field.frame);
        EXPECT_EQ(plan.lights[0].outcome.kind, OutcomeKind::ok) << plan.lights[0].outcome.reason;
        most_views = std::max(most_views, plan.views.size());
    }
    EXPECT_EQ(most_views, 2U) << "of two positions";
}

} // namespace
} // namespace gnomon
