// SPDX-License-Identifier: Apache-2.0
// Maps drawn by turns: who never waits, what is left when all had theirs, and what a bound must not change.
#include "allocation_count.h"
#include "avenue.h"
#include "draughtsman.h"
#include "plan_judge.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace gnomon {
namespace {

using test::Avenue;
using test::drawnTexels;
using test::longestWait;
using test::Random;

TEST(Turns, AreNobodysWithoutABound)
{
    for (const Partition partition : {Partition::cube, Partition::multi}) {
        for (const Motion motion : {Motion::free, Motion::snap}) {
            Avenue avenue(24, partition, motion);
            avenue.options.keep_still = KeepStill::always;
            Planner none(avenue.options);
            avenue.options.draw_budget_texels = std::uint64_t{1} << 35U;
            Planner endless(avenue.options);
            for (int step = 0; step < 60; ++step) {
                avenue.walk(step);
                const Plan& a = none.plan(avenue.frame);
                const Plan& b = endless.plan(avenue.frame);
                ASSERT_EQ(test::bytesOf(a), test::bytesOf(b)) << step;
                ASSERT_EQ(toJson(a), toJson(b)) << step;
            }
        }
    }
}

/// An avenue in the middle of a walk on which lights wait.
struct Waiting {
    Avenue avenue{24};
    Planner planner{[&] {
        avenue.options.draw_budget_texels = 6 * 64 * 64 * 3;
        return avenue.options;
    }()};
    int step = 0;

    Waiting()
    {
        for (; step < 10; ++step) {
            avenue.walk(step);
            (void)planner.plan(avenue.frame);
        }
    }
    const Plan& next()
    {
        avenue.walk(step++);
        return planner.plan(avenue.frame);
    }
};

TEST(Turns, AreForMapsThatThereAre)
{
    Waiting plain;
    ASSERT_GT(plain.next().pages[0].longest_wait, 0U);
    {
        Waiting cut;
        cut.avenue.frame.cut = true;
        EXPECT_EQ(longestWait(cut.next()), 0U);
    }
    {
        Waiting reset;
        reset.planner.reset();
        EXPECT_EQ(longestWait(reset.next()), 0U);
    }
    {
        Waiting other; // objects
        Avenue elsewhere(24);
        elsewhere.walk(other.step);
        other.avenue.frame.objects = &elsewhere.set;
        EXPECT_EQ(longestWait(other.planner.plan(other.avenue.frame)), 0U);
    }
    {
        Waiting lost;
        const Plan plan = lost.next();
        const auto waits = std::ranges::find_if(plan.lights, [](const LightPlan& light) { return light.waited > 0; });
        ASSERT_NE(waits, plan.lights.end());
        lost.planner.lost(plan.views[waits->first_view].place.map);
        const auto index = static_cast<std::size_t>(waits - plan.lights.begin());
        const Plan& after = lost.next();
        EXPECT_EQ(after.lights[index].waited, 0U);
        EXPECT_GT(drawnTexels(after, after.lights[index]), 0U);
        EXPECT_GT(longestWait(after), 0U) << "the others go on";
    }
    {
        Waiting sized;
        for (Light& light : sized.avenue.lights) {
            light.map_size = 32;
        }
        EXPECT_EQ(longestWait(sized.next()), 0U);
    }
    {
        Waiting spots;
        for (Light& light : spots.avenue.lights) {
            light.casts_shadow = false;
        }
        EXPECT_EQ(longestWait(spots.next()), 0U);
        for (Light& light : spots.avenue.lights) {
            light.casts_shadow = true;
        }
        EXPECT_EQ(longestWait(spots.next()), 0U) << "they have maps again";
        EXPECT_GT(longestWait(spots.next()), 0U);
    }
}

TEST(Turns, AreNotForMeansOverFrames)
{
    Avenue avenue(8);
    avenue.options.technique.soften = Soften::converge;
    avenue.options.draw_budget_texels = 1;
    Planner planner(avenue.options);
    for (int step = 0; step < 20; ++step) {
        avenue.walk(step);
        ASSERT_EQ(longestWait(planner.plan(avenue.frame)), 0U);
    }
}

// A light that waits keeps the slices of the camera that it was drawn for, along that camera's axis.
TEST(Turns, AreOfCascadesTooAndOfACameraThatTurns)
{
    Avenue avenue(1);
    avenue.lights = {test::sun({0.3, -1.0, 0.2}), test::sun({-0.3, -1.0, 0.4})};
    avenue.lights[1].key = 1;
    avenue.frame.lights = avenue.lights;
    avenue.options.technique.partition = Partition::cascades;
    avenue.options.draw_budget_texels = 1;
    Planner planner(avenue.options);
    for (int step = 0; step < 8; ++step) {
        avenue.walk(step);
        const Plan& plan = planner.plan(avenue.frame);
        EXPECT_EQ(plan.pages[0].waiting_lights, step == 0 ? 0U : 1U) << step;
    }
    for (int step = 0; step < 8; ++step) {
        avenue.frame.camera = test::perspectiveCamera({0, 2, 42}, {1 + step, 1, 0}, 0.8);
        const Plan before = planner.plan(avenue.frame);
        avenue.frame.camera = test::perspectiveCamera({0, 2, 42}, {1.5 + step, 1, 0}, 0.8);
        const Plan& plan = planner.plan(avenue.frame);
        ASSERT_EQ(plan.pages[0].waiting_lights, 1U);
        const LightPlan& waits = plan.lights[plan.lights[0].waited > 0 ? 0 : 1];
        const LightPlan& waited = before.lights[plan.lights[0].waited > 0 ? 0 : 1];
        EXPECT_EQ(plan.views[waits.first_view].serves.slice.axis, before.views[waited.first_view].serves.slice.axis);
    }
}

// Once nothing moves everybody has had a turn, all maps hold what they should, and the plan is the last one.
TEST(Turns, AreOverSoonWhereNothingMoves)
{
    for (const Partition partition : {Partition::cube, Partition::multi}) {
        Avenue avenue(32, partition);
        avenue.options.draw_budget_texels = 30000;
        Planner planner(avenue.options);
        test::Draughtsman draughtsman;
        int waits = 0;
        for (int step = 0; step < 20; ++step) {
            avenue.walk(step);
            const Plan& plan = planner.plan(avenue.frame);
            waits += plan.pages[0].longest_wait > 0 ? 1 : 0;
            ASSERT_NO_FATAL_FAILURE(draughtsman.follow(plan, avenue.set));
        }
        EXPECT_GT(waits, 5);
        for (std::uint32_t rest = 0; rest <= avenue.options.longest_wait; ++rest) {
            ASSERT_NO_FATAL_FAILURE(draughtsman.follow(planner.plan(avenue.frame), avenue.set));
        }
        const Plan& plan = planner.plan(avenue.frame);
        EXPECT_EQ(longestWait(plan), 0U);
        EXPECT_EQ(drawnTexels(plan), 0U);
        ASSERT_NO_FATAL_FAILURE(draughtsman.follow(plan, avenue.set));
        ASSERT_NO_FATAL_FAILURE(draughtsman.check(plan, avenue.set));
    }
}

// A plan without anybody who waits is as right as any, whatever was before it.
TEST(Turns, LeavePlansThatAreRight)
{
    Technique technique = kPlainTechnique;
    technique.partition = Partition::cube;
    test::Tally tally;
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        test::RandomScene scene = test::randomScene(seed, technique);
        scene.options.draw_budget_texels = 1;
        scene.options.longest_wait = 3;
        Planner planner(scene.options);
        Frame other = scene.frame();
        other.camera = test::perspectiveCamera({1, 2, 3}, {4, 5, 6}, 1.0);
        (void)planner.plan(other);
        for (std::uint32_t frame = 0; frame < 4; ++frame) {
            (void)planner.plan(scene.frame());
        }
        const Plan& plan = planner.plan(scene.frame());
        ASSERT_EQ(longestWait(plan), 0U);
        Random random(seed);
        ASSERT_NO_FATAL_FAILURE(test::judge(scene, plan, random, tally));
    }
    EXPECT_GT(tally.seen, 500);
}

// A removed object is in no list of casters, also not in an older one.
TEST(Turns, ForgetWhoIsGone)
{
    Waiting waiting;
    const std::uint32_t gone = waiting.avenue.walkers[5].index;
    waiting.avenue.set.remove(waiting.avenue.walkers[5]);
    const Plan& plan = waiting.next();
    EXPECT_GT(longestWait(plan), 0U);
    EXPECT_EQ(std::ranges::count(plan.casters, gone), 0);
}

TEST(Turns, TakeNothingFromTheHeap)
{
    for (const Partition partition : {Partition::cube, Partition::multi}) {
        Avenue avenue(32, partition);
        avenue.options.draw_budget_texels = 30000;
        Planner planner(avenue.options);
        int waits = 0;
        const auto lap = [&] {
            for (int step = 0; step < 30; ++step) {
                avenue.walk(step);
                avenue.frame.cut = step == 0; // so that each lap is as the last
                waits += longestWait(planner.plan(avenue.frame)) > 0 ? 1 : 0;
            }
        };
        for (int i = 0; i < 12; ++i) {
            lap();
        }
        const std::uint64_t before = test::heapAllocations();
        lap();
        EXPECT_EQ(test::heapAllocations(), before) << nameOf(partition);
        EXPECT_GT(waits, 100);
    }
}

} // namespace
} // namespace gnomon
