// SPDX-License-Identifier: Apache-2.0
// Partition virtual: which pages a sun has, what they show, and what stays from frame to frame.
#include "allocation_count.h"
#include "draughtsman.h"
#include "plan_judge.h"
#include "street.h"

#include <gnomon/choice_rules.h>
#include <gnomon/plan_views.h>
#include <gnomon/planner.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace gnomon {
namespace {

using test::drawnTexels;
using test::kVirtual;
using test::Random;
using test::Street;
using test::viewOf;

TEST(Virtual, HasAsManyPagesAsItsTexelsAllow)
{
    Street street;
    for (const std::uint32_t texels : {1U << 14U, 1U << 18U, 1U << 22U}) {
        street.options.max_texels = texels;
        Planner planner(street.options);
        const Plan& plan = planner.plan(street.frame);
        ASSERT_EQ(plan.lights[0].outcome.kind, OutcomeKind::ok) << plan.lights[0].outcome.reason;
        EXPECT_EQ(plan.views.size(), texels / (128 * 128));
        EXPECT_TRUE(std::ranges::is_sorted(plan.views, {}, [](const View& view) { return view.projection.texel_m; }));
        test::expectOrder(plan, street.set);
    }
}

/// Pages with texels of one size are parts of one map: the same texel has the same place and depth in each.
TEST(Virtual, PagesOfOneSizeArePartsOfOneMap)
{
    Street street;
    Planner planner(street.options);
    const Plan& plan = planner.plan(street.frame);
    int pairs = 0;
    for (std::size_t i = 0; i + 1 < plan.views.size(); ++i) {
        const View& a = plan.views[i];
        const View& b = plan.views[i + 1];
        if (a.projection.texel_m != b.projection.texel_m)
            continue;
        ++pairs;
        const auto texelOf = [](const View& view, const glm::dvec3& p) {
            return (*placeOnMap(view, p) * 0.5 + 0.5) * static_cast<double>(view.place.tile.width);
        };
        glm::dvec2 apart(0.0);
        for (const glm::dvec3& p : {glm::dvec3(3, 1, 2), glm::dvec3(-40, 7, 11), glm::dvec3(12, 0.5, -90)}) {
            apart = texelOf(a, p) - texelOf(b, p);
            EXPECT_NEAR(apart.x, std::round(apart.x), 1e-6);
            EXPECT_NEAR(apart.y, std::round(apart.y), 1e-6);
            EXPECT_EQ(depthOnMap(a, p), depthOnMap(b, p));
        }
        EXPECT_GT(std::max(std::abs(apart.x), std::abs(apart.y)), 1.0) << "they are two";
    }
    EXPECT_GT(pairs, 20);
}

TEST(Virtual, IsFinestWhereAnEdgeIs)
{
    Street street;
    const glm::dvec3 edge(-9, 0, 4);
    const glm::dvec3 elsewhere(9, 0, 4);
    street.request(edge, 2.0);
    Planner planner(street.options);
    const Plan& plan = planner.plan(street.frame);
    const View* const fine = viewOf(plan, edge);
    const View* const coarse = viewOf(plan, elsewhere);
    ASSERT_TRUE(fine != nullptr && coarse != nullptr);
    EXPECT_LE(fine->projection.texel_m, 0.5 * coarse->projection.texel_m);
}

TEST(Virtual, RequestsAreNotUsedAfterACutNorForAnotherLight)
{
    Street street;
    Planner planner(street.options);
    const std::string without = test::bytesOf(planner.plan(street.frame));
    street.request({-9, 0, 4}, 2.0);
    street.frame.cut = true;
    Planner cut(street.options);
    const std::size_t views = cut.plan(street.frame).views.size();
    EXPECT_GT(views, 1U);
    street.frame.cut = false;
    street.requests[0].light_key = 8;
    Planner other(street.options);
    EXPECT_EQ(test::bytesOf(other.plan(street.frame)).size(), without.size());
}

/// A narrow penumbra near the floor and a wide one from above: a page has room for the rays of what it serves.
TEST(Virtual, BordersHoldTheRaysToTheLight)
{
    Street street;
    street.options.technique.filter = Filter::raymarch;
    const double spread = std::tan(0.5 * 0.07);
    street.lights[0].angular_diameter_rad = 0.07;
    Planner planner(street.options);
    const Plan& plan = planner.plan(street.frame);
    ASSERT_EQ(plan.lights[0].outcome.kind, OutcomeKind::ok);
    Random random(11);
    int narrow = 0;
    for (int i = 0; i < 2000; ++i) {
        const glm::dvec3 p = random.inBox({-30, 0, -30}, {30, 0, 25});
        const View* const view = viewOf(plan, p);
        ASSERT_NE(view, nullptr);
        if (view == &plan.views.back())
            continue; // the root, which has to do
        for (const ObjectId id : street.boxes) {
            const Aabb box = street.set.bounds(id);
            const glm::dvec3 top(0.5F * (box.min.x + box.max.x), box.max.y, 0.5F * (box.min.z + box.max.z));
            const double up_m = top.y / 0.8 * glm::length(glm::dvec3(0.4, -0.8, 0.3));
            const glm::dvec3 shaded = top + street.lights[0].direction_ws * up_m;
            if (glm::distance(shaded, p) < 0.2) {
                ++narrow;
                EXPECT_GE(14.0 * view->projection.texel_m, spread * up_m);
            }
        }
    }
    EXPECT_GT(narrow, 0);
}

TEST(Virtual, AStillFrameDrawsNothingAndAMovingCameraLittle)
{
    Street street;
    Planner planner(street.options);
    (void)planner.plan(street.frame);
    EXPECT_EQ(drawnTexels(planner.plan(street.frame)), 0U);
    std::uint64_t drawn = 0;
    std::uint64_t whole = 0;
    for (int i = 1; i <= 60; ++i) {
        street.frame.index = static_cast<std::uint64_t>(i);
        street.look({0.05 * i, 6, 30 - 0.05 * i}, {0.02 * i, 1, 0});
        street.request({-9, 0, 4}, 2.0);
        const Plan& plan = planner.plan(street.frame);
        if (i > 1) // the first one has other requests
            drawn += drawnTexels(plan);
        whole += std::uint64_t{2048} * 2048;
    }
    EXPECT_LT(drawn, whole * 15 / 100);
}

TEST(Virtual, AMoverDrawsOnlyPagesThatItTouches)
{
    Street street;
    street.request({-9, 0, 4}, 2.0); // else the points that stand in would move with the box
    Planner planner(street.options);
    (void)planner.plan(street.frame);
    const Aabb box = street.set.bounds(street.boxes[5]);
    const glm::vec3 step(0.05F, 0.0F, 0.0F);
    street.set.update(street.boxes[5], {box.min + step, box.max + step});
    const Plan& plan = planner.plan(street.frame);
    const auto touched = [&](const View& view) {
        const auto casters = std::span(plan.casters).subspan(view.casters.first, view.casters.count);
        return std::ranges::find(casters, street.boxes[5].index) != casters.end();
    };
    for (const View& view : plan.views)
        EXPECT_EQ(view.contents.redraw, touched(view));
}

/// Points of the picture are in what serves them, and its casters are drawn there.
TEST(Virtual, HoldsForRandomScenes)
{
    test::Tally tally;
    std::size_t pages = 0;
    for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        test::RandomScene scene = test::randomScene(seed, kVirtual);
        scene.lights.resize(1);
        Planner planner(scene.options);
        const Plan& plan = planner.plan(scene.frame());
        pages += plan.views.size();
        const std::uint64_t side = *scene.options.map_size;
        ASSERT_LE(plan.views.size(), std::max<std::uint64_t>(side * side / (128 * 128), 1));
        Random random(seed + 1000000);
        ASSERT_NO_FATAL_FAILURE(judge(scene, plan, random, tally));
        Planner again(scene.options);
        ASSERT_EQ(test::bytesOf(plan), test::bytesOf(again.plan(scene.frame())));
    }
    EXPECT_GT(tally.seen, 10000);
    EXPECT_GT(tally.blocked, 5000);
    EXPECT_GT(pages, 10000U);
}

/// Whatever moves, each map holds what drawing it from scratch would give.
void walkAndCheck(std::uint64_t seeds)
{
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Street street;
        street.options.max_texels = 1U << 19U;
        Random random(seed);
        Planner planner(street.options);
        test::Draughtsman draughtsman;
        for (int i = 0; i < 30; ++i) {
            street.walk(random);
            const Plan& plan = planner.plan(street.frame);
            draughtsman.follow(plan, street.set);
            draughtsman.check(plan, street.set);
            ASSERT_FALSE(testing::Test::HasFailure());
        }
    }
}

TEST(Virtual, IsNeverStale)
{
    walkAndCheck(20);
}

TEST(Virtual, IsNeverStaleInTenThousandFrames)
{
    walkAndCheck(334);
}

/// Edges in the mask are those of the pages themselves, so pages and edges may change each other for ever.
TEST(Virtual, SettlesAtRestHoweverEdgesChange)
{
    Street street;
    street.options.max_texels = 1U << 20U;
    Planner planner(street.options);
    std::uint64_t drawn_early = 0;
    for (int i = 0; i < 60; ++i) {
        street.frame.index = static_cast<std::uint64_t>(i);
        street.request({i % 2 == 0 ? 6.0 : -6.0, 0, 4.0 * (i % 3)}, 4.0);
        const std::uint64_t drawn = drawnTexels(planner.plan(street.frame));
        drawn_early += i > 2 && i < 8 ? drawn : 0;
        if (i >= 24) {
            EXPECT_EQ(drawn, 0U) << "frame " << i;
        }
    }
    EXPECT_GT(drawn_early, 0U) << "at first they follow";
    street.look({1, 6, 30}, {0, 1, 0});
    (void)planner.plan(street.frame);
    street.request({20.0, 0, 10.0}, 4.0);
    EXPECT_GT(drawnTexels(planner.plan(street.frame)), 0U) << "and again once something has changed";
}

TEST(Virtual, AllocatesNothingOnceWarm)
{
    Street street;
    Planner planner(street.options);
    const auto lookOn = [&](int i) {
        street.frame.index = static_cast<std::uint64_t>(i);
        street.look({0.03 * (i % 40), 6, 30}, {0, 1, 0});
    };
    for (int i = 0; i < 600; ++i) {
        lookOn(i);
        (void)planner.plan(street.frame);
    }
    const std::uint64_t before = test::heapAllocations();
    for (int i = 600; i < 640; ++i) {
        lookOn(i);
        (void)planner.plan(street.frame);
    }
    EXPECT_EQ(test::heapAllocations(), before);
}

TEST(Virtual, SaysWhatItDoesNotGoWith)
{
    ShadowOptions options{.technique = kVirtual};
    EXPECT_EQ(refusal(LightType::directional, options), std::nullopt);
    EXPECT_EQ(refusal(LightType::spot, options), std::nullopt);
    EXPECT_EQ(refusal(LightType::point, options), std::nullopt);
    for (const Filter filter : {Filter::vsm, Filter::id, Filter::smoothies, Filter::volumes}) {
        options.technique.filter = filter;
        for (const LightType type : {LightType::directional, LightType::spot, LightType::point})
            EXPECT_NE(refusal(type, options), std::nullopt) << nameOf(filter);
    }
    options.technique = kVirtual;
    options.draw_budget_texels = 1000;
    EXPECT_FALSE(resolve(options));
    EXPECT_NE(resolve(options).refusal.find("draw-budget"), std::string::npos);
}

} // namespace
} // namespace gnomon
