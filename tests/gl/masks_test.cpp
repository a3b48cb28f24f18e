// SPDX-License-Identifier: Apache-2.0
// Masks by OpenGL against those by the Vulkan backend, of the same plan and the same depths: by filters, lights and
// partitions.
#include "beyond_edges.h"
#include "gl_scene.h"
#include "option_steps.h"
#include "planned_scene.h"

#include <gnomon/plan_views.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <string>

namespace gnomon::test {
namespace {

constexpr VkExtent2D kScreen{160, 90};

struct MaskCase {
    const char* name;
    const char* options;
    const char* lights; // sun, spot, lamp: one each
    bool exact = false; // no pixel is off by more than one step
};

void PrintTo(const MaskCase& one, std::ostream* out)
{
    *out << one.lights << ' ' << one.options;
}

Light lightCalled(const std::string& name)
{
    if (name == "sun") {
        return makeSun({0.5, -1.0, 0.2});
    }
    Light light = makeSpot({4.0, 8.0, 2.0}, {0.0, 0.0, 0.0}, 0.5);
    if (name == "lamp") {
        light = {};
        light.type = LightType::point;
        light.position_ws = {0.5, 3.5, 2.5};
        light.range_m = 25.0;
    }
    light.radius_m = 0.2;
    return light;
}

std::vector<Light> lightsOf(const std::string& names)
{
    std::vector<Light> lights;
    for (std::size_t at = 0; at < names.size();) {
        const std::size_t end = std::min(names.find(' ', at), names.size());
        lights.push_back(lightCalled(names.substr(at, end - at)));
        lights.back().key = static_cast<std::uint32_t>(lights.size());
        at = end + 1;
    }
    return lights;
}

/// The Vulkan side, which compiles each of its pipelines once.
struct VulkanSide {
    PlannedScene scene{gpu(), kScreen};
    Drawing drawing{gpu(), scene.mesh()};
};
VulkanSide& vulkanSide()
{
    static VulkanSide side;
    return side;
}

struct GlSide {
    GlScene scene{makeScene()};
    gl::ShadowRenderer renderer{{EglContext::function, {}}};
};
GlSide& glSide()
{
    static GlSide side;
    return side;
}

ImageF channelOf(const std::vector<std::byte>& mask, std::size_t channels, std::size_t layer, std::size_t channel)
{
    ImageF image(kScreen.width, kScreen.height, 1);
    const std::size_t pixels = std::size_t{kScreen.width} * kScreen.height;
    for (std::size_t i = 0; i < pixels; ++i) {
        const std::byte texel = mask[(layer * pixels + i) * channels + channel];
        image.pixel(static_cast<std::uint32_t>(i % kScreen.width),
                    static_cast<std::uint32_t>(i / kScreen.width))[0] = std::to_integer<std::uint8_t>(texel) / 255.0F;
    }
    return image;
}

class GlMasks : public testing::TestWithParam<MaskCase> {};

TEST_P(GlMasks, areThoseOfTheVulkanBackend)
{
    GNOMON_NEEDS_EGL();
    const MaskCase& one = GetParam();
    VulkanSide& vulkan = vulkanSide();
    GlSide& by_gl = glSide();
    const std::vector<Light> lights = lightsOf(one.lights);
    const Frame frame = vulkan.scene.frameOf(lights);
    Planner planner(optionsFrom(one.options));
    const Plan plan = planner.plan(frame);
    for (const LightPlan& light : plan.lights) {
        ASSERT_TRUE(light.outcome.hasMap()) << light.outcome.reason;
    }
    const std::vector<std::byte> wanted = vulkan.scene.draw(vulkan.drawing, plan);

    const gl::MaskInputs inputs = by_gl.scene.upload(tracePicture(by_gl.scene.scene, frame.camera, kScreen));
    (void)by_gl.renderer.prepare(plan, inputs.size_px);
    by_gl.renderer.drawMaps(plan, by_gl.scene.callback());
    by_gl.renderer.drawMask(plan, inputs);
    const gl::TextureRef mask = by_gl.renderer.mask();
    const std::vector<std::byte> drawn = GlScene::read(mask, plan.mask_layers);
    EglContext::instance().expectSilence();

    ASSERT_EQ(drawn.size(), wanted.size());
    int farthest = 0;
    for (std::size_t i = 0; i < drawn.size(); ++i) {
        farthest = std::max(farthest, std::abs(std::to_integer<int>(drawn[i]) - std::to_integer<int>(wanted[i])));
    }
    std::size_t beyond = 0;
    const std::size_t channels = maskChannelCount(plan);
    for (const LightPlan& light : plan.lights) {
        const ImageF reference = channelOf(wanted, channels, light.mask_layer, light.mask_channel);
        beyond += countBeyondEdges(channelOf(drawn, channels, light.mask_layer, light.mask_channel), reference);
        const auto [least, most] = std::minmax_element(reference.values.begin(), reference.values.end());
        EXPECT_LT(*least, 0.5F) << "there is no shadow to compare";
        EXPECT_GT(*most, 0.5F) << "there is no light to compare";
    }
    RecordProperty("farthest", farthest);
    std::printf("%-28s farthest %d of 255, %zu beyond edges\n", one.name, farthest, beyond);
    EXPECT_EQ(beyond, 0U);
    if (one.exact) {
        EXPECT_LE(farthest, 1);
    }
}

#define CASES(FILTER, OPTIONS, EXACT)                                                                                  \
    MaskCase{FILTER "_sun", "map-size=256 partition=single filter=" OPTIONS, "sun", EXACT},                            \
        MaskCase{FILTER "_cascades", "map-size=256 partition=cascades filter=" OPTIONS, "sun", EXACT},                 \
        MaskCase{FILTER "_spot", "map-size=256 partition=single filter=" OPTIONS, "spot", EXACT},                      \
        MaskCase{FILTER "_cube", "map-size=256 partition=cube filter=" OPTIONS, "lamp", EXACT},                        \
        MaskCase                                                                                                       \
    {                                                                                                                  \
        FILTER "_multi", "map-size=256 partition=multi filter=" OPTIONS, "lamp", EXACT                                 \
    }

std::string nameOf(const testing::TestParamInfo<MaskCase>& one)
{
    return one.param.name;
}

INSTANTIATE_TEST_SUITE_P(Depth, GlMasks,
                         testing::Values(CASES("hard", "hard", true), CASES("pcf", "pcf", true),
                                         CASES("pcss", "pcss", false), CASES("raymarch", "raymarch", false)),
                         nameOf);
INSTANTIATE_TEST_SUITE_P(Filterable, GlMasks,
                         testing::Values(CASES("vsm", "vsm", false), CASES("lvsm", "lvsm", false),
                                         CASES("esm", "esm", false), CASES("evsm", "evsm", false),
                                         CASES("msm", "msm", false)),
                         nameOf);

} // namespace
} // namespace gnomon::test
