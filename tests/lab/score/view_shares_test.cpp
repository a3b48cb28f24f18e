// SPDX-License-Identifier: Apache-2.0
// The shares of a light's maps, on a plane that is seen aslant.
#include "lab/score/view_shares.h"

#include <gnomon/plan_views.h>
#include <gnomon/planner.h>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace gnomon::lab {
namespace {

constexpr std::uint32_t kWidth_px = 32;
constexpr std::uint32_t kHeight_px = 48;
constexpr double kNear_m = 0.5;
constexpr double kFar_m = 100.0;

/// Reversed z, y down, from `eye` along `forward`.
Camera cameraOf(const glm::dvec3& eye, const glm::dvec3& forward)
{
    const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(0.0, 1.0, 0.0)));
    const glm::dvec3 up = glm::cross(right, forward);
    const auto row = [&](const glm::dvec3& axis, double scale) {
        return glm::dvec4(axis, -glm::dot(axis, eye)) * scale;
    };
    const double share = kNear_m / (kFar_m - kNear_m);
    const glm::dvec4 depth = row(forward, 1.0);
    Camera camera;
    camera.eye_ws = eye;
    camera.clip_from_world = glm::transpose(
        glm::dmat4(row(right, 2.0), row(up, -2.0), glm::dvec4(0, 0, 0, share * kFar_m) - depth * share, depth));
    return camera;
}

/// The plane y = 0, with a plan for it.
struct Ground {
    Ground()
    {
        camera = cameraOf({0.0, 6.0, 0.0}, glm::normalize(glm::dvec3(0.0, -0.75, -1.0)));
        depth = ImageF(kWidth_px, kHeight_px, 1);
        normals = ImageF(kWidth_px, kHeight_px, 3);
        const glm::dmat4 world_from_clip = glm::inverse(camera.clip_from_world);
        for (std::uint32_t y = 0; y < kHeight_px; ++y) {
            for (std::uint32_t x = 0; x < kWidth_px; ++x) {
                normals.pixel(x, y)[1] = 1.0F;
                const glm::dvec2 ndc((x + 0.5) / kWidth_px * 2.0 - 1.0, (y + 0.5) / kHeight_px * 2.0 - 1.0);
                const glm::dvec4 far = world_from_clip * glm::dvec4(ndc, 0.5, 1.0);
                const glm::dvec3 ray = glm::dvec3(far) / far.w - camera.eye_ws;
                const glm::dvec3 point = camera.eye_ws - ray * (camera.eye_ws.y / ray.y);
                const glm::dvec4 clip = camera.clip_from_world * glm::dvec4(point, 1.0);
                *depth.pixel(x, y) = static_cast<float>(clip.z / clip.w);
            }
        }
        objects.add({{-80.0F, -0.01F, -80.0F}, {80.0F, 0.01F, 80.0F}});
        objects.add({{-1.0F, 0.0F, -20.0F}, {1.0F, 3.0F, -18.0F}});
        light.direction_ws = glm::normalize(glm::dvec3(0.2, -1.0, 0.1));
    }
    [[nodiscard]] Plan plan(const ShadowOptions& options) const
    {
        Frame frame;
        frame.camera = camera;
        frame.lights = {&light, 1};
        frame.objects = &objects;
        return Planner(options).plan(frame);
    }
    /// Metres along the view, of a pixel of a row.
    [[nodiscard]] double depthAt(std::uint32_t y) const
    {
        const double z = *depth.pixel(0, y);
        return kNear_m * kFar_m / (kNear_m + z * (kFar_m - kNear_m));
    }
    [[nodiscard]] ImageF shares(const Plan& plan) const { return viewShares({camera, depth, normals}, plan, 0, 0.5); }

    Camera camera;
    ImageF depth;
    ImageF normals;
    ObjectSet objects;
    Light light;
};

ShadowOptions cascades(double blend)
{
    ShadowOptions options{.technique = kPlainTechnique};
    options.technique.partition = Partition::cascades;
    options.cascades.count = 3;
    options.cascades.ends_m = {12.0, 20.0};
    options.cascades.blend = blend;
    return options;
}

TEST(ViewShares, OneMapServesAllOrNothing)
{
    const Ground ground;
    const ImageF shares = ground.shares(ground.plan({}));
    ASSERT_EQ(shares.channels, 1U);
    EXPECT_TRUE(std::all_of(shares.values.begin(), shares.values.end(), [](float s) { return s == 1.0F; }));
    Plan without = ground.plan({});
    without.lights[0].outcome.kind = OutcomeKind::no_caster;
    const ImageF none = ground.shares(without);
    EXPECT_TRUE(std::all_of(none.values.begin(), none.values.end(), [](float s) { return s == 0.0F; }));
}

TEST(ViewShares, SlicesFadeOverIntoEachOther)
{
    const Ground ground;
    const Plan plan = ground.plan(cascades(0.3));
    ASSERT_EQ(plan.views.size(), 3U);
    const ImageF shares = ground.shares(plan);
    int mixed = 0;
    for (std::uint32_t y = 0; y < kHeight_px; ++y) {
        const double depth_m = ground.depthAt(y);
        for (std::uint32_t x = 0; x < kWidth_px; ++x) {
            const float* const s = shares.pixel(x, y);
            EXPECT_NEAR(s[0] + s[1] + s[2], 1.0, 1e-6);
            const double first =
                1.0 - std::clamp((depth_m - plan.views[1].serves.slice.begin_m) / plan.views[1].serves.slice.blend_m,
                                 0.0, 1.0);
            EXPECT_NEAR(s[0], first, 1e-3) << depth_m;
            mixed += first > 0.0 && first < 1.0 ? 1 : 0;
            EXPECT_EQ(s[2] > 0.0F, depth_m > plan.views[2].serves.slice.begin_m);
        }
    }
    EXPECT_GT(mixed, 0);
}

TEST(ViewShares, WithoutABlendOneMapServesAPixel)
{
    const Ground ground;
    const ImageF shares = ground.shares(ground.plan(cascades(0.0)));
    for (std::uint32_t y = 0; y < kHeight_px; ++y) {
        const double depth_m = ground.depthAt(y);
        const std::uint32_t expected = depth_m < 12.0 ? 0 : depth_m < 20.0 ? 1 : 2;
        for (std::uint32_t i = 0; i < 3; ++i) {
            EXPECT_EQ(shares.pixel(5, y)[i], i == expected ? 1.0F : 0.0F) << depth_m;
        }
    }
}

TEST(ViewShares, ASunsTwoPositionsShareByTheirWeights)
{
    const Ground ground;
    Plan plan = ground.plan({});
    plan.views.push_back(plan.views[0]);
    plan.views[0].serves.sun = SunPosition::earlier;
    plan.views[1].serves.sun = SunPosition::later;
    plan.lights[0].view_count = 2;
    SunSteps& steps = plan.lights[0].steps;
    steps.stepping = steps.paired = true;
    steps.share = 0.25;
    steps.smooth = false;
    EXPECT_FLOAT_EQ(ground.shares(plan).pixel(3, 3)[1], 0.25F);
    EXPECT_FLOAT_EQ(ground.shares(plan).pixel(3, 3)[0], 0.75F);
    steps.smooth = true;
    EXPECT_FLOAT_EQ(ground.shares(plan).pixel(3, 3)[1], 0.15625F); // 3/16 - 2/64
    // A band whose right end is in the middle of the picture and which is a quarter of it wide.
    steps.smooth = false;
    steps.band = 0.25;
    steps.edge = 0.5;
    EXPECT_EQ(laterWeight(steps, 0.0), 1.0);
    EXPECT_EQ(laterWeight(steps, 0.25), 1.0);
    EXPECT_DOUBLE_EQ(laterWeight(steps, 0.375), 0.5);
    EXPECT_EQ(laterWeight(steps, 0.5), 0.0);
    const ImageF shares = ground.shares(plan);
    EXPECT_EQ(shares.pixel(0, 9)[1], 1.0F);
    EXPECT_EQ(shares.pixel(kWidth_px - 1, 9)[1], 0.0F);
    EXPECT_FLOAT_EQ(shares.pixel(11, 9)[1], static_cast<float>((0.5 - 11.5 / kWidth_px) / 0.25));
}

} // namespace
} // namespace gnomon::lab
