// SPDX-License-Identifier: Apache-2.0
// Maps drawn by turns: a bound on what a frame draws, and nobody waits for longer than is said, or loses a shadow by
// it.
#include "allocation_count.h"
#include "draughtsman.h"
#include "plan_judge.h"
#include "store/draw_turns.h"
#include "worlds.h"

#include <gnomon/plan_views.h>
#include <gnomon/planner.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>
#include <string>
#include <vector>

namespace gnomon {
namespace {

using test::Random;

// ---- The rule

std::vector<std::uint32_t> drawnOf(std::vector<DrawTurn> turns, std::uint64_t budget, std::uint32_t longest)
{
    DrawTurns order;
    order.take(turns, budget, longest);
    std::vector<std::uint32_t> drawn;
    for (const DrawTurn& turn : turns) {
        if (turn.drawn) {
            drawn.push_back(turn.light);
        }
    }
    return drawn;
}

TEST(DrawTurns, GoToWhatIsOwedMost)
{
    const DrawTurn small{0, 1.0, 100, 0, true, false};
    const DrawTurn large{1, 5.0, 100, 0, true, false};
    const DrawTurn patient{2, 2.0, 100, 3, true, false};
    using Lights = std::vector<std::uint32_t>;
    EXPECT_EQ(drawnOf({small, large, patient}, 100, 8), Lights{2}) << "2 times 4 frames";
    EXPECT_EQ(drawnOf({small, large, patient}, 200, 8), (Lights{1, 2}));
    EXPECT_EQ(drawnOf({small, large, patient}, 299, 8), (Lights{1, 2}));
    EXPECT_EQ(drawnOf({small, large, patient}, 300, 8), (Lights{0, 1, 2}));
    EXPECT_EQ(drawnOf({small, small}, 100, 8), Lights{0}) << "of two alike, the first";
}

TEST(DrawTurns, DrawOneWhateverItTakes)
{
    using Lights = std::vector<std::uint32_t>;
    const DrawTurn dear{0, 1.0, 1U << 30U, 0, true, false};
    const DrawTurn cheap{1, 0.5, 1, 0, true, false};
    EXPECT_EQ(drawnOf({dear, cheap}, 10, 8), Lights{0});
    const DrawTurn must{2, 0.0, 5, 0, false, false};
    EXPECT_EQ(drawnOf({dear, cheap, must}, 10, 8), (Lights{1, 2})) << "somebody is drawn, and the rest has room";
    EXPECT_EQ(drawnOf({dear, cheap, must}, 5, 8), Lights{2});
}

TEST(DrawTurns, EndWithTheLongestWait)
{
    using Lights = std::vector<std::uint32_t>;
    const DrawTurn overdue{0, 0.0, 50, 8, true, false};
    const DrawTurn due{1, 100.0, 50, 7, true, false};
    EXPECT_EQ(drawnOf({overdue, due}, 50, 8), Lights{0});
    EXPECT_EQ(drawnOf({overdue, due}, 50, 9), Lights{1}) << "not yet";
    const DrawTurn current{2, 0.0, 0, 0, true, false};
    EXPECT_EQ(drawnOf({overdue, due, current}, 50, 8), (Lights{0, 2})) << "what has nothing to draw takes no turn";
}

// ---- In plans

/// Lamps along a street with posts, and people who walk it.
struct Avenue {
    ObjectSet set;
    std::vector<ObjectId> walkers;
    std::vector<Light> lights;
    Frame frame;
    ShadowOptions options{.technique = kPlainTechnique, .map_size = 64, .max_layers = 512};

    explicit Avenue(int lamps, Partition partition = Partition::cube, Motion motion = Motion::free)
    {
        for (int z = -40; z < 40; z += 4) {
            set.add({{-8, -0.1F, z}, {8, 0.0F, z + 4}});
            set.add(test::boxAt({2.0, 1.0, z + 2.0}, {0.2, 1.0, 0.2}));
        }
        for (int i = 0; i < 24; ++i) {
            walkers.push_back(set.add(walkerAt(i, 0), {true, true, true}));
        }
        options.technique.partition = partition;
        options.technique.motion = motion;
        for (int i = 0; i < lamps; ++i) {
            Light& lamp = lights.emplace_back();
            lamp.type = LightType::point;
            lamp.key = static_cast<std::uint32_t>(i);
            lamp.position_ws = {-1.0, 3.0, 36.0 - 72.0 * i / lamps};
            lamp.range_m = 9.0;
        }
        frame.size_px = {640, 400};
        frame.objects = &set;
        frame.lights = lights;
        look(0);
    }
    static Aabb walkerAt(int walker, int step)
    {
        const double z = std::fmod(3.3 * walker + 0.05 * step * (1 + walker % 3), 76.0) - 38.0;
        return test::boxAt({-3.0 + 0.25 * walker, 0.9, z}, {0.25, 0.9, 0.25});
    }
    void look(double way_m) { frame.camera = test::perspectiveCamera({0, 2, 42 - way_m}, {0, 1, -way_m}, 0.8); }
    void walk(int step)
    {
        for (int i = 0; i < static_cast<int>(walkers.size()); ++i) {
            set.update(walkers[static_cast<std::size_t>(i)], walkerAt(i, step));
        }
        look(0.05 * step);
        ++frame.index;
    }
};

std::uint64_t drawnTexels(const Plan& plan, const LightPlan& light)
{
    std::uint64_t texels = 0;
    for (std::uint32_t i = 0; i < light.view_count; ++i) {
        texels += texelsToDraw(plan.views[light.first_view + i]);
    }
    return texels;
}

std::uint64_t drawnTexels(const Plan& plan)
{
    std::uint64_t texels = 0;
    for (const LightPlan& light : plan.lights) {
        texels += drawnTexels(plan, light);
    }
    return texels;
}

std::uint32_t longestWait(const Plan& plan)
{
    std::uint32_t longest = 0;
    for (const LightPlan& light : plan.lights) {
        longest = std::max(longest, light.waited);
    }
    return longest;
}

template <class T>
bool sameBytes(const T& a, const T& b)
{
    return std::memcmp(&a, &b, sizeof(T)) == 0;
}

/// A light that waits has the views that it had, and nothing to draw.
void expectKept(const Plan& before, const Plan& plan, std::size_t light)
{
    const LightPlan& was = before.lights[light];
    const LightPlan& is = plan.lights[light];
    ASSERT_EQ(is.waited, was.waited + 1);
    ASSERT_EQ(is.view_count, was.view_count);
    ASSERT_GT(is.view_count, 0U);
    ASSERT_TRUE(is.outcome.hasMap());
    for (std::uint32_t i = 0; i < is.view_count; ++i) {
        const View& a = before.views[was.first_view + i];
        const View& b = plan.views[is.first_view + i];
        ASSERT_TRUE(!b.redraw && !b.redraw_kept && b.dirty.empty());
        ASSERT_EQ(b.presumes, a.makes);
        ASSERT_EQ(b.makes, a.makes);
        ASSERT_EQ(b.kept_presumes, a.kept_makes);
        ASSERT_EQ(b.kept_layer, a.kept_layer);
        ASSERT_EQ(b.light, light);
        ASSERT_TRUE(a.map == b.map && sameBytes(a.tile, b.tile) && a.clip_from_world == b.clip_from_world);
        ASSERT_TRUE(sameBytes(a.metric, b.metric) && sameBytes(a.slice, b.slice) && sameBytes(a.sector, b.sector));
        const auto castersOf = [](const Plan& of, const View& view) {
            return std::vector(of.casters.begin() + view.first_caster,
                               of.casters.begin() + view.first_caster + view.caster_count);
        };
        ASSERT_EQ(castersOf(before, a), castersOf(plan, b));
    }
}

/// Has it one of the maps that it had? Otherwise it has others now, as one whose maps have another size.
bool hasMapOf(const Plan& before, const Plan& plan, std::size_t light)
{
    const auto viewsOf = [&](const Plan& of) {
        return std::span(of.views).subspan(of.lights[light].first_view, of.lights[light].view_count);
    };
    return std::ranges::any_of(viewsOf(before), [&](const View& a) {
        return std::ranges::any_of(viewsOf(plan), [&](const View& b) { return a.map == b.map; });
    });
}

/// Over the budget are at most those who had to be drawn, or one who was due most.
void expectBudget(const Plan& before, const Plan& plan, std::uint64_t budget, std::uint32_t longest)
{
    int free_to_wait = 0;
    int had_to = 0;
    for (std::size_t i = 0; i < plan.lights.size(); ++i) {
        if (drawnTexels(plan, plan.lights[i]) > 0) {
            const bool must = !hasMapOf(before, plan, i) || before.lights[i].waited >= longest;
            ++(must ? had_to : free_to_wait);
        }
    }
    if (drawnTexels(plan) > budget) {
        ASSERT_LE(free_to_wait, had_to > 0 ? 0 : 1);
    }
}

struct Walk {
    std::uint32_t longest = 0;
    int waits = 0;
    int over = 0; // frames that draw more than the budget
    int maps = 0; // lights with maps, over all frames
    std::uint64_t most = 0;
};

/// Walks the street for some frames, looks at every plan, and compares who has maps with a planner without a bound.
void walkThrough(Avenue& avenue, int frames, Walk& walk)
{
    const bool is_scarce =
        avenue.options.budget_texels > 0; // then some have to be drawn, because their size is another

    ShadowOptions unbounded = avenue.options;
    unbounded.draw_budget_texels = 0;
    Planner planner(avenue.options);
    Planner other(unbounded);
    test::Draughtsman draughtsman; // who expects of every plan that it presumes what is there
    Plan before;
    for (int step = 0; step < frames; ++step) {
        avenue.walk(step);
        const Plan& plan = planner.plan(avenue.frame);
        const Plan& all = other.plan(avenue.frame);
        ASSERT_NO_FATAL_FAILURE(draughtsman.follow(plan, avenue.set));
        ASSERT_EQ(plan.pages[0].drawn_texels, drawnTexels(plan));
        ASSERT_EQ(plan.pages[0].longest_wait, longestWait(plan));
        for (std::size_t i = 0; i < plan.lights.size(); ++i) {
            ASSERT_TRUE(plan.lights[i].view_count > 0 || all.lights[i].view_count == 0) << "no shadow: " << i;
            walk.maps += plan.lights[i].view_count > 0 ? 1 : 0;
            if (plan.lights[i].waited > 0) {
                ++walk.waits;
                ASSERT_GT(step, 0);
                ASSERT_NO_FATAL_FAILURE(expectKept(before, plan, i));
            }
        }
        if (step > 0 && !is_scarce) {
            ASSERT_NO_FATAL_FAILURE(
                expectBudget(before, plan, avenue.options.draw_budget_texels, avenue.options.longest_wait));
            walk.over += drawnTexels(plan) > avenue.options.draw_budget_texels ? 1 : 0;
            walk.most = std::max(walk.most, drawnTexels(plan));
        }
        walk.longest = std::max(walk.longest, longestWait(plan));
        before = plan;
    }
}

TEST(Turns, EndInTimeOverALongWalk)
{
    for (const Partition partition : {Partition::cube, Partition::multi}) {
        for (const Motion motion : {Motion::free, Motion::snap}) {
            for (const KeepStill keep : {KeepStill::never, KeepStill::always}) {
                SCOPED_TRACE(std::string(nameOf(partition)) + " " + std::string(nameOf(motion)));
                Avenue avenue(64, partition, motion);
                avenue.options.keep_still = keep;
                avenue.options.longest_wait = 5;
                avenue.options.draw_budget_texels = motion == Motion::free ? 100000 : 8000;
                Walk walk;
                const bool is_long = motion == Motion::free && keep == KeepStill::never;
                ASSERT_NO_FATAL_FAILURE(walkThrough(avenue, is_long ? 150 : 40, walk));
                EXPECT_EQ(walk.longest, 5U);
                EXPECT_GT(walk.waits, 100);
                EXPECT_GT(walk.maps, 1000);
            }
        }
    }
}

// The same walk with more patience waits for longer: what holds the bound above is the bound.
TEST(Turns, WaitForLongerWhereTheyMay)
{
    Avenue avenue(64);
    avenue.options.draw_budget_texels = 1;
    avenue.options.longest_wait = 40;
    Walk walk;
    ASSERT_NO_FATAL_FAILURE(walkThrough(avenue, 100, walk));
    EXPECT_GT(walk.longest, 5U);
    EXPECT_LE(walk.longest, 40U);
}

TEST(Turns, KeepToTheBudget)
{
    Avenue avenue(64);
    avenue.options.longest_wait = 64;
    avenue.options.draw_budget_texels = 6 * 64 * 64 * 12;
    Walk walk;
    ASSERT_NO_FATAL_FAILURE(walkThrough(avenue, 120, walk));
    EXPECT_GT(walk.waits, 100);
    EXPECT_EQ(walk.over, 0) << walk.most;
}

// Room that is scarce gives maps other sizes, and those cannot wait.
TEST(Turns, GoWithRoomThatIsScarce)
{
    for (const Partition partition : {Partition::cube, Partition::multi}) {
        Avenue avenue(48, partition);
        avenue.options.map_size.reset();
        avenue.options.max_texels = 6U << 14U;
        avenue.options.budget_texels = 1U << 20U;
        avenue.options.draw_budget_texels = 1U << 18U;
        Walk walk;
        ASSERT_NO_FATAL_FAILURE(walkThrough(avenue, 100, walk));
        EXPECT_GT(walk.waits, 100);
        EXPECT_LE(walk.longest, avenue.options.longest_wait);
    }
}

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

TEST(Turns, AreTheSameAgain)
{
    Avenue avenue(40, Partition::multi);
    avenue.options.draw_budget_texels = 60000;
    Planner one(avenue.options);
    Planner other(avenue.options);
    for (int step = 0; step < 60; ++step) {
        avenue.walk(step);
        ASSERT_EQ(toJson(one.plan(avenue.frame)), toJson(other.plan(avenue.frame))) << step;
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
        lost.planner.lost(plan.views[waits->first_view].map);
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

// All views' slices are read along the camera's own axis, so where it turns they are others.
TEST(Turns, OfCascadesWaitWhileTheCameraDoesNotTurn)
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
        EXPECT_EQ(longestWait(planner.plan(avenue.frame)), 0U);
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

// Who is gone is in no list of casters, also not in one that is older.
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

TEST(Turns, AreToldInTheirRange)
{
    EXPECT_TRUE(resolve({.draw_budget_texels = 1}));
    EXPECT_TRUE(resolve({.draw_budget_texels = 1, .longest_wait = 64}));
    EXPECT_FALSE(resolve({.draw_budget_texels = 1, .longest_wait = 0}));
    EXPECT_FALSE(resolve({.longest_wait = 65}));
    EXPECT_FALSE(resolve({.draw_budget_texels = (std::uint64_t{1} << 35U) + 1}));
}

} // namespace
} // namespace gnomon
