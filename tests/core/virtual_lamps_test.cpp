// SPDX-License-Identifier: Apache-2.0
// Partition virtual: the pages of lights with a place, which lie on one square before a spot and on six around a lamp.
#include "draughtsman.h"
#include "plan_judge.h"
#include "street.h"

#include <glm/gtc/matrix_access.hpp>
#include <gtest/gtest.h>

#include <array>
#include <numbers>
#include <string>

namespace gnomon {
namespace {

using test::drawnTexels;
using test::kVirtual;
using test::Random;
using test::Street;
using test::viewOf;

class VirtualLamps : public testing::TestWithParam<LightType> {
protected:
    VirtualLamps() { street.placeLight(GetParam()); }

    Street street;
};

std::string nameOfType(const testing::TestParamInfo<LightType>& info)
{
    return info.param == LightType::spot ? "spot" : "point";
}

INSTANTIATE_TEST_SUITE_P(Types, VirtualLamps, testing::Values(LightType::spot, LightType::point), nameOfType);

TEST_P(VirtualLamps, HasAsManyPagesAsItsTexelsAllow)
{
    for (const std::uint32_t texels : {1U << 14U, 1U << 18U, 1U << 22U}) {
        street.options.max_texels = texels;
        Planner planner(street.options);
        const Plan& plan = planner.plan(street.frame);
        ASSERT_EQ(plan.lights[0].outcome.kind, OutcomeKind::ok) << plan.lights[0].outcome.reason;
        const std::uint32_t side = plan.views[0].place.tile.width;
        EXPECT_LE(plan.views.size(), texels / (side * side));
        EXPECT_GT(plan.views.size() * 4, texels / (side * side));
        EXPECT_TRUE(std::ranges::is_sorted(plan.views, {}, [](const View& view) { return view.projection.texel_m; }));
        test::expectOrder(plan, street.set);
    }
}

/// A page is a rectangle of a map of all its face, with texels as fine: its places are those moved by whole texels and
/// its depths are the same.
TEST_P(VirtualLamps, APageIsARectangleOfAWholeMap)
{
    Planner planner(street.options);
    const Plan& plan = planner.plan(street.frame);
    const glm::dvec3 light = street.lights[0].position_ws;
    int compared = 0;
    for (const View& page : plan.views) {
        const auto root = std::ranges::find_if(plan.views.rbegin(), plan.views.rend(), [&](const View& view) {
            return view.serves.sector.w == page.serves.sector.w;
        });
        const double times = root->projection.texel_m / page.projection.texel_m;
        EXPECT_EQ(times, std::exp2(std::round(std::log2(times))));
        EXPECT_EQ(page.projection.metric.metric_ws, root->projection.metric.metric_ws);
        EXPECT_EQ(glm::row(page.projection.clip_from_world, 2), glm::row(root->projection.clip_from_world, 2));
        EXPECT_EQ(glm::row(page.projection.clip_from_world, 3), glm::row(root->projection.clip_from_world, 3));
        // Half of a map's texels are on each side of the point straight before the light.
        const auto texelOf = [&](const View& view, double finer, const glm::dvec3& p) {
            return *placeOnMap(view, p) * (0.5 * finer * static_cast<double>(view.place.tile.width));
        };
        glm::dvec2 first(0.0);
        Random random(7);
        for (int i = 0; i < 5;) {
            const glm::dvec3 p = light + random.inBox({-20, -20, -20}, {20, 20, 20});
            if (!root->serves.sector.holds(p))
                continue;
            const glm::dvec2 apart = texelOf(page, 1.0, p) - texelOf(*root, times, p);
            first = i++ == 0 ? apart : first;
            EXPECT_NEAR(apart.x, first.x, 1e-5) << "scale and shift alone";
            EXPECT_NEAR(apart.y, first.y, 1e-5);
            EXPECT_NEAR(2.0 * apart.x, std::round(2.0 * apart.x), 1e-5) << "by whole texels";
            EXPECT_NEAR(2.0 * apart.y, std::round(2.0 * apart.y), 1e-5);
            ++compared;
        }
    }
    EXPECT_GT(compared, 500);
}

TEST_P(VirtualLamps, IsFinestWhereAnEdgeIs)
{
    const glm::dvec3 edge(-6, 0, 4);
    street.request(edge, 2.0);
    street.options.max_texels = 1U << 20U;
    Planner planner(street.options);
    const Plan& plan = planner.plan(street.frame);
    const View* const fine = viewOf(plan, edge);
    const View* const coarse = viewOf(plan, {6, 0, 4});
    ASSERT_TRUE(fine != nullptr && coarse != nullptr);
    EXPECT_LE(fine->projection.texel_m, 0.5 * coarse->projection.texel_m);
}

TEST_P(VirtualLamps, AStillFrameDrawsNothingAndAMovingCameraLittle)
{
    Planner planner(street.options);
    (void)planner.plan(street.frame);
    EXPECT_EQ(drawnTexels(planner.plan(street.frame)), 0U);
    std::uint64_t drawn = 0;
    for (int i = 1; i <= 60; ++i) {
        street.frame.index = static_cast<std::uint64_t>(i);
        street.look({0.05 * i, 6, 30 - 0.05 * i}, {0.02 * i, 1, 0});
        street.request({-6, 0, 4}, 2.0);
        const Plan& plan = planner.plan(street.frame);
        if (i > 1) // the first one has other requests
            drawn += drawnTexels(plan);
    }
    EXPECT_LT(drawn, std::uint64_t{60} * 2048 * 2048 * 15 / 100);
}

TEST_P(VirtualLamps, PagesAreNewWhereTheLightIsAnother)
{
    Planner planner(street.options);
    const auto mapsAfter = [&](auto change) {
        std::vector<std::uint64_t> both;
        for (int i = 0; i < 2; ++i) {
            if (i == 1)
                change(street.lights[0]);
            const Plan& plan = planner.plan(street.frame);
            both.push_back(drawnTexels(plan));
            both.push_back(plan.views.size() * 128 * 128);
        }
        EXPECT_EQ(both[2], both[3]) << "all are drawn";
        EXPECT_GT(both[3], 0U);
    };
    mapsAfter([](Light& light) { light.position_ws.x += 0.01; });
    if (GetParam() == LightType::spot) {
        mapsAfter([](Light& light) { light.direction_ws = glm::normalize(light.direction_ws + 0.01); });
        mapsAfter([](Light& light) { light.outer_half_angle_rad -= 0.01; });
    }
}

/// The rays from a shaded place to the rim of the light are within the border of its page, as far as somebody casts.
TEST_P(VirtualLamps, BordersHoldTheRaysToTheLight)
{
    street.options.technique.filter = Filter::raymarch;
    Planner planner(street.options);
    const Plan& plan = planner.plan(street.frame);
    ASSERT_EQ(plan.lights[0].outcome.kind, OutcomeKind::ok) << plan.lights[0].outcome.reason;
    const Light& light = street.lights[0];
    int shaded = 0;
    int coarse = 0;
    for (const ObjectId id : street.boxes) {
        const Aabb box = street.set.bounds(id);
        const glm::dvec3 top(0.5F * (box.min.x + box.max.x), box.max.y, 0.5F * (box.min.z + box.max.z));
        const glm::dvec3 way = top - light.position_ws;
        const glm::dvec3 p = light.position_ws + way * (light.position_ws.y / -way.y); // on the floor
        const View* const view = way.y < 0.0 ? viewOf(plan, p) : nullptr;
        if (view == nullptr)
            continue;
        if (view->projection.texel_m == plan.views.back().projection.texel_m) {
            ++coarse; // a root, which has to do
            continue;
        }
        const glm::dvec3 side = glm::normalize(glm::cross(way, glm::dvec3(0.3, 1.0, 0.2)));
        const glm::dvec3 other = glm::normalize(glm::cross(way, side));
        for (int k = 0; k < 16; ++k) {
            const double turn = k * std::numbers::pi / 8.0;
            const glm::dvec3 rim =
                light.position_ws + (side * std::cos(turn) + other * std::sin(turn)) * light.radius_m;
            const glm::dvec3 caught = p + (rim - p) * (glm::distance(p, top) / glm::distance(p, light.position_ws));
            const auto place = placeOnMap(*view, caught);
            ASSERT_TRUE(place.has_value());
            EXPECT_LE(std::max(std::abs(place->x), std::abs(place->y)), 1.0);
        }
        ++shaded;
    }
    EXPECT_GT(shaded, 10);
    EXPECT_GT(shaded, coarse);
}

/// In a shade no page but the roots has room for rays, and these have the texels.
TEST_P(VirtualLamps, InAShadeTheRootsHaveTheTexels)
{
    street.options.technique.filter = Filter::raymarch;
    const glm::vec3 place(street.lights[0].position_ws);
    street.set.add({place - 0.3F, place + 0.3F});
    Planner planner(street.options);
    const Plan& plan = planner.plan(street.frame);
    ASSERT_EQ(plan.lights[0].outcome.kind, OutcomeKind::ok) << plan.lights[0].outcome.reason;
    EXPECT_LE(plan.views.size(), GetParam() == LightType::spot ? 1U : 6U);
    for (const View& view : plan.views)
        EXPECT_EQ(view.place.tile.width, GetParam() == LightType::spot ? 2048U : 512U);
}

/// Points of the picture are in what serves them, and its casters are drawn there.
TEST(VirtualLampsOfRandomScenes, Hold)
{
    test::Tally tally;
    std::size_t pages = 0;
    for (std::uint64_t seed = 1; seed <= 1500; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        test::RandomScene scene = test::randomScene(seed, kVirtual);
        scene.lights.erase(scene.lights.begin()); // the sun
        Planner planner(scene.options);
        const Plan& plan = planner.plan(scene.frame());
        pages += plan.views.size();
        Random random(seed + 1000000);
        ASSERT_NO_FATAL_FAILURE(judge(scene, plan, random, tally));
        Planner again(scene.options);
        ASSERT_EQ(test::bytesOf(plan), test::bytesOf(again.plan(scene.frame())));
    }
    EXPECT_GT(tally.seen, 10000);
    EXPECT_GT(tally.blocked, 2000);
    EXPECT_GT(pages, 10000U);
}

/// Whatever moves, each map holds what drawing it from scratch would give.
TEST_P(VirtualLamps, IsNeverStale)
{
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Street moved;
        moved.placeLight(GetParam());
        moved.options.max_texels = 1U << 19U;
        Random random(seed);
        Planner planner(moved.options);
        test::Draughtsman draughtsman;
        for (int i = 0; i < 30; ++i) {
            moved.walk(random);
            if (random.below(8) == 0)
                moved.lights[0].position_ws += random.inBox({-1, -1, -1}, {1, 1, 1});
            const Plan& plan = planner.plan(moved.frame);
            draughtsman.follow(plan, moved.set);
            draughtsman.check(plan, moved.set);
            ASSERT_FALSE(testing::Test::HasFailure());
        }
    }
}

/// A spot that is too wide for one square has those of a lamp that its cone reaches into.
TEST(VirtualLampsOfWideSpots, HaveSquaresAroundThem)
{
    Street street;
    street.placeLight(LightType::spot);
    street.lights[0].outer_half_angle_rad = 1.5;
    Planner planner(street.options);
    const Plan& plan = planner.plan(street.frame);
    ASSERT_EQ(plan.lights[0].outcome.kind, OutcomeKind::ok) << plan.lights[0].outcome.reason;
    std::size_t squares = 0;
    for (const View& view : plan.views)
        squares += view.projection.texel_m == plan.views.back().projection.texel_m ? 1 : 0;
    EXPECT_GE(squares, 3U);
    for (const double x : {-9.0, 0.0, 11.0})
        EXPECT_NE(viewOf(plan, {x, 0.1, 3.0}), nullptr);
}

/// A face in which nobody is seen, or nobody casts, has no page.
TEST(VirtualLampsOfFaces, AreLeftOutWhereNothingIs)
{
    ObjectSet set;
    set.add({{-20, -1, -20}, {20, 0, 20}});
    set.add({{-1, 0.5F, -1}, {1, 1, 1}});
    Light lamp;
    lamp.type = LightType::point;
    lamp.position_ws = {0, 3, 0};
    Frame frame;
    frame.lights = std::span(&lamp, 1);
    frame.objects = &set;
    frame.camera = test::perspectiveCamera({0, 6, 12}, {0, 0, 0}, 0.9, 16.0 / 9.0);
    Planner planner(ShadowOptions{.technique = kVirtual});
    const Plan& plan = planner.plan(frame);
    ASSERT_FALSE(plan.views.empty());
    for (const View& view : plan.views)
        EXPECT_LT(view.serves.sector.w.y, 0.5) << "nothing is above";
    EXPECT_NE(viewOf(plan, {0.5, 0, 0.5}), nullptr);
}

} // namespace
} // namespace gnomon
