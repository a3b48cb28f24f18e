// SPDX-License-Identifier: Apache-2.0
// A renderer that has lived through other options, lights, sizes and views of the camera's draws what a fresh one does,
// byte for byte: under the validation layers and without them, where a new view may have a destroyed one's handle.
#include "fixture.h"
#include "option_steps.h"
#include "planned_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace gnomon::test {
namespace {

constexpr std::array kOptions{"filter=pcf map-size=64 motion=snap keep-still=always",
                              "filter=pcf map-size=64 motion=snap keep-still=always",
                              "filter=hard partition=cascades map-size=64 map-format=r32f",
                              "filter=pcf partition=sdsm map-size=64",
                              "filter=evsm map-size=64 motion=snap",
                              "filter=lvsm lvsm.placement=uniform map-size=128",
                              "filter=pcf motion=step-band map-size=128"};
constexpr std::uint32_t kSteps = 21;

struct Step {
    std::uint32_t lights;
    VkExtent2D screen;
    bool normals;
    bool ids;
};

// Sizes stay for some steps, so that a new view of the same size is among them.
Step stepAt(std::uint32_t i)
{
    constexpr std::array<std::uint32_t, 5> kLights{1, 2, 5, 1, 3};
    constexpr std::array<VkExtent2D, 3> kScreens{{{64, 40}, {40, 64}, {64, 40}}};
    return {kLights[i % kLights.size()], kScreens[i / 4 % kScreens.size()], i % 3 != 2, i % 4 == 3};
}

void expectWhatAFreshOneDraws(Gpu& device)
{
    PlannedScene scene(device, stepAt(0).screen);
    Drawing lasting(device, scene.mesh());
    std::optional<Planner> planner;
    const char* planned_by = "";
    for (std::uint32_t i = 0; i < kSteps; ++i) {
        const Step step = stepAt(i);
        const char* const options = kOptions[i * kOptions.size() / kSteps];
        if (options != std::string_view(planned_by)) {
            planner.emplace(optionsFrom(options));
            planned_by = options;
        }
        const std::vector<Light> lights = sunsAndSpots(step.lights);
        Frame frame;
        const Plan* plan = nullptr;
        std::vector<std::byte> mask;
        for (std::uint32_t k = 0; k < 3;
             ++k) { // from the first to the last nothing but the views changes in their slot
            scene.remakeViews(step.screen, step.normals, step.ids);
            frame = scene.frameOf(lights);
            frame.index = 3 * i + k;
            plan = &planner->plan(frame);
            mask = scene.draw(lasting, *plan, k % 2);
        }
        Drawing fresh(device, scene.mesh());
        EXPECT_EQ(mask, scene.draw(fresh, *plan)) << "step " << i << ", " << options;
        EXPECT_GT(std::ranges::count(mask, std::byte{0}), 20) << "no shadow in step " << i;
        EXPECT_GT(std::ranges::count(mask, std::byte{255}), 20) << "no light in step " << i;
    }
}

TEST(FreshRenderer, drawsWhatOneDoesThatHasSeenOtherViewsAndOptionsUnderLayers)
{
    expectWhatAFreshOneDraws(gpu());
    expectSilence(gpu());
}

TEST(FreshRenderer, drawsWhatOneDoesThatHasSeenOtherViewsAndOptionsWithoutLayers)
{
    Gpu bare(false);
    expectWhatAFreshOneDraws(bare);
}

// One light's channel of all pixels.
std::vector<std::byte> channelOf(const std::vector<std::byte>& mask, std::size_t pixels, const LightPlan& light)
{
    std::vector<std::byte> channel;
    for (std::size_t i = 0; i < pixels; ++i) {
        channel.push_back(mask[(light.mask_layer * pixels + i) * 4 + light.mask_channel]);
    }
    return channel;
}

TEST(SeveralOptions, giveEachLightWhatItsOwnGiveAlone)
{
    constexpr VkExtent2D kScreen{64, 40};
    const std::vector<ShadowOptions> options{
        optionsFrom("filter=hard map-size=64"), optionsFrom("filter=pcf map-size=128"),
        optionsFrom("filter=evsm map-size=64"), optionsFrom("filter=lvsm map-size=128")};
    std::vector<Light> lights = sunsAndSpots(7);
    constexpr std::array<std::uint32_t, 7> kOptionsOf{0, 1, 2, 3, 3, 0, 1}; // all four in the first layer
    for (std::size_t i = 0; i < lights.size(); ++i) {
        lights[i].options = kOptionsOf[i];
    }
    PlannedScene scene(gpu(), kScreen);
    const Frame together = scene.frameOf(lights);
    Planner planner(options);
    const Plan& plan = planner.plan(together);
    Drawing drawing(gpu(), scene.mesh());
    const std::vector<std::byte> mask = scene.draw(drawing, plan);
    for (std::size_t i = 0; i < lights.size(); ++i) {
        Light light = lights[i];
        light.options = 0;
        const Frame alone = scene.frameOf({&light, 1});
        Planner own(options[kOptionsOf[i]]);
        Drawing one(gpu(), scene.mesh());
        const auto channel = channelOf(mask, std::size_t{kScreen.width} * kScreen.height, plan.lights[i]);
        EXPECT_EQ(channel, scene.draw(one, own.plan(alone))) << "light " << i;
        EXPECT_GT(std::ranges::count_if(channel, [](std::byte v) { return v != std::byte{255}; }), 20) << i;
    }
    expectSilence(gpu());
}

} // namespace
} // namespace gnomon::test
