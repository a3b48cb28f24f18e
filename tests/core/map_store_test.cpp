// SPDX-License-Identifier: Apache-2.0
// A host that draws as the plan says has the same maps as one that draws all of them in every frame.
#include "draughtsman.h"
#include "store/map_contents.h"
#include "worlds.h"

#include <gnomon/planner.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace gnomon {
namespace {

using test::Random;

/// A world that anything may happen to.
struct Turmoil {
    explicit Turmoil(std::uint64_t seed) : random(seed)
    {
        set.add({{-30, -0.5, -30}, {30, 0, 30}});
        for (int i = 0; i < 25; ++i)
            add(i % 5 == 0);
        lights = {test::sun({0.4, -1, 0.3}), test::spot({0, 30, 0}, {0.1, -1, 0}, 0.6)};
        lights[1].key = 1;
        for (ShadowOptions& one : options)
            choose(one);
        frame.objects = &set;
    }
    void choose(ShadowOptions& one)
    {
        one.map_size = random.below(3) == 0 ? 36 : 16;
        one.max_layers = random.below(4) == 0 ? 3 : 12;
        one.border_texels = 1.0;
        one.technique.motion = static_cast<Motion>(random.below(6));
        one.keep_still = static_cast<KeepStill>(random.below(3));
        if (random.below(3) == 0)
            one.format = MapFormat::rg16; // of pcf two maps a texel, of vsm two moments
        one.technique.filter = random.below(4) == 0 ? Filter::vsm : Filter::pcf;
        if (random.below(3) == 0) {
            one.technique.partition = Partition::cascades;
            one.cascades.count = 2;
        }
        one.steps.by = random.below(2) == 0 ? StepBy::angle : StepBy::time;
    }
    void add(bool dynamic)
    {
        const glm::dvec3 centre = random.inBox({-28, 0.5, -28}, {28, 6, 28});
        const glm::dvec3 half = random.inBox(glm::dvec3(0.1), glm::dvec3(2.0));
        objects.push_back(set.add(test::boxAt(centre, half), {random.below(5) != 0, true, dynamic}));
    }
    void happen()
    {
        for (const ObjectId object : objects)
            if (set.flags(object).dynamic && random.below(2) == 0) {
                const Aabb& box = set.bounds(object);
                const glm::vec3 by(random.inBox(glm::dvec3(-0.6), glm::dvec3(0.6)));
                const float far = random.below(20) == 0 ? 70.0F : 0.0F; // out of all maps, and back some time
                const glm::vec3 away(box.min.x > 40.0F ? -70.0F : far, 0.0F, 0.0F);
                set.update(object, {box.min + by + away, box.max + by + away});
            }
        const std::uint32_t what = random.below(60);
        const std::size_t any = random.below(static_cast<std::uint32_t>(objects.size()));
        if (what == 0)
            set.touch(objects[any]);
        if (what == 1)
            add(random.below(2) == 0);
        if (what == 2 && objects.size() > 5) {
            set.remove(objects[any]);
            objects.erase(objects.begin() + static_cast<std::ptrdiff_t>(any));
        }
        if (what == 3 || what == 4)
            eye += random.inBox(glm::dvec3(-1.0), glm::dvec3(1.0));
        if (what == 5)
            lights[1].casts_shadow = !lights[1].casts_shadow;
        if (what == 6 || what >= 55)
            changeLights();
        if (what == 7)
            speed = random.below(3) == 0 ? 0.0 : random.uniform(-0.004, 0.004);
        if (what == 8 && random.below(4) == 0)
            hour += 0.3;
        hour += speed;
        lights[0].direction_ws = glm::normalize(glm::dvec3(std::sin(hour), -1.0, 0.4 * std::cos(hour)));
        frame.time_s += random.below(30) == 0 ? 0.0 : 0.1;
        frame.camera = test::perspectiveCamera(eye, {0, 0, 0}, 1.0, 1.6, 0.1, 200.0);
        frame.lights = lights;
    }

    void changeLights()
    {
        const std::uint32_t which = 1 + random.below(static_cast<std::uint32_t>(lights.size() - 1));
        const std::uint32_t how = random.below(6);
        if (how == 0 && lights.size() > 2)
            lights.erase(lights.begin() + which);
        else if (how == 1)
            lights[which].map_size = random.below(2) == 0 ? 18 : 0;
        else if (how == 2)
            lights[which].options = random.below(3); // 2: there is no such one
        else if (how == 3)
            std::swap(lights[which], lights[1]); // their order says nothing
        else if (lights.size() < 6)
            addLight();
    }
    void addLight()
    {
        const glm::dvec3 place = random.inBox({-15, 20, -15}, {15, 40, 15});
        Light light = random.below(4) == 0 ? test::sun(random.inBox({-1, -1, -1}, {1, -0.3, 1}))
                                           : test::spot(place, {0.1, -1, 0}, random.uniform(0.2, 0.8));
        light.key = random.below(8); // some have the same
        light.options = random.below(2);
        light.map_size = random.below(3) == 0 ? 18 : 0;
        lights.insert(lights.begin() + 1 + random.below(static_cast<std::uint32_t>(lights.size())), light);
    }

    Random random;
    ObjectSet set;
    std::vector<ObjectId> objects;
    std::vector<Light> lights;
    glm::dvec3 eye{20, 15, 25};
    double hour = 0.3;
    double speed = 0.002;
    Frame frame;
    std::array<ShadowOptions, 2> options{ShadowOptions{.technique = kPlainTechnique},
                                         ShadowOptions{.technique = kPlainTechnique}};
};

/// In 37,500 frames. A second draughtsman misses one frame in ten, and mends what it finds.
TEST(MapStore, MapsAreAsIfDrawnAnewInEveryFrame)
{
    int restored = 0;
    int reused = 0;
    int pairs = 0;
    int shared_pages = 0;
    std::uint64_t mended = 0;
    for (std::uint64_t seed = 1; seed <= 150; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Turmoil world(seed);
        Planner planner(world.options);
        test::Draughtsman strict;
        test::Draughtsman mending(false);
        for (int frame = 0; frame < 250; ++frame) {
            SCOPED_TRACE("frame " + std::to_string(frame));
            world.happen();
            if (frame == 120) {
                planner.reset();
                strict = test::Draughtsman();
            }
            const Plan& plan = planner.plan(world.frame);
            ASSERT_NO_FATAL_FAILURE(test::expectOrder(plan, world.set));
            ASSERT_NO_FATAL_FAILURE(strict.follow(plan, world.set));
            ASSERT_NO_FATAL_FAILURE(strict.check(plan, world.set));
            if (world.random.below(10) != 0) {
                ASSERT_NO_FATAL_FAILURE(mending.follow(plan, world.set));
                ASSERT_NO_FATAL_FAILURE(mending.check(plan, world.set));
            }
            for (const View& view : plan.views) {
                restored +=
                    view.contents.redraw && view.contents.kept_layer != kNoIndex && !view.contents.redraw_kept ? 1 : 0;
                reused += view.contents.redraw ? 0 : 1;
                pairs += view.serves.sun == SunPosition::later ? 1 : 0;
                shared_pages += view.place.tile.x > 0 ? 1 : 0;
            }
            if (!plan.views.empty() && world.random.below(60) == 0) {
                const View& view = plan.views[world.random.below(static_cast<std::uint32_t>(plan.views.size()))];
                const bool kept = view.contents.kept_map && world.random.below(2) == 0;
                strict.lose(view, kept);
                planner.lost(kept ? view.contents.kept_map : view.place.map);
            }
        }
        mended += mending.mended;
        if (HasFailure())
            return;
    }
    EXPECT_GT(restored, 5000);
    EXPECT_GT(reused, 5000);
    EXPECT_GT(pairs, 5000);
    EXPECT_GT(shared_pages, 1000);
    EXPECT_GT(mended, 1000U);
}

/// Every point of a box, where it was and where it is, is drawn within `dirty`, a texel away from its edge at least;
/// but at the tile's edge.
TEST(Dirty, CoversWhereAMoverWasAndIs)
{
    Random random(21);
    int inside = 0;
    for (int round = 0; round < 3000; ++round) {
        View view;
        view.place.tile = {0, 0, 0, 64, 48};
        const bool perspective = round % 2 == 1;
        const glm::dvec3 eye = random.inBox(glm::dvec3(-20), glm::dvec3(20));
        view.projection.clip_from_world = (perspective ? test::perspectiveCamera(eye, glm::dvec3(0.0), 1.0)
                                                       : test::orthographicCamera(eye, glm::dvec3(0.0), 15.0))
                                              .clip_from_world;
        const glm::dvec3 half = random.inBox(glm::dvec3(0.0), glm::dvec3(3.0));
        const glm::dvec3 centre = round % 8 == 1 ? eye * 0.95 : random.inBox(glm::dvec3(-25), glm::dvec3(25));
        const Aabb box = test::boxAt(centre, half); // each eighth is around the eye, or close before it
        const TexelRect rect = texelsOf(view, box);
        ASSERT_LE(rect.x + rect.width, 64U);
        ASSERT_LE(rect.y + rect.height, 48U);
        for (int sample = 0; sample < 20; ++sample) {
            const glm::dvec3 p = random.inBox(glm::dvec3(box.min), glm::dvec3(box.max));
            const glm::dvec4 c = view.projection.clip_from_world * glm::dvec4(p, 1.0);
            if (c.w <= 0.0 || std::abs(c.x) >= c.w || std::abs(c.y) >= c.w)
                continue;
            ++inside;
            const glm::dvec2 at = (glm::dvec2(c) / c.w * 0.5 + 0.5) * glm::dvec2(64.0, 48.0);
            ASSERT_FALSE(rect.empty());
            ASSERT_LE(rect.x, std::max(at.x - 1.0, 0.0));
            ASSERT_LE(rect.y, std::max(at.y - 1.0, 0.0));
            ASSERT_GE(rect.x + rect.width, std::min(at.x + 1.0, 64.0));
            ASSERT_GE(rect.y + rect.height, std::min(at.y + 1.0, 48.0));
        }
    }
    EXPECT_GT(inside, 10000);
    EXPECT_EQ(merge({1, 2, 3, 4}, {}).width, 3U);
    const TexelRect both = merge({1, 2, 3, 4}, {10, 1, 2, 2});
    EXPECT_EQ(both.x, 1U);
    EXPECT_EQ(both.y, 1U);
    EXPECT_EQ(both.width, 11U);
    EXPECT_EQ(both.height, 5U);
}

} // namespace
} // namespace gnomon
