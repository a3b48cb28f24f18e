// SPDX-License-Identifier: Apache-2.0
// Lights that want more texels than there are: all have maps, and those have most that the picture owes most to.
#include "allocation_count.h"
#include "worlds.h"

#include <gnomon/planner.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <vector>

namespace gnomon {
namespace {

/// Lamps in a row over a floor with posts.
struct Street {
    ObjectSet set;
    std::vector<Light> lights;
    Frame frame;
    ShadowOptions options{.technique = kPlainTechnique, .map_size = 256};

    explicit Street(int lamps)
    {
        for (int z = -40; z < 40; z += 4) {
            set.add({{-8, -0.1F, z}, {8, 0.0F, z + 4}});
            set.add(test::boxAt({2.0, 1.0, z + 2.0}, {0.2, 1.0, 0.2}));
        }
        options.technique.partition = Partition::cube;
        for (int i = 0; i < lamps; ++i) {
            Light& lamp = lights.emplace_back();
            lamp.type = LightType::point;
            lamp.key = static_cast<std::uint32_t>(i);
            lamp.position_ws = {-1.0, 3.0, 36.0 - 72.0 * i / lamps};
            lamp.range_m = 9.0;
        }
        frame.size_px = {640, 400};
        frame.camera = test::perspectiveCamera({0, 2, 42}, {0, 1, 0}, 0.8);
    }
    const Plan& plan(Planner& planner)
    {
        frame.lights = lights;
        frame.objects = &set;
        return planner.plan(frame);
    }
};

std::uint64_t texelsOf(const Plan& plan)
{
    std::uint64_t texels = 0;
    for (const View& view : plan.views) {
        texels += std::uint64_t{view.place.tile.width} * view.place.tile.height;
    }
    return texels;
}

std::uint32_t sideOf(const Plan& plan, std::size_t light)
{
    return plan.views[plan.lights[light].first_view].place.tile.width;
}

TEST(LightRoom, IsWhatEachAskedForWhileThereIsEnough)
{
    Street street(8);
    street.options.budget_texels = 6 * 8 * 256 * 256;
    Planner planner(street.options);
    const Plan& plan = street.plan(planner);
    for (std::size_t i = 0; i < 8; ++i) {
        EXPECT_EQ(plan.lights[i].halved, 0U);
        EXPECT_EQ(sideOf(plan, i), 256U);
    }
    EXPECT_EQ(plan.pages[0].wanted_texels, street.options.budget_texels);
    EXPECT_EQ(plan.pages[0].given_texels, street.options.budget_texels);
}

// In other engines the thirty-third lamp has none.
TEST(LightRoom, HasNoLightWithoutAShadow)
{
    for (const Partition partition : {Partition::cube, Partition::multi}) {
        // Pages of all sides, and squares that come and go.
        for (const std::uint64_t budget : {4U << 20U, 1700000U, 1U << 20U, 430001U, 1U << 18U}) {
            Street street(64);
            street.options.map_size.reset();
            street.options.max_texels = 6U << 16U;
            street.options.technique.partition = partition;
            street.options.budget_texels = budget;
            Planner planner(street.options);
            int shadows = 0;
            for (int frame = 0; frame < 40; ++frame) {
                street.frame.camera =
                    test::perspectiveCamera({0, 2, 42 - 1.5 * frame}, {0, 1, 42 - 1.5 * frame - 42}, 0.8);
                street.lights[7 * frame % 64].range_m = frame % 3 == 0 ? 0.5 : 9.0;
                const Plan& plan = street.plan(planner);
                for (const LightPlan& light : plan.lights) {
                    ASSERT_NE(light.outcome.kind, OutcomeKind::atlas_full) << frame << ", budget " << budget;
                    EXPECT_EQ(light.outcome.hasMap(), light.view_count > 0);
                    shadows += light.view_count > 0 ? 1 : 0;
                }
                EXPECT_LE(plan.pages[0].given_texels, budget);
                EXPECT_LE(texelsOf(plan), budget);
                EXPECT_LE(std::uint64_t{plan.pages[0].width} * plan.pages[0].height * plan.pages[0].layers, budget);
            }
            EXPECT_GT(shadows, 1000);
        }
    }
}

TEST(LightRoom, GoesToWhatThePictureShows)
{
    Street street(32);
    street.options.budget_texels = 1 << 21;
    Planner planner(street.options);
    const Plan& plan = street.plan(planner);
    // Depth by depth, the lamp's pool of light takes less of the picture.
    EXPECT_GT(sideOf(plan, 2), sideOf(plan, 30));
    EXPECT_EQ(plan.lights[30].halved - plan.lights[2].halved,
              static_cast<std::uint32_t>(std::log2(sideOf(plan, 2) / sideOf(plan, 30))));
    EXPECT_GT(plan.pages[0].wanted_texels, street.options.budget_texels);
    const std::uint32_t before = sideOf(plan, 8);
    street.lights[8].brightness = 100.0;
    EXPECT_GT(sideOf(street.plan(planner), 8), before) << "and of two, the brighter one";
}

TEST(LightRoom, IsSharedWhateverBrightnessSays)
{
    Street street(16);
    street.options.budget_texels = 1 << 19;
    const double numbers[]{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN(), -1.0, 0.0,
                           1e308};
    for (std::size_t i = 0; i < street.lights.size(); ++i) {
        street.lights[i].brightness = numbers[i % std::size(numbers)];
    }
    Planner planner(street.options);
    for (const LightPlan& light : street.plan(planner).lights) {
        EXPECT_EQ(light.outcome.kind, OutcomeKind::ok);
    }
}

TEST(LightRoom, IsFoundAgainWhenOthersGo)
{
    Street street(32);
    street.options.budget_texels = 1 << 20;
    Planner planner(street.options);
    EXPECT_GT(street.plan(planner).lights[4].halved, 0U);
    street.lights.erase(street.lights.begin() + 5, street.lights.end());
    street.lights.erase(street.lights.begin(), street.lights.begin() + 3);
    EXPECT_EQ(street.plan(planner).lights[1].halved, 0U);
    EXPECT_EQ(sideOf(street.plan(planner), 1), 256U);
}

// Squares that are left between others may be too small, though there are enough texels.
TEST(LightRoom, IsSmallerWhereSquaresAreScattered)
{
    Street street(16);
    street.options = {.technique = kPlainTechnique, .map_size = 64, .max_layers = 1};
    street.options.technique.partition = Partition::single;
    for (Light& light : street.lights) {
        light = [&] {
            Light spot = test::spot(light.position_ws, {0, -1, 0.1}, 0.9, 9.0);
            spot.key = light.key;
            spot.map_size = 16;
            return spot;
        }();
    }
    Planner planner(street.options);
    EXPECT_EQ(street.plan(planner).pages[0].layers, 1U);
    // Every other one goes, and one comes that wants a quarter of the page.
    std::vector<Light> left;
    for (std::size_t i = 0; i < street.lights.size(); i += 2) {
        left.push_back(street.lights[i]);
    }
    Light large = street.lights[1];
    large.key = 100;
    large.map_size = 32;
    left.push_back(large);
    street.lights = left;
    const Plan& plan = street.plan(planner);
    EXPECT_EQ(plan.lights[8].outcome.kind, OutcomeKind::ok);
    EXPECT_EQ(plan.lights[8].halved, 1U);
    EXPECT_EQ(sideOf(plan, 8), 16U);
    street.lights.erase(street.lights.begin(), street.lights.begin() + 4);
    const Plan& later = street.plan(planner);
    EXPECT_EQ(sideOf(later, 4), 32U);
    EXPECT_EQ(later.lights[4].halved, 0U);
}

// Each other side is a map drawn anew.
TEST(LightRoom, ChangesLittleWhereLittleMoves)
{
    Street street(32);
    street.options.budget_texels = 1 << 20;
    Planner planner(street.options);
    std::vector<std::uint32_t> before;
    int changes = 0;
    for (int step = 0; step < 100; ++step) {
        street.frame.camera = test::perspectiveCamera({0.01 * step, 2, 42 - 0.02 * step}, {0, 1, 0}, 0.8);
        const Plan& plan = street.plan(planner);
        for (std::size_t i = 0; i < plan.lights.size(); ++i) {
            changes += step > 0 && before[i] != plan.lights[i].halved ? 1 : 0;
        }
        before.clear();
        for (const LightPlan& light : plan.lights) {
            before.push_back(light.halved);
        }
    }
    EXPECT_LT(changes, 32) << "of 3200";
}

TEST(LightRoom, TakesNothingFromTheHeap)
{
    Street street(32);
    street.options.budget_texels = 1 << 20;
    Planner planner(street.options);
    (void)street.plan(planner);
    (void)street.plan(planner);
    const std::uint64_t before = test::heapAllocations();
    const Plan& again = street.plan(planner);
    EXPECT_EQ(test::heapAllocations(), before);
    EXPECT_TRUE(std::ranges::none_of(again.views, [](const View& view) { return view.contents.redraw; }));
}

} // namespace
} // namespace gnomon
