// SPDX-License-Identifier: Apache-2.0
// Partition multi: which frustums a light has, how large their maps are, and what stays from frame to frame.
#include "allocation_count.h"
#include "hall.h"

#include <gnomon/planner.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

namespace gnomon {
namespace {

using test::Hall;

std::uint64_t texelsOf(const Plan& plan)
{
    std::uint64_t texels = 0;
    for (const View& view : plan.views) {
        texels += std::uint64_t{view.place.tile.width} * view.place.tile.height;
    }
    return texels;
}

/// The side of a texel at a point that faces the lamp, in pixels that face the eye.
double texelInPixels(const Hall& hall, const View& view, const glm::dvec3& p)
{
    const glm::dvec4 w(view.projection.clip_from_world[0][3], view.projection.clip_from_world[1][3],
                       view.projection.clip_from_world[2][3], view.projection.clip_from_world[3][3]);
    const double depth_m = glm::dot(w, glm::dvec4(p, 1.0));
    const double pixel_m = 2.0 * std::tan(0.4) * glm::distance(p, hall.frame.camera.eye_ws) / hall.frame.size_px.y;
    return view.projection.texel_m * depth_m / pixel_m;
}

/// The views of a light that serve a point, finest first as the plan has them.
const View* viewOf(const Plan& plan, const glm::dvec3& p)
{
    const auto found = std::ranges::find_if(
        plan.views, [&](const View& view) { return view.serves.slice.holds(p) && view.serves.sector.holds(p); });
    return found != plan.views.end() ? &*found : nullptr;
}

TEST(Multi, HasFrustumsOnlyForWhatIsSeen)
{
    Hall hall;
    hall.addLamp({0, 3, 0}, 12.0);
    hall.look({25, 6, 25}, {0, 0, 0});
    Planner planner(hall.options);
    const Plan& plan = planner.plan(hall.frame);
    ASSERT_EQ(plan.lights[0].outcome.kind, OutcomeKind::ok) << plan.lights[0].outcome.reason;
    EXPECT_FALSE(plan.views.empty());
    for (const View& view : plan.views) {
        EXPECT_FALSE(view.serves.sector.holds({0, 8, 0})) << "nothing is above the lamp";
    }
    hall.look({25, 6, 25}, {50, 6, 50});
    EXPECT_EQ(planner.plan(hall.frame).lights[0].outcome.kind, OutcomeKind::no_receiver);
}

TEST(Multi, GivesEachPartTheTexelsThatItsPixelsWant)
{
    Hall hall;
    hall.options.max_texels = 64U << 20U;
    hall.addLamp({0, 3, -14}, 40.0);
    hall.look({1, 1.7, 16}, {0, 1, -14}); // into the lamp
    Planner planner(hall.options);
    const Plan& plan = planner.plan(hall.frame);
    int points = 0;
    int fine = 0;
    double finest = 1e9;
    double coarsest = 0.0;
    for (double z = 12.0; z > -12.0; z -= 0.5) {
        for (double x = -3.0; x <= 3.0; x += 0.5) {
            const View* const view = viewOf(plan, {x, 0.0, z});
            ASSERT_NE(view, nullptr) << x << ", " << z;
            const double texel_px = texelInPixels(hall, *view, {x, 0.0, z});
            ++points;
            fine += texel_px <= 1.1 ? 1 : 0;
            finest = std::min(finest, texel_px);
            coarsest = std::max(coarsest, texel_px);
        }
    }
    EXPECT_GE(fine, points * 95 / 100);
    EXPECT_LE(coarsest, 1.5);
    // Right below the lamp, in a shell with what is four times as far from it.
    EXPECT_GT(finest, 0.03);
}

/// How many times as wide as the finest the coarsest texel of the floor is, in pixels.
double spreadOf(const Hall& hall, const Plan& plan)
{
    double finest = 1e9;
    double coarsest = 0.0;
    for (double z = 12.0; z > -13.9; z -= 0.25) {
        for (double x = -3.0; x <= 3.0; x += 0.5) {
            const View* const view = viewOf(plan, {x, 0.0, z});
            const double texel_px = view != nullptr ? texelInPixels(hall, *view, {x, 0.0, z}) : 1e9;
            finest = std::min(finest, texel_px);
            coarsest = std::max(coarsest, texel_px);
        }
    }
    return coarsest / finest;
}

TEST(Multi, KeepsTexelsAlikeWhereItIsAskedTo)
{
    Hall hall;
    hall.options.max_texels = 64U << 20U;
    hall.addLamp({0, 1, -14}, 40.0);
    hall.look({1, 1.7, 16}, {0, 1, -14}); // into the lamp, which all but touches the floor
    Planner saving(hall.options);
    hall.options.multi.most_times = 4.0;
    Planner alike(hall.options);
    // Four times, and what sides of maps are rounded by.
    EXPECT_LT(spreadOf(hall, alike.plan(hall.frame)), 10.0);
    EXPECT_GT(spreadOf(hall, saving.plan(hall.frame)), 12.0);
    for (int frame = 0; frame < 3; ++frame) {
        EXPECT_LT(spreadOf(hall, alike.plan(hall.frame)), 10.0);
    }
}

/// How wide a texel is at a point of the floor below the lamp, in pixels.
double texelBelow(Hall& hall)
{
    const glm::dvec3 p(0.5, 0.0, 1.0);
    Planner planner(hall.options);
    const View* view = viewOf(planner.plan(hall.frame), p);
    return view != nullptr ? texelInPixels(hall, *view, p) : 1e9;
}

TEST(Multi, SeesThroughAnArchAroundTheEye)
{
    Hall hall;
    hall.frame.size_px = {1280, 800};
    hall.addLamp({0, 3, 0}, 10.0);
    hall.look({1, 8, 16}, {0, 0, 0});
    const double without = texelBelow(hall);
    ASSERT_LT(without, 1.5);
    hall.set.add(test::boxAt({0, 6, 16}, {10, 6, 3})); // beyond the lamp's reach
    EXPECT_LE(texelBelow(hall), without);
}

TEST(Multi, SeesTheWallsOfARoomThatIsOneBox)
{
    Hall hall;
    hall.set = {};
    hall.set.add(test::boxAt({0, 2, 0}, {5, 2, 5}));
    hall.addLamp({0, 3, 0}, 20.0);
    hall.look({0, 1.7, 4}, {0, 1.7, -5});
    Planner planner(hall.options);
    const glm::dvec3 wall(1.0, 1.5, -5.0);
    const View* view = viewOf(planner.plan(hall.frame), wall);
    ASSERT_NE(view, nullptr);
    EXPECT_LT(texelInPixels(hall, *view, wall), 1.5);
}

// Nobody can shape one frustum for both: the near half of the picture is the far half of what the lamp shines on.
TEST(Multi, DividesWhatIsSeenAgainstTheLight)
{
    Hall hall;
    hall.addLamp({0, 3, -14}, 40.0);
    hall.look({1, 1.7, 16}, {0, 1, -14});
    Planner planner(hall.options);
    const Plan& plan = planner.plan(hall.frame);
    std::set<double> begins;
    for (const View& view : plan.views) {
        begins.insert(view.serves.slice.begin_m);
    }
    EXPECT_GE(begins.size(), 2U);
    EXPECT_LE(begins.size(), 4U);
    hall.options.technique.partition = Partition::cube;
    hall.options.map_size = 512;
    Planner cube(hall.options);
    const Plan& other = cube.plan(hall.frame);
    const glm::dvec3 near(0.8, 0.0, 12.5);
    EXPECT_LT(texelInPixels(hall, *viewOf(plan, near), near), texelInPixels(hall, *viewOf(other, near), near));
}

TEST(Multi, KeepsToALightsTexels)
{
    Hall hall;
    hall.addLamp({0, 3, -14}, 40.0);
    hall.look({1, 1.7, 16}, {0, 1, -14});
    std::uint64_t before = 0;
    for (const std::uint32_t most : {65536U, 262144U, 1048576U, 4194304U}) {
        hall.options.max_texels = most;
        Planner planner(hall.options);
        const std::uint64_t texels = texelsOf(planner.plan(hall.frame));
        EXPECT_LE(texels, most);
        EXPECT_GT(texels, before) << "more texels are of use";
        before = texels;
    }
}

/// Forty lamps over boxes.
Hall fortyLamps()
{
    Hall hall;
    hall.set = {};
    test::Random random(40);
    for (int z = -12; z < 12; z += 4) {
        for (int x = -16; x < 16; x += 4) {
            hall.set.add({{x, -0.1F, z}, {x + 4, 0.0F, z + 4}});
        }
    }
    for (int i = 0; i < 60; ++i) {
        const glm::dvec3 half = random.inBox({0.2, 0.2, 0.2}, {0.7, 1.0, 0.7});
        const glm::dvec3 at = random.inBox({-15, 0, -11}, {15, 0, 11});
        hall.set.add(test::boxAt({at.x, half.y, at.z}, half));
    }
    for (int i = 0; i < 40; ++i) {
        hall.addLamp({-14.0 + 4.0 * (i % 8), 2.5, -10.0 + 5.0 * (i / 8)}, 7.0);
    }
    hall.look({16, 10, 16}, {0, 0, 0});
    return hall;
}

struct Spent {
    std::uint64_t texels = 0; // of all maps
    double texel_px = 0.0;    // mean over the floor and the lamps that light it, of what faces lamp and eye
};

Spent spend(Hall& hall, std::uint32_t most_of_a_light)
{
    hall.options.max_texels = most_of_a_light;
    hall.frame.lights = hall.lights;
    hall.frame.objects = &hall.set;
    Planner planner(hall.options);
    const Plan& plan = planner.plan(hall.frame);
    Spent spent{texelsOf(plan), 0.0};
    int points = 0;
    for (double z = -10.0; z <= 10.0; z += 1.0) {
        for (double x = -14.0; x <= 14.0; x += 1.0) {
            const glm::dvec3 p(x, 0.0, z);
            for (const View& view : plan.views) {
                if (glm::distance(p, view.projection.light_place_ws) < 6.5 && view.serves.slice.holds(p) &&
                    view.serves.sector.holds(p)) {
                    spent.texel_px += texelInPixels(hall, view, p);
                    ++points;
                }
            }
        }
    }
    spent.texel_px /= points;
    return spent;
}

// A texel as large as a pixel is not yet fine enough: edges gain by what is left of a light's texels.
TEST(Multi, SpendsTheTexelsThatAreLeft)
{
    Hall hall = fortyLamps();
    const Spent few = spend(hall, 1U << 20U);
    const Spent some = spend(hall, 2U << 20U);
    const Spent many = spend(hall, 4U << 20U);
    EXPECT_GT(few.texels, 40U * (1U << 19U)) << "more than half of what a light may have";
    EXPECT_GT(2 * many.texels, 5 * few.texels);
    EXPECT_LT(some.texel_px, 0.85 * few.texel_px);
    EXPECT_LT(many.texel_px, 0.85 * some.texel_px);
}

// A host that sets the texels of a pixel gets that many, and no more where fewer are enough.
TEST(Multi, SpendsNoMoreThanIsAskedFor)
{
    Hall hall = fortyLamps();
    hall.options.multi.texels_per_pixel = 1.0;
    const Spent asked = spend(hall, 4U << 20U);
    EXPECT_LT(asked.texels, 40U * (1U << 20U));
    EXPECT_EQ(spend(hall, 16U << 20U).texels, asked.texels);
    // Nothing is left over where drawing is bounded, for it would be drawn again, nor where a map's size is given. By
    // most_times all places are alike.
    hall.options.multi.texels_per_pixel.reset();
    hall.options.draw_budget_texels = 1U << 24U;
    EXPECT_EQ(spend(hall, 4U << 20U).texels, asked.texels);
    hall.options.draw_budget_texels = 0;
    hall.options.map_size = 1024;
    const std::uint64_t sized = spend(hall, 4U << 20U).texels;
    hall.options.multi.texels_per_pixel = 1.0;
    EXPECT_EQ(spend(hall, 4U << 20U).texels, sized);
    hall.options.multi.texels_per_pixel.reset();
    hall.options.map_size.reset();
    hall.options.multi.most_times = 4.0;
    EXPECT_LT(spend(hall, 4U << 20U).texels, 40U * (1U << 20U));
}

// However many texels there are, none is finer than an eighth of a pixel, give or take the rounding of sides.
TEST(Multi, LeavesWhatIsOfNoUse)
{
    Hall hall = fortyLamps();
    const Spent many = spend(hall, 64U << 20U);
    EXPECT_LT(spend(hall, 256U << 20U).texels, many.texels + many.texels / 10);
    EXPECT_GT(many.texel_px, 1.0 / 32.0);
}

// Texels that all maps share go from one to another seldom while a camera walks.
TEST(Multi, SharesWhatIsLeftSteadily)
{
    for (const Motion motion : {Motion::free, Motion::snap}) {
        Hall hall = fortyLamps();
        hall.options.technique.motion = motion;
        hall.options.max_texels = 1U << 20U;
        hall.frame.lights = hall.lights;
        hall.frame.objects = &hall.set;
        Planner planner(hall.options);
        int changes = 0;
        int views = 0;
        std::vector<std::pair<MapId, std::uint32_t>> before;
        for (int step = 0; step < 60; ++step) {
            hall.look({16 - 0.02 * step, 10, 16 - 0.01 * step}, {0.01 * step, 0, 0});
            std::vector<std::pair<MapId, std::uint32_t>> now;
            for (const View& view : planner.plan(hall.frame).views) {
                now.emplace_back(view.place.map, view.place.tile.width);
                changes += step > 0 && std::ranges::find(before, now.back()) == before.end() ? 1 : 0;
            }
            views += static_cast<int>(now.size());
            before = now;
        }
        EXPECT_LT(changes, views / 50) << nameOf(motion);
    }
}

TEST(Multi, DrawsNothingForLampsThatStandStill)
{
    Hall hall;
    for (int i = 0; i < 64; ++i) {
        hall.addLamp({-14.0 + 4.0 * (i % 8), 2.5, -14.0 + 4.0 * (i / 8)}, 8.0);
    }
    hall.options.max_texels = 65536;
    hall.look({25, 12, 25}, {0, 0, 0});
    Planner planner(hall.options);
    const Plan& first = planner.plan(hall.frame);
    EXPECT_TRUE(std::ranges::all_of(first.views, [](const View& view) { return view.contents.redraw; }));
    EXPECT_GT(first.views.size(), 64U);
    (void)planner.plan(hall.frame); // warm
    const std::uint64_t before = test::heapAllocations();
    const Plan& again = planner.plan(hall.frame);
    EXPECT_EQ(test::heapAllocations(), before);
    EXPECT_TRUE(std::ranges::none_of(again.views, [](const View& view) { return view.contents.redraw; }));
    for (const LightPlan& light : again.lights) {
        EXPECT_EQ(light.outcome.kind, OutcomeKind::ok);
    }
}

// One walker among 64 lamps: the maps that it is or was in are drawn, and with a kept copy no more of them than where
// it is or was.
TEST(Multi, DrawsOnlyWhatAMoverTouches)
{
    for (const Partition partition : {Partition::cube, Partition::multi}) {
        Hall hall;
        for (int i = 0; i < 64; ++i) {
            hall.addLamp({-14.0 + 4.0 * (i % 8), 2.5, -14.0 + 4.0 * (i / 8)}, 8.0);
        }
        const ObjectId walker = hall.set.add(test::boxAt({3, 0.9, 3}, {0.3, 0.9, 0.3}), {true, true, true});
        hall.options.technique.partition = partition;
        hall.options.max_texels = 65536;
        hall.options.keep_still = KeepStill::always;
        hall.look({25, 12, 25}, {0, 0, 0});
        Planner planner(hall.options);
        std::vector<MapId> touched;
        std::uint64_t all = 0;
        std::uint64_t drawn = 0;
        for (int step = 0; step < 20; ++step) {
            ASSERT_TRUE(hall.set.update(walker, test::boxAt({3 + 0.05 * step, 0.9, 3}, {0.3, 0.9, 0.3})));
            const Plan& plan = planner.plan(hall.frame);
            std::vector<MapId> now;
            for (const View& view : plan.views) {
                const auto first = plan.casters.begin() + view.casters.first;
                const bool holds =
                    std::find(first, first + view.casters.count, walker.index) != first + view.casters.count;
                if (holds) {
                    now.push_back(view.place.map);
                }
                if (step > 1) {
                    const bool held = std::ranges::find(touched, view.place.map) != touched.end();
                    EXPECT_TRUE(!view.contents.redraw || holds || held);
                    all += std::uint64_t{view.place.tile.width} * view.place.tile.height;
                    drawn += view.contents.redraw
                                 ? std::uint64_t{view.contents.dirty.width} * view.contents.dirty.height
                                 : 0;
                }
            }
            touched = now;
        }
        EXPECT_GT(drawn, 0U);
        EXPECT_LT(drawn, all / 40) << nameOf(partition);
    }
}

// soften=converge moves its lamp in each frame, and with it the division of directions.
TEST(Multi, HoldsWhatIsSeenFromEachPointOfALampThatConverges)
{
    Hall hall;
    hall.addLamp({0, 3, 0}, 20.0);
    hall.lights[0].radius_m = 0.5;
    hall.frame.lights = hall.lights;
    hall.options.technique.filter = Filter::hard;
    hall.options.technique.soften = Soften::converge;
    hall.look({9, 6, 12}, {0, 0, 0});
    Planner planner(hall.options);
    for (int number = 0; number < 24; ++number) {
        const Plan& plan = planner.plan(hall.frame);
        const LightSample& sample = plan.lights[0].sample;
        ASSERT_TRUE(sample.joined);
        for (const View& view : plan.views) {
            EXPECT_EQ(view.projection.light_place_ws, sample.position_ws);
            if (view.serves.sector.bounded()) {
                EXPECT_NEAR(glm::dot(view.serves.sector.w, glm::dvec4(sample.position_ws, 1.0)), 0.0, 1e-9);
            }
        }
        for (double z = -5.0; z <= 5.0; z += 0.25) {
            const glm::dvec3 p(0.3 * z, 0.0, z);
            const View* const view = viewOf(plan, p);
            ASSERT_NE(view, nullptr) << z;
            const glm::dvec4 clip = view->projection.clip_from_world * glm::dvec4(p, 1.0);
            EXPECT_LE(std::max(std::abs(clip.x), std::abs(clip.y)), clip.w) << number << ", " << z;
        }
    }
}

} // namespace
} // namespace gnomon
