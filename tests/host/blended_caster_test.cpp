// SPDX-License-Identifier: Apache-2.0
// What a pane of coloured glass leaves of a light, in the mask.
#include "host/frame_renderer.h"
#include "scene/state.h"
#include "small_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::host::test {
namespace {

constexpr float kAlpha = 0.5F;
const glm::vec3 kTint{0.25F, 0.5F, 1.0F};

/// A level quad that faces up, from x = `left_m` to 4.
void addLevel(scene::Scene& scene, float left_m, float y, std::uint32_t material)
{
    scene::Primitive primitive;
    primitive.positions = {{left_m, y, -4}, {left_m, y, 4}, {4, y, 4}, {4, y, -4}};
    primitive.indices = {0, 1, 2, 0, 2, 3};
    primitive.material = material;
    addMesh(scene, std::move(primitive));
}

/// A ground under panes at these heights over its right half, a sun overhead and a spot light over its middle.
scene::Scene panes(const std::vector<float>& heights)
{
    scene::Scene scene;
    scene.materials.resize(2);
    scene.materials[1].alpha_mode = scene::AlphaMode::blend;
    scene.materials[1].double_sided = true;
    scene.materials[1].base_colour = glm::vec4(kTint, kAlpha);
    addLevel(scene, -4.0F, 0.0F, 0);
    for (const float height : heights) {
        addLevel(scene, 0.0F, height, 1);
    }
    scene.lights.resize(2);
    scene.lights[1].type = scene::LightType::spot;
    scene.lights[1].outer_cone_rad = 0.7F;
    scene.lights[1].range_m = 20.0F;
    for (std::uint32_t i = 0; i < 2; ++i) {
        scene::Node node;
        node.light = i;
        node.transform.translation = {0.0F, 7.0F, 0.0F};
        node.transform.rotation = glm::angleAxis(-1.5707964F, glm::vec3(1, 0, 0)); // -z becomes down
        scene.nodes.push_back(node);
    }
    finishScene(scene);
    return scene;
}

/// The mask of one light: left of the panes' edge, and right of it.
struct Sides {
    float free = 0.0F;
    float under = 0.0F;
};

/// Of sun and spot light, in the last of `frames` frames. `uses`: gets what memory that took.
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
        renderer.draw(state, {.position_ws = {0.0, 6.5, 0.01}, .target_ws = {0, 0, 0}}, lightsOf(scene, state));
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

ShadowOptions plainWith(Filter filter, Partition partition = Partition::single)
{
    ShadowOptions shadow{.technique = kPlainTechnique};
    shadow.technique.filter = filter;
    shadow.technique.partition = partition;
    shadow.map_size = 128;
    return shadow;
}

float luminance(const glm::vec3& light)
{
    return glm::dot(light, glm::vec3(0.2126F, 0.7152F, 0.0722F));
}

const glm::vec3 kThrough = 1.0F - kAlpha * (1.0F - kTint);
constexpr float kStep = 1.5F / 255.0F; // of a mask of 8 bits, with what 16 bits of a tint round away

TEST(BlendedCaster, TintsTheMaskOfEveryFilterAndPartition)
{
    Gpu gpu({.gpu = "software", .validate = true});
    const scene::Scene scene = panes({2.0F});
    std::vector<ShadowOptions> all;
    for (const Filter filter : {Filter::hard, Filter::pcf, Filter::pcss, Filter::raymarch, Filter::vsm, Filter::lvsm,
                                Filter::esm, Filter::evsm, Filter::msm}) {
        all.push_back(plainWith(filter));
    }
    all.push_back(plainWith(Filter::pcf, Partition::cascades));
    all.push_back(plainWith(Filter::pcf, Partition::sdsm));
    for (std::size_t i = 0; i < all.size(); ++i) {
        for (const Sides& sides : sidesOf(gpu, scene, all[i])) {
            EXPECT_NEAR(sides.free, 1.0F, kStep) << i;
            EXPECT_NEAR(sides.under, luminance(kThrough), kStep) << i;
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
        for (const Sides& sides : sidesOf(gpu, panes({2.0F}), shadow, 1, &uses)) {
            EXPECT_NEAR(sides.under, tints ? luminance(kThrough) : 1.0F, kStep);
        }
        EXPECT_EQ(usesTints(uses), tints);
    }
    EXPECT_EQ(gpu.messages(), std::vector<std::string>{});
}

TEST(BlendedCaster, PanesMultiplyColourByColour)
{
    Gpu gpu({.gpu = "software", .validate = true});
    for (const Sides& sides : sidesOf(gpu, panes({2.0F, 1.0F}), plainWith(Filter::pcf))) {
        EXPECT_NEAR(sides.free, 1.0F, kStep);
        EXPECT_NEAR(sides.under, luminance(kThrough * kThrough), kStep);
    }
    EXPECT_EQ(gpu.messages(), std::vector<std::string>{});
}

TEST(BlendedCaster, PaneBehindWhatItsLightReachesTintsNothing)
{
    Gpu gpu({.gpu = "software", .validate = true});
    for (const Sides& sides : sidesOf(gpu, panes({-1.0F}), plainWith(Filter::pcf))) {
        EXPECT_NEAR(sides.under, 1.0F, kStep);
    }
    EXPECT_EQ(gpu.messages(), std::vector<std::string>{});
}

TEST(BlendedCaster, TintsFromMapsThatAreKept)
{
    Gpu gpu({.gpu = "software", .validate = true});
    for (const Sides& sides : sidesOf(gpu, panes({2.0F}), plainWith(Filter::pcf), 3)) {
        EXPECT_NEAR(sides.under, luminance(kThrough), kStep);
    }
    EXPECT_EQ(gpu.messages(), std::vector<std::string>{});
}

TEST(BlendedCaster, DoesNotTintWhereItDoesNotCast)
{
    Gpu gpu({.gpu = "software", .validate = true});
    scene::Scene scene = panes({2.0F});
    scene.nodes[1].casts = false;
    finishScene(scene);
    for (const Sides& sides : sidesOf(gpu, scene, plainWith(Filter::pcf))) {
        EXPECT_NEAR(sides.under, 1.0F, kStep);
    }
}

} // namespace
} // namespace gnomon::host::test
