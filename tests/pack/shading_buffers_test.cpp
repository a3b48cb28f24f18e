// SPDX-License-Identifier: Apache-2.0
#include "plan_by_hand.h"

#include <gnomon/error.h>
#include <gnomon/pack/mask_draws.h>
#include <gnomon/pack/shading_buffers.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

namespace gnomon::test {
namespace {

constexpr glm::dvec3 kFarAway{3.0e6, 50.0, -7.0e6};

Camera cameraAt(const glm::dvec3& eye)
{
    const glm::dmat4 clip_from_view = glm::perspectiveRH_ZO(0.9, 1.6, 500.0, 0.1);
    return {eye, clip_from_view * glm::lookAtRH(eye, eye + glm::dvec3(0.0, -1.0, -2.0), glm::dvec3(0.0, 1.0, 0.0))};
}

TEST(ShadingBuffers, TakeAPointToItsTexelHoweverFarFromTheOrigin)
{
    PlanByHand by_hand({ShadowOptions{.technique = kPlainTechnique}});
    by_hand.add(0, 1);
    by_hand.plan.made_for.camera = cameraAt(kFarAway);
    View& view = by_hand.plan.views[0];
    view.place.tile = {2, 64, 32, 256, 128};
    view.projection.clip_from_world =
        glm::orthoRH_ZO(-20.0, 20.0, -10.0, 10.0, 0.0, 100.0) *
        glm::lookAtRH(kFarAway, kFarAway - glm::dvec3(0.0, 1.0, 0.0), glm::dvec3(0.0, 0.0, -1.0));
    std::vector<shared::GpuView> views(1);
    const pack::MapImage image{{1024, 1024}, 1};
    pack::fillViews(by_hand.plan, {&image, 1}, views);
    const glm::dvec3 from_eye(3.0, -8.0, -5.0);
    const glm::dvec4 clip = view.projection.clip_from_world * glm::dvec4(kFarAway + from_eye, 1.0);
    const glm::vec4 point(glm::vec3(from_eye), 1.0F);
    EXPECT_NEAR(glm::dot(views[0].x, point), 64.0 + (0.5 * clip.x + 0.5) * 256.0, 1e-3);
    EXPECT_NEAR(glm::dot(views[0].y, point), 32.0 + (0.5 * clip.y + 0.5) * 128.0, 1e-3);
    EXPECT_EQ(views[0].scale.z, 2.0F) << "layer";
    EXPECT_GT(views[0].tile.x, 64.0F) << "the kernel's reach is taken off";
    EXPECT_EQ(views[0].whole.x, 64.0F);
}

TEST(ShadingBuffers, WhatIsBeyondThePlansViewsServesNoDepth)
{
    PlanByHand by_hand({ShadowOptions{.technique = kPlainTechnique}});
    by_hand.add(0, 2);
    std::vector<shared::GpuView> views(shared::kFewViews + 2);
    views.back().slice = glm::vec4(7.0F);
    const pack::MapImage image{{256, 256}, 1};
    pack::fillViews(by_hand.plan, {&image, 1}, views);
    for (std::size_t i = 0; i < shared::kFewViews; ++i) {
        EXPECT_EQ(views[i].slice.x <= views[i].slice.y, i < 2) << i;
    }
    EXPECT_EQ(views.back().slice, glm::vec4(7.0F)) << "no shader looks there";
}

TEST(ShadingBuffers, ConstantsAreThoseOfTheOptionsAskedFor)
{
    ShadowOptions fading = filteredBy(Filter::esm);
    fading.max_distance_m = 50.0;
    fading.fade = 0.2;
    PlanByHand by_hand({ShadowOptions{.technique = kPlainTechnique}, fading});
    by_hand.plan.made_for.camera = cameraAt({0.0, 2.0, 0.0});
    shared::GpuConstants first{};
    shared::GpuConstants second{};
    pack::fillConstants(by_hand.plan, 0, {320, 200}, {{512, 256}, 1}, {}, first);
    pack::fillConstants(by_hand.plan, 1, {320, 200}, {{128, 64}, 3}, {}, second);
    EXPECT_EQ(first.rule.reading.x, static_cast<int>(Filter::pcf));
    EXPECT_EQ(first.screen.fade, glm::vec4(0.0F)) << "nothing fades";
    EXPECT_EQ(first.rule.disc.z, 1.0F / 512.0F);
    EXPECT_EQ(second.rule.reading.x, static_cast<int>(Filter::esm));
    EXPECT_FLOAT_EQ(second.screen.fade.x, 40.0F);
    EXPECT_FLOAT_EQ(second.screen.fade.y, 0.1F);
    EXPECT_EQ(second.rule.disc.w, 1.0F / 64.0F);
    EXPECT_EQ(second.screen.size, glm::vec4(320.0F, 200.0F, 1.0F / 320.0F, 1.0F / 200.0F));
}

TEST(ShadingBuffers, TakeEveryPrecisionThatADeviceMayHave)
{
    PlanByHand by_hand({ShadowOptions{.technique = kPlainTechnique}});
    float before = 1.0F;
    for (const std::uint32_t bits : {4U, 8U, 24U}) {
        pack::DrawPrecision precision{.sub_pixel_bits = bits};
        precision.normal_error_rad = pack::normalErrorFromDepth(bits);
        shared::GpuConstants constants{};
        pack::fillConstants(by_hand.plan, 0, {320, 200}, {{512, 256}, 1}, precision, constants);
        EXPECT_LT(constants.rule.bias.w, before) << bits;
        before = constants.rule.bias.w;
    }
}

TEST(ShadingBuffers, LightsWithoutAMapHaveNoViews)
{
    PlanByHand by_hand({ShadowOptions{.technique = kPlainTechnique}, filteredBy(Filter::vsm)});
    by_hand.add(0, 1);
    by_hand.add(1, 0);
    by_hand.add(1, 3);
    std::vector<shared::GpuLight> lights(4);
    lights[3].views = glm::uvec4(9);
    pack::fillLights(by_hand.plan, lights);
    EXPECT_EQ(lights[0].views, glm::uvec4(0, 1, 0, 0));
    EXPECT_EQ(lights[1].views, glm::uvec4(0));
    EXPECT_EQ(lights[2].views, glm::uvec4(1, 3, 0, 0));
    EXPECT_EQ(lights[2].options.x, 1U);
    EXPECT_EQ(lights[3].views, glm::uvec4(0)) << "beyond the frame's";
    EXPECT_EQ(lights[0].place, glm::vec4(0.0F, 1.0F, 0.0F, 0.0F)) << "towards a sun";
}

// The views of the other position have moved on; what their maps hold has not.
TEST(ShadingBuffers, ByTurnsTheMapsThatAreDrawnAreReadAlone)
{
    PlanByHand by_hand({ShadowOptions{.technique = kPlainTechnique}});
    LightPlan& light = by_hand.add(0, 2);
    by_hand.plan.views[0].serves.sun = SunPosition::earlier;
    by_hand.plan.views[1].serves.sun = SunPosition::later;
    light.steps.paired = true;
    std::vector<shared::GpuLight> lights(1);
    pack::fillLights(by_hand.plan, lights);
    EXPECT_EQ(lights[0].views, glm::uvec4(0, 1, 1, 1));
    light.steps.alternate = true;
    light.steps.read = SunPosition::later;
    pack::fillLights(by_hand.plan, lights);
    EXPECT_EQ(lights[0].views, glm::uvec4(1, 1, 0, 0));
}

TEST(ShadingBuffers, WhatIsNotThereOrHasNoRoomIsAnError)
{
    PlanByHand by_hand({ShadowOptions{.technique = kPlainTechnique}});
    by_hand.add(0, 2);
    const Plan& plan = by_hand.plan;
    const pack::MapImage image{{256, 256}, 1};
    shared::GpuConstants constants{};
    EXPECT_THROW(pack::fillConstants(plan, 1, {320, 200}, image, {}, constants), Error);
    EXPECT_THROW(pack::fillConstants(plan, 0, {320, 0}, image, {}, constants), Error);
    EXPECT_THROW(pack::fillConstants(plan, 0, {320, 200}, {{0, 256}, 1}, {}, constants), Error);
    EXPECT_THROW(pack::fillConstants(Plan(), 0, {320, 200}, image, {}, constants), Error);
    std::vector<shared::GpuView> views(1);
    EXPECT_THROW(pack::fillViews(plan, {&image, 1}, views), Error);
    EXPECT_THROW(pack::fillViews(plan, {}, std::span(views)), Error);
    std::vector<shared::GpuLight> lights;
    EXPECT_THROW(pack::fillLights(plan, lights), Error);
    lights.resize(shared::kLightsPerLayer);
    pack::MaskDraw draw;
    draw.first_light = 1;
    EXPECT_THROW(pack::fillMaskLights(plan, {&draw, 1}, lights), Error);
    Plan unknown = plan; // it does not say what its lights are
    unknown.made_for.lights.clear();
    EXPECT_THROW(pack::fillMaskLights(unknown, {}, lights), Error);
    EXPECT_THROW(pack::fillLights(unknown, lights), Error);
}

} // namespace
} // namespace gnomon::test
