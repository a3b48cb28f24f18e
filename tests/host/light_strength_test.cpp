// SPDX-License-Identifier: Apache-2.0
// A light's strength and the sky change with the time; a light that is out adds nothing and has no map.
#include "host/frame_renderer.h"
#include "scene/state.h"

#include "small_scene.h"

#include <gtest/gtest.h>

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace gnomon::host::test {
namespace {

constexpr double kDay = 1.0;
constexpr double kNight = 2.0; // the sun is out, and nothing else has changed
constexpr double kDim = 3.0;   // half the sun

/// The small scene without a sky, so that all light is the lights'.
scene::Scene lampScene()
{
    scene::Scene scene = smallScene();
    scene.procedural = nullptr;
    scene.environment.ambient = 0.0F;
    scene.daylight = [](double time_s, std::span<glm::vec3> strengths, scene::Environment& environment) {
        strengths[0] *= time_s == kNight ? 0.0F : (time_s == kDim ? 0.5F : 1.0F);
        environment.sky_horizon = glm::vec3(0.0F, 0.0F, time_s == kDay ? 0.5F : 0.25F);
    };
    return scene;
}

class LightStrength : public testing::Test {
protected:
    LightStrength()
    {
        RenderOptions options;
        options.width = 128;
        options.height = 96;
        options.shadow.map_size = 256;
        renderer_ = std::make_unique<FrameRenderer>(uploaded_, options);
    }
    Picture draw(double time_s, const std::vector<ShadedLight>* lights = nullptr)
    {
        scene::advance(scene_, time_s, state_);
        renderer_->draw(state_, smallEye(), lights != nullptr ? *lights : lightsOf(scene_, state_));
        return renderer_->read({.linear = true, .masks = true});
    }
    void TearDown() override { EXPECT_EQ(gpu_.messages(), std::vector<std::string>{}); }

    Gpu gpu_{{.gpu = "software", .validate = true}};
    scene::Scene scene_ = lampScene();
    scene::State state_ = scene::evaluate(scene_, kDay);
    SceneOnGpu uploaded_{gpu_, scene_, state_};
    std::unique_ptr<FrameRenderer> renderer_;
};

double sumOf(const ImageF& image)
{
    double sum = 0.0;
    for (const float v : image.values) {
        sum += v;
    }
    return sum;
}

TEST_F(LightStrength, ZeroAddsNothingAndPlansNoMap)
{
    draw(kDay);
    ASSERT_TRUE(renderer_->plan().lights[0].outcome.hasMap());
    ASSERT_TRUE(renderer_->plan().lights[1].outcome.hasMap());
    const Picture night = draw(kNight);
    ASSERT_EQ(renderer_->plan().lights.size(), 2U);
    EXPECT_EQ(renderer_->plan().lights[0].outcome.kind, OutcomeKind::no_shadow_wanted);
    EXPECT_TRUE(renderer_->plan().lights[1].outcome.hasMap());
    EXPECT_EQ(renderer_->plan().views.size(), 1U);
    EXPECT_EQ(sumOf(night.masks[0]), 128.0 * 96.0); // all 1, as where no light has a map
    // The same picture as with a black sun.
    std::vector<ShadedLight> black = lightsOf(scene_, state_);
    const double with_strength = sumOf(night.linear);
    black[0].strength = glm::vec3(1.0F);
    const Picture lit = draw(kNight, &black);
    EXPECT_GT(sumOf(lit.linear), 1.1 * with_strength); // what the strength took away
    EXPECT_GT(with_strength, 0.0);                     // the spot light is as bright as ever
}

TEST_F(LightStrength, ScalesTheLightButNotTheExposure)
{
    const double day = sumOf(draw(kDim).linear);
    const double none = sumOf(draw(kNight).linear);
    std::vector<ShadedLight> full = lightsOf(scene_, state_);
    full[0].strength = glm::vec3(1.0F);
    full[0].caster.casts_shadow = true;
    const double all = sumOf(draw(kNight, &full).linear);
    ASSERT_GT(all, none);
    EXPECT_NEAR((day - none) / (all - none), 0.5, 1e-3);
}

TEST_F(LightStrength, SkyIsTheStates)
{
    // The picture's upper corner is sky, at the horizon.
    const Picture day = draw(kDay);
    const Picture night = draw(kNight);
    EXPECT_GT(day.linear.values[2], night.linear.values[2]);
}

} // namespace
} // namespace gnomon::host::test
