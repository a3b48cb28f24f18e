// SPDX-License-Identifier: Apache-2.0
// Partition multi with MultiDivide::receivers: what a receiver wants, and that a frustum of its own gives it.
#include "hall.h"
#include "plan_judge.h"
#include "random_scenes.h"
#include "sanitized.h"

#include <gnomon/plan_views.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace gnomon {
namespace {

using test::Hall;
using test::Random;
using test::RandomScene;
using test::randomScene;

Hall hallOfReceivers()
{
    Hall hall;
    hall.options.multi.divide = MultiDivide::receivers;
    hall.options.multi.texels_per_pixel = 1.0;
    return hall;
}

/// Side of a pixel at a point, by the camera's matrix alone: how far a step across goes that is one pixel.
double pixelAt_m(const Frame& frame, const glm::dvec3& p)
{
    const glm::dmat4& clip = frame.camera.clip_from_world;
    const glm::dvec4 c = clip * glm::dvec4(p, 1.0);
    const glm::dmat4 world_from_clip = glm::inverse(clip);
    double side_m = 0.0;
    for (int axis = 0; axis < 2; ++axis) {
        glm::dvec4 next = c;
        next[axis] += c.w * 2.0 / frame.size_px[axis];
        const glm::dvec4 q = world_from_clip * next;
        const glm::dvec4 here = world_from_clip * c;
        // Along the plane of one depth; the rows of a lens are square there.
        side_m = std::max(side_m, glm::distance(glm::dvec3(q) / q.w, glm::dvec3(here) / here.w));
    }
    return side_m;
}

/// Side of a texel at a point, on a surface that faces the lamp or the sun.
double texelAt_m(const View& view, const glm::dvec3& p)
{
    return view.projection.parallel ? view.projection.texel_m
                                    : view.projection.texel_m * glm::distance(p, view.projection.light_place_ws);
}

bool cameraSees(const RandomScene& scene, const glm::dvec3& p)
{
    const glm::dvec4 c = scene.camera.clip_from_world * glm::dvec4(p, 1.0);
    const double slack = 1e-6 * std::abs(c.w);
    const bool inside =
        c.w > 0.0 && std::abs(c.x) < c.w - slack && std::abs(c.y) < c.w - slack && c.z > 0.0 && c.z < c.w;
    const double limit = scene.options.max_distance_m;
    return inside && (limit == 0.0 || glm::distance(p, scene.camera.eye_ws) < limit * 0.999);
}

bool lightReaches(const RandomScene& scene, const Light& light, const glm::dvec3& p)
{
    if (light.type == LightType::directional) {
        return true;
    }
    const LightExtent extent = extentOf(light, scene.set.bounds());
    const glm::dvec3 to = p - light.position_ws;
    const double far_m = glm::length(to);
    const bool in_cone =
        light.type == LightType::point ||
        std::acos(std::clamp(glm::dot(to, light.direction_ws) / far_m, -1.0, 1.0)) < light.outer_half_angle_rad - 0.001;
    return in_cone && far_m > 2.0 * extent.near_m && (light.range_m == 0.0 || far_m < light.range_m * 0.999);
}

/// Does something cast on p? Then its receiver's frustum has a map.
bool isBlocked(const RandomScene& scene, const Light& light, const glm::dvec3& p)
{
    const bool sunny = light.type == LightType::directional;
    const double near_m = 3.0 * extentOf(light, scene.set.bounds()).near_m; // nothing that is nearer need cast
    const glm::dvec3 way = sunny ? -light.direction_ws : glm::normalize(light.position_ws - p);
    const double way_m = sunny ? 1e12 : glm::distance(light.position_ws, p) - near_m;
    for (std::uint32_t object = 0; object < scene.set.size(); ++object) {
        const Aabb& box = scene.set.bounds(object);
        double enter = 0.0;
        double leave = way_m;
        for (int axis = 0; axis < 3; ++axis) {
            const double a = (static_cast<double>(box.min[axis]) - p[axis]) / way[axis];
            const double b = (static_cast<double>(box.max[axis]) - p[axis]) / way[axis];
            enter = std::max(enter, std::min(a, b));
            leave = std::min(leave, std::max(a, b));
        }
        if (scene.set.flags(object).casts && enter <= leave) {
            return true;
        }
    }
    return false;
}

struct Held {
    int points = 0;
    int limited = 0; // points whose frustums have the largest map that there may be
};

/// One of the views that hold a point has at least the texels that its receiver wants there, or the largest map.
void checkHeld(const RandomScene& scene, const Frame& frame, const Plan& plan, std::size_t light, const glm::dvec3& p,
               Held& held)
{
    const LightPlan& lit = plan.lights[light];
    ASSERT_TRUE(lit.outcome.hasMap());
    double finest_m = std::numeric_limits<double>::infinity();
    bool is_largest = false;
    bool holds = false;
    for (const View& view : std::span(plan.views).subspan(lit.first_view, lit.view_count)) {
        if (view.serves.sector.holds(p) && placeOnMap(view, p)) {
            holds = true;
            finest_m = std::min(finest_m, texelAt_m(view, p));
            is_largest = is_largest || view.place.tile.width == largestSide(scene.options);
        }
    }
    ASSERT_TRUE(holds);
    ++held.points;
    if (finest_m > pixelAt_m(frame, p) * 1.0001) {
        ASSERT_TRUE(is_largest) << "coarser by " << finest_m / pixelAt_m(frame, p);
        ++held.limited;
    }
}

TEST(MultiReceivers, HoldEachReceiverWithTheTexelsThatItWants)
{
    constexpr int kScenes = test::kSanitized ? 1000 : 10000;
    test::Tally tally;
    Held held;
    for (int seed = 1; seed <= kScenes; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        RandomScene scene = randomScene(
            seed, {.partition = Partition::multi, .fit = Fit::uniform, .filter = Filter::hard, .soften = Soften::none});
        scene.options.multi.divide = MultiDivide::receivers;
        scene.options.multi.texels_per_pixel = 1.0;
        scene.options.map_size = 16384; // a plan draws nothing, and no light shares texels then
        scene.options.border_texels = 4.0;
        Planner planner(scene.options);
        const Frame frame = scene.frame();
        const Plan& plan = planner.plan(frame);
        Random random(seed + 1000000);
        ASSERT_NO_FATAL_FAILURE(judge(scene, plan, random, tally));
        for (int i = 0; i < 12; ++i) {
            const std::uint32_t object = random.below(scene.set.size());
            const Aabb& box = scene.set.bounds(object);
            const glm::dvec3 p = random.inBox(glm::dvec3(box.min), glm::dvec3(box.max));
            for (std::size_t light = 0; light < scene.lights.size(); ++light) {
                if (scene.set.flags(object).receives && cameraSees(scene, p) &&
                    lightReaches(scene, scene.lights[light], p) && isBlocked(scene, scene.lights[light], p)) {
                    ASSERT_NO_FATAL_FAILURE(checkHeld(scene, frame, plan, light, p, held));
                }
            }
        }
    }
    RecordProperty("points", held.points);
    RecordProperty("limited", held.limited);
    EXPECT_GT(held.points, 3 * kScenes);
    EXPECT_LT(held.limited, held.points / 10);
    EXPECT_GT(tally.seen, 15 * kScenes);
    EXPECT_GT(tally.blocked, 10 * kScenes);
}

// And whatever else is asked for, a view has all that casts on what it serves, also while frustums fade.
TEST(MultiReceivers, GoWithEveryFitAndMotion)
{
    constexpr int kScenes = 150;
    const Technique techniques[]{
        {.partition = Partition::multi, .fit = Fit::automatic, .filter = Filter::pcf},
        {.partition = Partition::multi, .fit = Fit::lispsm, .filter = Filter::vsm},
        {.partition = Partition::multi, .fit = Fit::uniform, .filter = Filter::pcf, .motion = Motion::snap},
        {.partition = Partition::multi, .fit = Fit::uniform, .filter = Filter::hard, .soften = Soften::converge}};
    test::Tally tally;
    for (const Technique& technique : techniques) {
        for (int seed = 1; seed <= kScenes; ++seed) {
            SCOPED_TRACE("seed " + std::to_string(seed));
            RandomScene scene = randomScene(seed, technique);
            scene.options.multi.divide = MultiDivide::receivers;
            scene.options.draw_budget_texels = seed % 3 == 0 ? 1U << 16U : 0;
            Planner planner(scene.options);
            Frame frame = scene.frame();
            Random random(seed + 1000000);
            for (int step = 0; step < 3; ++step) {
                frame.index = static_cast<std::uint64_t>(step);
                const Plan& plan = planner.plan(frame);
                if (technique.soften == Soften::none && scene.options.draw_budget_texels == 0) {
                    ASSERT_NO_FATAL_FAILURE(judge(scene, plan, random, tally));
                }
                scene.camera.eye_ws.x += 0.02 * scene.size_m;
                scene.camera.clip_from_world =
                    glm::translate(scene.camera.clip_from_world, glm::dvec3(-0.02 * scene.size_m, 0.0, 0.0));
                frame.camera = scene.camera;
            }
        }
    }
    EXPECT_GT(tally.blocked, 10 * kScenes);
}

TEST(MultiReceivers, TakeAFewFrustumsInADuel)
{
    Hall hall = hallOfReceivers();
    hall.options.max_texels = 64U << 20U;
    hall.addLamp({0, 3, -14}, 40.0);
    hall.look({1, 1.7, 16}, {0, 1, -14}); // into the lamp
    Planner planner(hall.options);
    const Plan& plan = planner.plan(hall.frame);
    ASSERT_TRUE(plan.lights[0].outcome.hasMap());
    // Regions: of the directions from the lamp to the eye, in which a texel is worth most near the eye.
    const auto regions = std::ranges::count_if(
        plan.views, [&](const View& view) { return view.serves.sector.holds(hall.frame.camera.eye_ws); });
    EXPECT_GE(regions, 2);
    EXPECT_LE(regions, 4);
    EXPECT_LE(plan.views.size(), 9U) << "all around the lamp";
}

TEST(MultiReceivers, AreNoWiderThan120Degrees)
{
    Hall hall = hallOfReceivers();
    hall.addLamp({0, 1, 0}, 40.0);
    hall.look({9, 9, 12}, {0, 0, 0});
    Planner planner(hall.options);
    const Plan& plan = planner.plan(hall.frame);
    ASSERT_GT(plan.views.size(), 1U);
    for (const View& view : plan.views) {
        ASSERT_TRUE(view.serves.layered);
        // At the sector's sides |x| is w: on the axis' plane that is half its width.
        const glm::dvec3 axis(view.serves.sector.w);
        for (const glm::dvec4& across : {view.serves.sector.x, view.serves.sector.y}) {
            const glm::dvec3 row(across);
            const double along = glm::dot(row, axis);
            const double aside = glm::length(row - axis * along);
            EXPECT_LE((1.0 + std::abs(along)) / aside, std::sqrt(3.0) + 1e-6);
        }
    }
}

/// A point that frustums of joined receivers share: each side of the seam counts half.
TEST(MultiReceivers, ShareASeamByHalves)
{
    ObjectSet set;
    set.add({{-8, -0.1F, -6}, {0, 0, 6}}, {.joined = true});
    set.add({{0, -0.1F, -6}, {8, 0, 6}}, {.joined = true});
    set.add(test::boxAt({0, 1, 0}, {2, 0.1, 2}), {.receives = false});
    Hall hall = hallOfReceivers();
    hall.set = std::move(set);
    hall.addLamp({0, 3, 0}, 20.0);
    hall.options.max_texels = 1U << 18U; // so that no map holds both
    hall.look({-9, 3, 1}, {0, 0, 0});
    Planner planner(hall.options);
    const Plan& plan = planner.plan(hall.frame);
    ASSERT_GE(plan.views.size(), 2U);
    const glm::dvec3 p(0.0, 0.0, 1.0);
    std::vector<double> counts;
    double left = 1.0;
    for (const View& view : plan.views) {
        if (view.serves.sector.holds(p)) {
            counts.push_back(std::min(left, view.serves.opacityAt(p)));
            left -= counts.back();
        }
    }
    ASSERT_GE(counts.size(), 2U);
    EXPECT_NEAR(counts[0] / (1.0 - left), 0.5, 0.03); // the boxes are a rounding larger than the tiles
}

TEST(MultiReceivers, ChopWhatSurroundsTheLamp)
{
    Hall hall = hallOfReceivers();
    hall.set = {};
    hall.set.add(test::boxAt({0, 2, 0}, {5, 2, 5}));
    hall.addLamp({0, 3, 0}, 20.0);
    hall.look({0, 1.7, 4}, {0, 1.7, -5});
    Planner planner(hall.options);
    const Plan& plan = planner.plan(hall.frame);
    EXPECT_GE(plan.views.size(), 2U);
    EXPECT_LE(plan.views.size(), 6U);
}

/// Where a point is on a view's map, texels.
glm::dvec2 texelOf(const View& view, const glm::dvec3& p)
{
    return (placeOnMap(view, p).value_or(glm::dvec2(0.0)) * 0.5 + 0.5) * static_cast<double>(view.place.tile.width);
}

// With motion snap texels stay where they are, and what has to change fades.
TEST(MultiReceivers, LiveOn)
{
    Hall hall = hallOfReceivers();
    hall.addLamp({0, 3, -14}, 40.0);
    hall.options.technique.motion = Motion::snap;
    hall.options.multi.fade_frames = 6;
    Planner planner(hall.options);
    struct Known {
        glm::dvec3 axis;
        double texel_m;
        glm::dvec2 at;
    };
    std::vector<Known> known;
    int compared = 0;
    int fading_frames = 0;
    int at_once = 0;
    for (int step = 0; step < 240; ++step) {
        const double t = step / 240.0;
        hall.look({1.0 + 6.0 * t * t, 1.7, 18.0 - 26.0 * t}, {0, 1, -14});
        bool fades = false;
        for (const View& view : planner.plan(hall.frame).views) {
            fades = fades || view.serves.faded_in < 1.0;
            const glm::dvec3 axis(view.serves.sector.w);
            const glm::dvec2 at = texelOf(view, glm::dvec3(0.0, 3.0, -14.0) + axis);
            const auto same = std::ranges::find_if(
                known, [&](const Known& one) { return one.axis == axis && one.texel_m == view.projection.texel_m; });
            if (same == known.end()) {
                known.push_back({axis, view.projection.texel_m, at});
                at_once += step > 0 && view.serves.faded_in == 1.0 ? 1 : 0;
                continue;
            }
            ++compared;
            const glm::dvec2 gone = at - same->at;
            ASSERT_LT(glm::length(gone - glm::round(gone)), 1e-4) << step;
        }
        fading_frames += fades ? 1 : 0;
    }
    EXPECT_GT(compared, 240);
    EXPECT_LT(static_cast<int>(known.size()), compared / 15) << "hardly ever other texels";
    EXPECT_GT(fading_frames, 6);
    EXPECT_LT(fading_frames, 200);
    EXPECT_EQ(at_once, 0);
}

TEST(MultiReceivers, StayWhereNothingMoves)
{
    for (const Motion motion : {Motion::free, Motion::snap}) {
        Hall hall = hallOfReceivers();
        hall.addLamp({0, 3, -8}, 20.0);
        hall.options.technique.motion = motion;
        hall.look({1, 1.7, 12}, {0, 1, -14});
        Planner planner(hall.options);
        const std::string first = test::bytesOf(planner.plan(hall.frame));
        Plan plan;
        for (int i = 0; i < 12; ++i) {
            hall.frame.index = static_cast<std::uint64_t>(i) + 1;
            plan = planner.plan(hall.frame);
        }
        for (const View& view : plan.views) {
            EXPECT_FALSE(view.contents.redraw);
            EXPECT_EQ(view.serves.faded_in, 1.0);
        }
    }
}

} // namespace
} // namespace gnomon
