// SPDX-License-Identifier: Apache-2.0
// Maps drawn by turns along walks: a bound on what a frame draws, and nobody waits for longer than is said, or loses a
// shadow by it.
#include "avenue.h"
#include "draughtsman.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <span>
#include <string>
#include <vector>

namespace gnomon {
namespace {

using test::Avenue;
using test::drawnTexels;
using test::longestWait;

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
        ASSERT_TRUE(!b.contents.redraw && !b.contents.redraw_kept && b.contents.dirty.empty());
        ASSERT_EQ(b.contents.presumes, a.contents.makes);
        ASSERT_EQ(b.contents.makes, a.contents.makes);
        ASSERT_EQ(b.contents.kept_presumes, a.contents.kept_makes);
        ASSERT_EQ(b.contents.kept_layer, a.contents.kept_layer);
        ASSERT_EQ(b.light, light);
        ASSERT_TRUE(a.place.map == b.place.map && sameBytes(a.place.tile, b.place.tile) &&
                    a.projection.clip_from_world == b.projection.clip_from_world);
        ASSERT_TRUE(sameBytes(a.projection.metric, b.projection.metric) &&
                    sameBytes(a.serves.slice.axis, b.serves.slice.axis) &&
                    a.serves.slice.begin_m == b.serves.slice.begin_m && a.serves.slice.end_m == b.serves.slice.end_m &&
                    a.serves.slice.blend_m == b.serves.slice.blend_m && sameBytes(a.serves.sector, b.serves.sector));
        const auto castersOf = [](const Plan& of, const View& view) {
            return std::vector(of.casters.begin() + view.casters.first,
                               of.casters.begin() + view.casters.first + view.casters.count);
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
        return std::ranges::any_of(viewsOf(plan), [&](const View& b) { return a.place.map == b.place.map; });
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

/// A view with a kept copy lists what stands still first, and counts it.
void expectStillFirst(const Plan& plan, const ObjectSet& set)
{
    for (const View& view : plan.views) {
        for (std::uint32_t i = 0; view.contents.kept_layer != kNoIndex && i < view.casters.count; ++i) {
            ASSERT_EQ(i < view.casters.still, !set.flags(plan.casters[view.casters.first + i]).dynamic) << i;
        }
    }
}

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
        ASSERT_NO_FATAL_FAILURE(expectStillFirst(plan, avenue.set));
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
                ASSERT_NO_FATAL_FAILURE(walkThrough(avenue, is_long ? 120 : 30, walk));
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

} // namespace
} // namespace gnomon
