// SPDX-License-Identifier: Apache-2.0
// Cascades that take turns each by itself: along walks of the camera what waits still shows all that is seen, the bound
// holds, and nobody waits for longer than is said.
#include "allocation_count.h"
#include "avenue.h"
#include "cascade_turns.h"
#include "draughtsman.h"
#include "fit_stage.h"
#include "plan_judge.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <string>

namespace gnomon {
namespace {

using test::Avenue;
using test::drawnTexels;
using test::longestWait;
using test::Random;

constexpr std::uint64_t kMap = 64 * 64;

/// The street under a sun, which every cascade has something of.
struct Street : Avenue {
    explicit Street(std::uint64_t budget, Motion motion = Motion::free) : Avenue(0, Partition::cascades, motion)
    {
        lights = {test::sun({0.3, -1.0, 0.2})};
        frame.lights = lights;
        options.cascades.room = 0.1;
        options.draw_budget_texels = budget;
    }
    /// The camera walks, and nobody else does.
    void step(int i)
    {
        const double way_m = 0.05 * i;
        frame.camera = test::perspectiveCamera({0.01 * i, 2, 42 - way_m}, {0.02 * i, 1, -way_m}, 0.8);
        ++frame.index;
    }
};

int waitingMaps(const Plan& plan)
{
    return static_cast<int>(
        std::ranges::count_if(plan.views, [](const View& view) { return view.contents.waited > 0; }));
}

/// By a step of a walk, a thousandth of the scene's size long, and turned a little.
void move(Camera& camera, double size_m, const glm::dvec3& way, const glm::dvec3& axis)
{
    constexpr double kTurn_rad = 0.003;
    const glm::dvec3 step_ws = way * (0.001 * size_m);
    const glm::dmat4 here = glm::translate(glm::dmat4(1.0), camera.eye_ws);
    camera.clip_from_world *= here * glm::rotate(glm::dmat4(1.0), kTurn_rad, axis) *
                              glm::translate(glm::dmat4(1.0), -camera.eye_ws - step_ws);
    camera.eye_ws += step_ws;
}

struct WalkOf {
    int waits = 0;
    int drawn = 0; // cascades that a turn of their own was due to
    test::Tally tally;
};

/// Larger than what is shown of it, so that maps that hold still move over it; the camera has a far plane in it.
test::RandomScene meadow(std::uint64_t seed, const Technique& technique)
{
    test::RandomScene scene;
    Random random(seed);
    for (int x = -200; x < 200; x += 20) {
        for (int z = -200; z < 200; z += 20) {
            scene.set.add({{x, -0.5, z}, {x + 20, 0, z + 20}});
            const glm::dvec3 half{random.uniform(0.2, 2.0), random.uniform(0.5, 6.0), random.uniform(0.2, 2.0)};
            scene.set.add(test::boxAt({x + random.uniform(0, 20), half.y, z + random.uniform(0, 20)}, half));
        }
    }
    scene.camera = test::perspectiveCamera({3, 1.7, 5}, {30 * random.uniform(), 1, -20}, 1.0, 1.6, 0.1, 110.0);
    scene.lights = {test::sun({random.uniform(-1, 1), -1.0, random.uniform(-1, 1)})};
    scene.options.technique = technique;
    scene.options.map_size = 256;
    scene.options.max_distance_m = seed % 4 == 0 ? 60.0 : 0.0;
    scene.size_m = 200.0;
    return scene;
}

/// Walks through random scenes and judges every plan by points and rays: what is seen is in the map of its cascade,
/// inside the border, and all that casts on it is drawn there.
void walkRandomly(const Technique& technique, std::uint64_t seeds, WalkOf& walk)
{
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        test::RandomScene scene = seed % 2 == 0 ? meadow(seed, technique) : test::randomScene(seed, technique);
        scene.options.draw_budget_texels = 1;
        scene.options.longest_wait = 6;
        scene.options.cascades.room = 0.05 + 0.05 * static_cast<double>(seed % 3);
        Planner planner(scene.options);
        Random random(seed + 5000000);
        const glm::dvec3 way = random.direction();
        const glm::dvec3 axis = random.direction();
        for (int step = 0; step < 12; ++step) {
            const Plan& plan = planner.plan(scene.frame());
            ASSERT_LE(longestWait(plan), 6U);
            ASSERT_NO_FATAL_FAILURE(test::judge(scene, plan, random, walk.tally));
            walk.waits += waitingMaps(plan);
            walk.drawn += static_cast<int>(plan.views.size()) - waitingMaps(plan);
            move(scene.camera, scene.size_m, way, axis);
        }
    }
}

/// A map does not cover receivers that lie nearer or farther along the light than those of before.
TEST(ViewGround, CoversTheDepthsOfItsReceiversAlone)
{
    const test::FitStage made(test::levelGround(0.2));
    ASSERT_TRUE(made.found);
    ViewGround ground;
    ground.note(made.region, made.space);
    EXPECT_TRUE(ground.covers(made.region, made.view.pad_m));
    ground.far_m -= 1.0;
    EXPECT_FALSE(ground.covers(made.region, made.view.pad_m));
    ground.far_m += 1.0;
    ground.near_m += 1.0;
    EXPECT_FALSE(ground.covers(made.region, made.view.pad_m));
}

TEST(CascadeTurns, ShowAllThatIsSeen)
{
    for (const Motion motion : {Motion::free, Motion::snap}) {
        for (const auto& [fit, filter] : {std::pair{Fit::uniform, Filter::pcf},
                                          {Fit::lispsm, Filter::hard},
                                          {Fit::tsm, Filter::hard},
                                          {Fit::automatic, Filter::pcss},
                                          {Fit::uniform, Filter::vsm}}) {
            const Technique technique{.partition = Partition::cascades, .fit = fit, .filter = filter, .motion = motion};
            SCOPED_TRACE(std::string(nameOf(fit)) + " " + std::string(nameOf(filter)) + " " +
                         std::string(nameOf(motion)));
            WalkOf walk;
            ASSERT_NO_FATAL_FAILURE(walkRandomly(technique, 60, walk));
            EXPECT_GT(walk.waits, 500);
            EXPECT_GT(walk.tally.seen, 3000);
            EXPECT_GT(walk.tally.blocked, 1500);
        }
    }
}

TEST(CascadeTurns, KeepToTheBudgetAndToTheLongestWait)
{
    for (const Motion motion : {Motion::free, Motion::snap}) {
        for (const KeepStill keep : {KeepStill::never, KeepStill::always}) {
            SCOPED_TRACE(std::string(nameOf(motion)) + " " + std::string(nameOf(keep)));
            const std::uint64_t budget = (keep == KeepStill::always ? 2 : 1) * 2 * kMap;
            Street street(budget, motion);
            street.options.keep_still = keep;
            street.options.longest_wait = 5;
            street.options.max_distance_m = motion == Motion::snap ? 30.0 : 0.0; // else its maps hold
            Planner planner(street.options);
            test::Draughtsman draughtsman;
            int over = 0;
            std::uint32_t longest = 0;
            std::set<std::uint32_t> waited; // which maps
            for (int step = 0; step < 80; ++step) {
                street.step(step);
                const Plan& plan = planner.plan(street.frame);
                ASSERT_NO_FATAL_FAILURE(draughtsman.follow(plan, street.set));
                ASSERT_EQ(plan.lights[0].waited, plan.pages[0].longest_wait);
                ASSERT_EQ(static_cast<int>(plan.pages[0].waiting_maps), waitingMaps(plan));
                ASSERT_EQ(plan.pages[0].waiting_lights, waitingMaps(plan) > 0 ? 1U : 0U);
                for (const View& view : plan.views) {
                    ASSERT_TRUE(view.contents.waited == 0 || std::isfinite(view.serves.slice.begin_m))
                        << "the first never waits";
                    longest = std::max(longest, view.contents.waited);
                    ASSERT_TRUE(view.contents.waited == 0 ||
                                (!view.contents.redraw && view.contents.presumes == view.contents.makes));
                    ASSERT_EQ(view.serves.slice.axis, plan.views.front().serves.slice.axis)
                        << "all serve slices of one camera";
                    if (view.contents.waited > 0) {
                        waited.insert(view.place.map.index);
                    }
                }
                over += step > 0 && drawnTexels(plan) > budget ? 1 : 0;
            }
            EXPECT_LE(over, 4) << "frames in which maps do not show what comes into sight";
            EXPECT_GE(longest, motion == Motion::snap ? 1U : 2U);
            EXPECT_LE(longest, 5U);
            EXPECT_GE(waited.size(), motion == Motion::snap ? 2U : 3U);
        }
    }
}

// A step that leads out of the room is drawn at once, whatever the bound is.
TEST(CascadeTurns, AreNotForWhatTheMapDoesNotShow)
{
    Street street(1);
    street.options.longest_wait = 64;
    Planner planner(street.options);
    const auto look = [&](double x, double z) -> const Plan& {
        street.frame.camera = test::perspectiveCamera({0, 2, 0}, {x, 1, z}, 0.8);
        return planner.plan(street.frame);
    };
    for (int step = 0; step < 3; ++step) {
        (void)look(0.1 * step, -40);
    }
    EXPECT_EQ(waitingMaps(look(0.3, -40)), 3);
    const Plan& plan = look(0, 40);
    EXPECT_EQ(waitingMaps(plan), 0);
    EXPECT_EQ(drawnTexels(plan), plan.views.size() * kMap);
    EXPECT_GE(plan.views.size(), 3U);
}

TEST(CascadeTurns, AreOverSoonWhereNothingMoves)
{
    Street street(kMap);
    Planner planner(street.options);
    test::Draughtsman draughtsman;
    for (int step = 0; step < 20; ++step) {
        street.step(step);
        ASSERT_NO_FATAL_FAILURE(draughtsman.follow(planner.plan(street.frame), street.set));
    }
    for (std::uint32_t rest = 0; rest <= street.options.longest_wait; ++rest) {
        ASSERT_NO_FATAL_FAILURE(draughtsman.follow(planner.plan(street.frame), street.set));
    }
    const Plan& plan = planner.plan(street.frame);
    EXPECT_EQ(longestWait(plan), 0U);
    EXPECT_EQ(drawnTexels(plan), 0U);
    ASSERT_NO_FATAL_FAILURE(draughtsman.follow(plan, street.set));
    ASSERT_NO_FATAL_FAILURE(draughtsman.check(plan, street.set));
}

// People who walk have their old shadows for a while, and a sun that goes on too; a lamp that moves is drawn at once.
TEST(CascadeTurns, AreOfCastersAndSunsThatMoveAndNotOfLampsThatDo)
{
    Street street(1);
    street.lights.push_back(test::spot({0, 8, 20}, {0, -1, -1}, 0.9, 60.0));
    street.lights[1].key = 1;
    street.frame.lights = street.lights;
    Planner planner(street.options);
    const auto settle = [&] {
        for (int i = 0; i < 12; ++i) {
            (void)planner.plan(street.frame);
        }
        ASSERT_EQ(longestWait(planner.plan(street.frame)), 0U);
    };
    settle();
    for (int i = 0; i < 24; ++i) {
        street.set.update(street.walkers[static_cast<std::size_t>(i)], Avenue::walkerAt(i, 7));
    }
    const Plan walked = planner.plan(street.frame);
    EXPECT_GT(walked.lights[0].waited, 0U);
    EXPECT_GT(walked.lights[1].waited, 0U);
    settle();
    street.lights[0] = test::sun({0.31, -1.0, 0.2});
    const Plan risen = planner.plan(street.frame);
    EXPECT_GT(risen.lights[0].waited, 0U);
    settle();
    street.lights[1].position_ws.x += 0.01;
    const Plan moved = planner.plan(street.frame);
    EXPECT_EQ(moved.lights[1].waited, 0U);
    EXPECT_GT(drawnTexels(moved, moved.lights[1]), 0U);
}

TEST(CascadeTurns, AreForMapsThatThereAre)
{
    for (const int what : {0, 1, 2, 3}) {
        Street street(1);
        Planner planner(street.options);
        for (int step = 0; step < 6; ++step) {
            street.step(step);
            (void)planner.plan(street.frame);
        }
        street.step(6);
        const Plan before = planner.plan(street.frame);
        ASSERT_GE(waitingMaps(before), 2);
        const auto waits =
            std::ranges::find_if(before.views, [](const View& view) { return view.contents.waited > 0; });
        street.step(7);
        if (what == 1) {
            street.frame.cut = true;
        } else if (what == 2) {
            planner.reset();
        } else if (what == 3) {
            planner.lost(waits->place.map);
        }
        const Plan& plan = planner.plan(street.frame);
        EXPECT_EQ(waitingMaps(plan) > 0, what == 0 || what == 3) << what;
        const auto same =
            std::ranges::find(plan.views, waits->place.map, [](const View& view) { return view.place.map; });
        ASSERT_NE(same, plan.views.end());
        EXPECT_TRUE(what != 3 || (same->contents.waited == 0 && same->contents.redraw));
    }
}

// Room is paid for with texels, and without a bound there is none.
TEST(CascadeTurns, TakeRoomOfAllMapsButTheFirst)
{
    Street none(0);
    Street some(std::uint64_t{1} << 35U);
    Planner without(none.options);
    Planner with(some.options);
    none.options.cascades.room = 0.0;
    Planner plain(none.options);
    const Plan& wide = with.plan(some.frame);
    const Plan& exact = without.plan(none.frame);
    ASSERT_EQ(test::bytesOf(exact), test::bytesOf(plain.plan(none.frame)));
    ASSERT_EQ(wide.views.size(), 4U);
    EXPECT_EQ(wide.views[0].projection.clip_from_world, exact.views[0].projection.clip_from_world);
    for (std::size_t i = 1; i < 4; ++i) {
        const double times = wide.views[i].projection.texel_m / exact.views[i].projection.texel_m;
        EXPECT_GT(times, 1.0) << i;
        EXPECT_LT(times, 1.25) << i;
        EXPECT_EQ(wide.views[i].serves.slice.begin_m, exact.views[i].serves.slice.begin_m);
        EXPECT_EQ(wide.views[i].serves.slice.end_m, exact.views[i].serves.slice.end_m);
    }
}

TEST(CascadeTurns, AreTheSameAgainAndTakeNothingFromTheHeap)
{
    Street street(kMap);
    Planner one(street.options);
    Planner other(street.options);
    const auto lap = [&](auto&& look) {
        for (int step = 0; step < 30; ++step) {
            street.step(step);
            street.frame.cut = step == 0;
            look();
        }
    };
    lap([&] { ASSERT_EQ(toJson(one.plan(street.frame)), toJson(other.plan(street.frame))); });
    for (int i = 0; i < 6; ++i) {
        lap([&] { (void)one.plan(street.frame); });
    }
    const std::uint64_t before = test::heapAllocations();
    lap([&] { (void)one.plan(street.frame); });
    EXPECT_EQ(test::heapAllocations(), before);
}

TEST(CascadeTurns, AreRefusedWhereNothingWaits)
{
    const auto refused = [](ShadowOptions options) {
        options.technique.partition = Partition::cascades;
        options.technique.filter = Filter::pcf;
        options.draw_budget_texels = 1024;
        options.cascades.room = 0.1;
        return !resolve(options);
    };
    EXPECT_FALSE(refused({}));
    EXPECT_FALSE(refused({.technique = {.motion = Motion::snap}}));
    EXPECT_TRUE(refused({.technique = {.soften = Soften::converge}}));
    EXPECT_TRUE(refused({.technique = {.motion = Motion::step_jump}}));
    EXPECT_FALSE(resolve({.cascades = {.room = 0.51}}));
    EXPECT_FALSE(resolve({.cascades = {.room = -0.01}}));
}

} // namespace
} // namespace gnomon
