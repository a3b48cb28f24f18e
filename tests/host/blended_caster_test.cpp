// SPDX-License-Identifier: Apache-2.0
// The light that a pane of coloured glass leaves in the mask.
#include "host/frame_renderer.h"
#include "panes_scene.h"
#include "scene/state.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::host::test {
namespace {

/// The mask of one light: left of the panes' edge, and right of it.
struct Sides {
    float free = 0.0F;
    float under = 0.0F;
};

/// The sides by sun and spot light, in the last of `frames` frames. `uses` gets the memory that it took.
std::vector<Sides> sidesOf(Gpu& gpu, const scene::Scene& scene, const ShadowOptions& shadow, int frames = 1,
                           std::vector<vulkan::MemoryUse>* uses = nullptr)
{
    const scene::State state = scene::evaluate(scene, 0.0);
    RenderOptions options;
    options.width = 64;
    options.height = 48;
    options.shadow = shadow;
    const SceneOnGpu uploaded(gpu, scene, state);
    FrameRenderer renderer(uploaded, options);
    for (int frame = 0; frame < frames; ++frame) {
        renderer.draw(state, panesEye(), lightsOf(scene, state));
    }
    const Picture picture = renderer.read({.colour = false, .linear = false, .masks = true, .geometry = false});
    std::vector<Sides> sides;
    for (const ImageF& mask : picture.masks) {
        sides.push_back({mask.values[24 * 64 + 16], mask.values[24 * 64 + 48]});
    }
    if (uses != nullptr) {
        *uses = renderer.memory();
    }
    return sides;
}

constexpr float kStep = 1.5F / 255.0F; // of a mask of 8 bits, with what 16 bits of a tint round away

TEST(BlendedCaster, MayBeAllThatThereIs)
{
    Gpu gpu({.gpu = "software", .validate = true});
    scene::Scene scene = panes({Pane{2.0F}});
    scene.nodes.erase(scene.nodes.begin()); // the ground
    scene::finishScene(scene);
    for (const ShadowOptions& shadow : plainWithAll()) {
        for (const Sides& sides : sidesOf(gpu, scene, shadow)) {
            EXPECT_EQ(sides.free, 1.0F); // of the background
            EXPECT_EQ(sides.under, 1.0F);
        }
    }
    EXPECT_EQ(gpu.messages(), std::vector<std::string>{});
}

// Whose maps of tints are drawn by shaders of their own.
TEST(BlendedCaster, TintsTheMaskOfAParaboloid)
{
    Gpu gpu({.gpu = "software", .validate = true});
    scene::Scene scene = panes({Pane{2.0F}});
    for (scene::Light& light : scene.lights) {
        light.type = scene::LightType::point;
    }
    for (const MapFormat format : {MapFormat::d32f, MapFormat::r32f, MapFormat::rg16}) {
        ShadowOptions shadow = plainWith(Filter::pcf, Partition::paraboloid);
        shadow.format = format;
        for (const Sides& sides : sidesOf(gpu, scene, shadow)) {
            EXPECT_NEAR(sides.free, 1.0F, kStep);
            EXPECT_NEAR(sides.under, luminance(through()), kStep);
        }
    }
    EXPECT_EQ(gpu.messages(), std::vector<std::string>{});
}

bool usesTints(std::span<const vulkan::MemoryUse> uses)
{
    return std::ranges::any_of(
        uses, [](const vulkan::MemoryUse& use) { return std::string_view(use.purpose) == "maps of tints"; });
}

TEST(BlendedCaster, CastsNothingAndCostsNothingWithTranslucentNone)
{
    Gpu gpu({.gpu = "software", .validate = true});
    for (const Translucent translucent : {Translucent::none, Translucent::grey}) {
        ShadowOptions shadow = plainWith(Filter::pcf);
        shadow.translucent = translucent;
        std::vector<vulkan::MemoryUse> uses;
        const bool tints = translucent == Translucent::grey;
        for (const Sides& sides : sidesOf(gpu, panes({Pane{2.0F}}), shadow, 1, &uses)) {
            EXPECT_NEAR(sides.under, tints ? luminance(through()) : 1.0F, kStep);
        }
        EXPECT_EQ(usesTints(uses), tints);
    }
    EXPECT_EQ(gpu.messages(), std::vector<std::string>{});
}

// As exporters have it that call opaque things blended.
TEST(BlendedCaster, TakesWhatItCoversUnlessItIsStained)
{
    Gpu gpu({.gpu = "software", .validate = true});
    for (const float alpha : {kPaneAlpha, 1.0F}) {
        scene::Scene scene = panes({Pane{2.0F, glm::vec3(1.0F)}});
        scene.materials[1].base_colour.a = alpha;
        scene.materials[1].stained = false;
        for (const Translucent translucent : {Translucent::grey, Translucent::colour}) {
            ShadowOptions shadow = plainWith(Filter::pcf);
            shadow.translucent = translucent;
            for (const Sides& sides : sidesOf(gpu, scene, shadow)) {
                EXPECT_NEAR(sides.free, 1.0F, kStep);
                EXPECT_NEAR(sides.under, 1.0F - alpha, kStep);
            }
        }
    }
    EXPECT_EQ(gpu.messages(), std::vector<std::string>{});
}

TEST(BlendedCaster, DoesNotTintWhereItDoesNotCast)
{
    Gpu gpu({.gpu = "software", .validate = true});
    scene::Scene scene = panes({Pane{2.0F}});
    scene.nodes[1].casts = false;
    finishScene(scene);
    for (const Sides& sides : sidesOf(gpu, scene, plainWith(Filter::pcf))) {
        EXPECT_NEAR(sides.under, 1.0F, kStep);
    }
}

} // namespace
} // namespace gnomon::host::test
