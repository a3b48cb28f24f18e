// SPDX-License-Identifier: Apache-2.0
// A light's maps are its own affair: what other lights do, and whether it is in sight, changes neither their names and
// places nor what they hold.
#include "allocation_count.h"
#include "worlds.h"

#include <gnomon/plan_views.h>
#include <gnomon/planner.h>

#include <gtest/gtest.h>

#include <map>
#include <set>

namespace gnomon {
namespace {

/// The maps of a light and their contents.
struct Have {
    std::vector<MapId> maps;
    std::vector<ContentNumber> hold;
    bool redrawn = false;
};

struct World {
    World()
    {
        test::Random random(3);
        set.add({{-30, -0.5, -30}, {30, 0, 30}});
        for (int i = 0; i < 60; ++i)
            set.add(test::boxAt(random.inBox({-28, 0.5, -28}, {28, 6, 28}), glm::dvec3(0.5)));
        frame.objects = &set;
        frame.camera = test::perspectiveCamera({20, 15, 25}, {0, 0, 0}, 1.0, 1.6, 0.1, 200.0);
    }
    Light& addSpot(std::uint32_t key)
    {
        test::Random random(key + 100);
        Light light = test::spot(random.inBox({-20, 20, -20}, {20, 30, 20}), {0.1, -1, 0.05}, 0.5);
        light.key = key;
        return lights.emplace_back(light);
    }
    const Plan& plan(Planner& planner)
    {
        frame.lights = lights;
        return planner.plan(frame);
    }
    std::map<std::uint32_t, Have> have(Planner& planner)
    {
        std::map<std::uint32_t, Have> found;
        for (const View& view : plan(planner).views) {
            Have& one = found[lights[view.light].key];
            one.maps.push_back(view.place.map);
            one.hold.push_back(view.contents.makes);
            one.redrawn = one.redrawn || view.contents.redraw;
        }
        return found;
    }
    ObjectSet set;
    std::vector<Light> lights;
    Frame frame;
};

TEST(LightMaps, ALightThatComesOrGoesLeavesTheOthersAlone)
{
    for (const Partition partition : {Partition::single, Partition::cascades}) {
        World world;
        ShadowOptions options{.technique = kPlainTechnique};
        options.technique.partition = partition;
        options.technique.motion = Motion::snap;
        options.map_size = 64;
        options.keep_still = KeepStill::always;
        Planner planner(options);
        test::Random random(17);
        for (std::uint32_t key = 0; key < 5; ++key)
            world.addSpot(key);
        std::map<std::uint32_t, Have> before = world.have(planner);
        std::uint32_t next_key = 5;
        int compared = 0;
        for (int frame = 0; frame < 500; ++frame) {
            const std::uint32_t any = random.below(static_cast<std::uint32_t>(world.lights.size()));
            if (world.lights.size() > 2 && random.below(2) == 0)
                world.lights.erase(world.lights.begin() + any);
            else if (world.lights.size() < 10)
                world.addSpot(next_key++);
            std::swap(world.lights[0], world.lights[any % world.lights.size()]);
            const std::map<std::uint32_t, Have> now = world.have(planner);
            for (const auto& [key, have] : now) {
                if (!before.contains(key)) {
                    EXPECT_TRUE(have.redrawn);
                    continue;
                }
                ++compared;
                EXPECT_FALSE(have.redrawn);
                EXPECT_EQ(have.maps, before[key].maps);
                EXPECT_EQ(have.hold, before[key].hold);
            }
            before = now;
        }
        EXPECT_GT(compared, 1500);
    }
}

/// Frame 1 sees A, B and C, frame 2 only A, frame 3 A and C.
TEST(LightMaps, ALightThatComesBackIntoSightHasItsMap)
{
    World world;
    ShadowOptions options{.technique = kPlainTechnique};
    options.technique.filter = Filter::lvsm;
    options.technique.motion = Motion::snap;
    options.map_size = 64;
    Planner planner(options);
    for (std::uint32_t key = 0; key < 3; ++key)
        world.addSpot(key);
    const Camera all = world.frame.camera;
    std::map<std::uint32_t, Have> first = world.have(planner);
    ASSERT_EQ(first.size(), 3U);
    // Light 1 is moved out of sight for good, light 2 for one frame.
    const Light third = world.lights[2];
    world.lights[1].position_ws.x += 900.0;
    world.lights[2].position_ws.x += 900.0;
    EXPECT_EQ(world.have(planner).size(), 1U);
    world.lights[2] = third;
    world.frame.camera = all;
    const std::map<std::uint32_t, Have> last = world.have(planner);
    ASSERT_EQ(last.size(), 2U);
    for (const std::uint32_t key : {0U, 2U}) {
        EXPECT_EQ(last.at(key).maps, first[key].maps);
        EXPECT_EQ(last.at(key).hold, first[key].hold); // so it is not drawn, and nobody drew over it
        EXPECT_FALSE(last.at(key).redrawn);
    }
}

TEST(LightMaps, NumbersOfTwoPlannersNeverMeet)
{
    World world;
    world.addSpot(0);
    Planner one(ShadowOptions{.map_size = 64});
    Planner two(ShadowOptions{.map_size = 64});
    EXPECT_NE(world.plan(one).planner, world.plan(two).planner);
    std::set<ContentNumber> numbers;
    for (std::uint32_t i = 0; i < 100; ++i) {
        world.set.touch(world.set.idAt(1 + i % 60));
        world.lights[0].position_ws.x += 0.01;
        EXPECT_TRUE(numbers.insert(world.plan(one).views.at(0).contents.makes).second);
        EXPECT_TRUE(numbers.insert(world.plan(two).views.at(0).contents.makes).second);
    }
}

TEST(LightMaps, WhatIsLostIsDrawnWhole)
{
    World world;
    world.addSpot(0);
    world.addSpot(1);
    Planner planner(ShadowOptions{.map_size = 64});
    (void)world.plan(planner);
    const MapId lost = world.plan(planner).views.at(1).place.map;
    planner.lost(lost);
    planner.lost({lost.index, lost.generation + 1}); // of another time
    planner.lost({1000, 0});
    planner.lost({});
    const Plan& plan = world.plan(planner);
    EXPECT_FALSE(plan.views[0].contents.redraw);
    EXPECT_TRUE(plan.views[1].contents.redraw);
    EXPECT_EQ(plan.views[1].contents.presumes, 0U);
    EXPECT_FALSE(world.plan(planner).views[1].contents.redraw);
}

TEST(LightMaps, OptionsMayDifferFromLightToLight)
{
    World world;
    for (std::uint32_t key = 0; key < 4; ++key)
        world.addSpot(key);
    world.lights[1].options = 1;
    world.lights[2].options = 2;
    world.lights[3].map_size = 64;
    std::vector<ShadowOptions> options(2, ShadowOptions{.technique = kPlainTechnique});
    options[0].map_size = 128;
    options[1].map_size = 32;
    options[1].technique.filter = Filter::msm;
    Planner planner(options);
    const Plan& plan = world.plan(planner);
    ASSERT_EQ(plan.pages.size(), 2U);
    EXPECT_EQ(plan.pages[0].width, 128U);
    EXPECT_EQ(plan.pages[0].layers, 2U);
    EXPECT_EQ(plan.pages[1].width, 32U);
    EXPECT_EQ(plan.pages[1].layers, 1U);
    ASSERT_EQ(plan.views.size(), 3U);
    EXPECT_EQ(plan.views[0].place.tile.width, 128U);
    EXPECT_EQ(plan.views[1].place.tile.width, 32U);
    EXPECT_EQ(plan.views[2].place.tile.width, 64U);
    EXPECT_EQ(plan.lights[1].options, 1U);
    EXPECT_FALSE(plan.views[1].projection.clamp_near); // a filterable map's
    EXPECT_EQ(plan.lights[2].outcome.kind, OutcomeKind::refused);
    EXPECT_NE(plan.lights[2].outcome.reason.find("Light::options"), std::string_view::npos);
}

/// 64 lights of 6 cascades each: as whole pages, and as 16 to a page.
TEST(LightMaps, Of64LightsHave384Views)
{
    for (const std::uint32_t map_size : {256U, 64U}) {
        World world;
        for (std::uint32_t key = 0; key < 64; ++key) {
            world.lights.push_back(test::sun(test::Random(key).inBox({-1, -1, -1}, {1, -0.5, 1})));
            world.lights.back().key = key;
            world.lights.back().map_size = map_size;
        }
        world.set.add({{-400, -1, -400}, {400, -0.6, 400}}); // so that each cascade sees something
        ShadowOptions options{.technique = kPlainTechnique};
        options.map_size = 256;
        options.max_layers = 384;
        options.technique.partition = Partition::cascades;
        options.technique.motion = Motion::snap;
        options.cascades.count = 6;
        options.cascades.ends_m = {25.0, 32.0, 40.0, 60.0, 120.0};
        Planner planner(options);
        const Plan& plan = world.plan(planner);
        EXPECT_EQ(plan.views.size(), 384U);
        EXPECT_EQ(plan.pages[0].layers, map_size == 256 ? 384U : 24U);
        EXPECT_EQ(plan.map_count, 384U);
        for (const LightPlan& light : plan.lights)
            if (light.view_count == 6) {
                EXPECT_EQ(viewsTogether(plan, light.first_view, true), 6U);
            }
        (void)world.plan(planner);
        const std::uint64_t before = test::heapAllocations();
        for (const View& view : world.plan(planner).views)
            EXPECT_FALSE(view.contents.redraw);
        EXPECT_EQ(test::heapAllocations(), before);
        world.lights.erase(world.lights.begin() + 20);
        for (const View& view : world.plan(planner).views)
            EXPECT_FALSE(view.contents.redraw);
    }
}

} // namespace
} // namespace gnomon
