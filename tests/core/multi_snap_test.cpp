// SPDX-License-Identifier: Apache-2.0
// Partition multi with motion snap: texels that stay where they are, and what fades where they cannot.
#include "allocation_count.h"
#include "hall.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace gnomon {
namespace {

using test::Hall;

/// Where a point is on a view's map, texels.
glm::dvec2 texelOf(const View& view, const glm::dvec3& p)
{
    const glm::dvec4 clip = view.projection.clip_from_world * glm::dvec4(p, 1.0);
    return (glm::dvec2(clip) / clip.w * 0.5 + 0.5) * static_cast<double>(view.place.tile.width);
}

bool isOnMap(const View& view, const glm::dvec3& p)
{
    const glm::dvec4 clip = view.projection.clip_from_world * glm::dvec4(p, 1.0);
    return clip.w > 0.0 && std::max(std::abs(clip.x), std::abs(clip.y)) <= clip.w;
}

/// A walk towards the lamp, along it and around a corner, in which shells come and go.
glm::dvec3 onTheWay(int step)
{
    const double t = step / 240.0;
    return {1.0 + 6.0 * t * t, 1.7, 18.0 - 26.0 * t};
}

/// The name of one frustum: its directions, its shell and its texels.
struct FrustumName {
    glm::dvec4 sector;
    double begin_m;
    double end_m;
    double texel_m;
    bool operator==(const FrustumName&) const = default;
};

FrustumName nameOf(const View& view)
{
    return {view.serves.sector.w, view.serves.slice.begin_m, view.serves.slice.end_m, view.projection.texel_m};
}

TEST(MultiSnap, HoldsTexelsWhereTheyAre)
{
    for (const LightType type : {LightType::point, LightType::spot, LightType::directional}) {
        Hall hall;
        hall.addLamp({0, 3, -14}, 40.0);
        hall.lights[0].type = type;
        hall.lights[0].direction_ws = glm::normalize(glm::dvec3(0.1, -1.0, 0.5));
        hall.lights[0].outer_half_angle_rad = 1.0;
        hall.frame.lights = hall.lights;
        hall.options.technique.motion = Motion::snap;
        Planner planner(hall.options);
        std::vector<std::pair<FrustumName, glm::dvec2>> known;
        int compared = 0;
        int pans = 0;
        for (int step = 0; step < 240; ++step) {
            hall.look(onTheWay(step), {0, 1, -14});
            for (const View& view : planner.plan(hall.frame).views) {
                // Where the middle of its texels is, in texels: another place only by whole ones.
                const glm::dvec2 at = texelOf(view, {0.3, -0.05, -9.0});
                const auto same = std::ranges::find(known, nameOf(view), &std::pair<FrustumName, glm::dvec2>::first);
                if (same == known.end()) {
                    known.emplace_back(nameOf(view), at);
                    continue;
                }
                ++compared;
                const glm::dvec2 gone = at - same->second;
                pans += glm::length(gone) > 0.5 ? 1 : 0;
                ASSERT_LT(glm::length(gone - glm::round(gone)), 1e-4) << step;
            }
        }
        EXPECT_GT(compared, 400);
        EXPECT_GT(pans, type == LightType::spot ? 0 : 100);
        EXPECT_LT(known.size(), 80U) << "hardly ever other texels";
    }
}

// A host may take a key for another light. The maps of the one are of no use to the other.
TEST(MultiSnap, ForgetsALampThatBecomesAnother)
{
    Hall hall;
    hall.addLamp({0, 3, -14}, 40.0);
    hall.options.technique.motion = Motion::snap;
    Planner planner(hall.options);
    for (int step = 0; step < 40; ++step) {
        constexpr std::array kTypes{LightType::point, LightType::spot, LightType::directional};
        hall.lights[0].type = kTypes[static_cast<std::size_t>(step / 4 % 3)];
        hall.frame.lights = hall.lights;
        hall.look(onTheWay(6 * step), {0, 1, -14});
        const Plan& plan = planner.plan(hall.frame);
        for (const View& view : plan.views) {
            EXPECT_EQ(view.projection.parallel, hall.lights[0].type == LightType::directional);
            EXPECT_EQ(view.serves.sector.x != glm::dvec4(0.0), hall.lights[0].type == LightType::point);
            EXPECT_TRUE(step % 4 != 0 || view.serves.faded_in == 1.0) << "there is nothing to fade over";
        }
    }
}

// Places that change to another frustum fade over, and every visible place is on a map all the while.
TEST(MultiSnap, FadesWhatItHasToChange)
{
    Hall hall;
    hall.addLamp({0, 3, -14}, 40.0);
    hall.options.technique.motion = Motion::snap;
    hall.options.multi.fade_frames = 6;
    Planner planner(hall.options);
    int fading_frames = 0;
    int came_at_once = 0;
    std::vector<FrustumName> before;
    for (int step = 0; step < 240; ++step) {
        hall.look(onTheWay(step), {0, 1, -14});
        const Plan& plan = planner.plan(hall.frame);
        ASSERT_EQ(plan.lights[0].outcome.kind, OutcomeKind::ok);
        bool fades = false;
        std::vector<FrustumName> now;
        for (const View& view : plan.views) {
            ASSERT_GT(view.serves.faded_in, 0.0);
            ASSERT_LE(view.serves.faded_in, 1.0);
            fades = fades || view.serves.faded_in < 1.0;
            now.push_back(nameOf(view));
            came_at_once +=
                view.serves.faded_in == 1.0 && step > 0 && std::ranges::find(before, now.back()) == before.end() ? 1
                                                                                                                 : 0;
        }
        fading_frames += fades ? 1 : 0;
        before = now;
        for (double z = hall.frame.camera.eye_ws.z - 4.0; z > -18.0; z -= 0.7) {
            const glm::dvec3 p(0.2 * z, 0.0, z);
            const glm::dvec4 seen = hall.frame.camera.clip_from_world * glm::dvec4(p, 1.0);
            if (std::max(std::abs(seen.x), std::abs(seen.y)) > 0.99 * seen.w) {
                continue;
            }
            // The share of what no map has.
            double missing = 1.0;
            for (const View& view : plan.views) {
                if (view.serves.slice.holds(p) && view.serves.sector.holds(p) && isOnMap(view, p)) {
                    const double depth_m = glm::dot(view.serves.slice.axis, glm::dvec4(p, 1.0));
                    missing *= missing == 1.0 ? 0.0 : 1.0 - view.serves.shareAt(depth_m);
                }
            }
            ASSERT_LT(missing, 1e-9) << step << ": " << z;
        }
    }
    EXPECT_GT(fading_frames, 12);
    EXPECT_LT(fading_frames, 160);
    EXPECT_LT(came_at_once, 20) << "where nothing was before";
}

TEST(MultiSnap, TakesNothingFromTheHeapAndDrawsNothingAtRest)
{
    Hall hall;
    for (int i = 0; i < 16; ++i) {
        hall.addLamp({-14.0 + 8.0 * (i % 4), 2.5, -14.0 + 8.0 * (i / 4)}, 8.0);
    }
    hall.options.technique.motion = Motion::snap;
    Planner planner(hall.options);
    for (int step = 0; step < 60; ++step) {
        hall.look(onTheWay(step), {0, 1, -14});
        (void)planner.plan(hall.frame);
    }
    for (int rest = 0; rest < 40; ++rest) { // all fades are over
        (void)planner.plan(hall.frame);
    }
    const std::uint64_t before = test::heapAllocations();
    const Plan& plan = planner.plan(hall.frame);
    EXPECT_EQ(test::heapAllocations(), before);
    EXPECT_TRUE(std::ranges::none_of(plan.views, [](const View& view) { return view.contents.redraw; }));
    EXPECT_TRUE(std::ranges::all_of(plan.views, [](const View& view) { return view.serves.faded_in == 1.0; }));
}

TEST(MultiSnap, BeginsAnewAtACut)
{
    Hall hall;
    hall.addLamp({0, 3, -14}, 40.0);
    hall.options.technique.motion = Motion::snap;
    Planner planner(hall.options);
    hall.look(onTheWay(0), {0, 1, -14});
    (void)planner.plan(hall.frame);
    hall.look(onTheWay(220), {0, 1, -14});
    hall.frame.cut = true;
    const Plan& plan = planner.plan(hall.frame);
    EXPECT_TRUE(std::ranges::all_of(plan.views, [](const View& view) { return view.serves.faded_in == 1.0; }));
}

} // namespace
} // namespace gnomon
