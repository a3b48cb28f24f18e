// SPDX-License-Identifier: Apache-2.0
// Colours of vertices are coverage as a texture's are: a surface that is clear in its vertices has the picture and the
// shadow of one that is clear in its texture.
#include "host/frame_renderer.h"
#include "scene/state.h"
#include "small_scene.h"

#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gnomon::host::test {
namespace {

constexpr float kHeight_m = 2.0F; // of the card
const glm::vec4 kGlass{0.25F, 0.5F, 1.0F, 0.5F};
enum : std::uint32_t { kSun, kSpot, kPoint };
enum class ClearBy { vertices, texture, nothing };

/// From x = -2 to 2, in two halves that share no vertex; each has one place of the texture, so that no filter blends.
scene::Primitive card(ClearBy what, const glm::vec4& colour)
{
    scene::Primitive primitive;
    for (const float left : {-2.0F, 0.0F}) {
        const auto first = static_cast<std::uint32_t>(primitive.positions.size());
        for (const glm::vec3& p : {glm::vec3(left, kHeight_m, -2), glm::vec3(left, kHeight_m, 2),
                                   glm::vec3(left + 2.0F, kHeight_m, 2), glm::vec3(left + 2.0F, kHeight_m, -2)}) {
            primitive.positions.push_back(p);
            primitive.uv0.emplace_back(left < 0.0F ? 0.25F : 0.75F, 0.5F);
            if (what == ClearBy::vertices) {
                primitive.colours.push_back(left < 0.0F ? colour : glm::vec4(0.0F));
            }
        }
        for (const std::uint32_t i : {0U, 1U, 2U, 0U, 2U, 3U}) {
            primitive.indices.push_back(first + i);
        }
    }
    primitive.material = 1;
    return primitive;
}

scene::Primitive ground()
{
    scene::Primitive primitive;
    primitive.positions = {{-5, 0, -5}, {-5, 0, 5}, {5, 0, 5}, {5, 0, -5}};
    primitive.indices = {0, 1, 2, 0, 2, 3};
    primitive.material = 0;
    return primitive;
}

void addLight(scene::Scene& scene, scene::LightType type, float intensity)
{
    scene::Light light;
    light.type = type;
    light.intensity = intensity;
    light.outer_cone_rad = 0.7F;
    light.range_m = 20.0F;
    scene::Node node;
    node.light = static_cast<std::uint32_t>(scene.lights.size());
    node.transform.translation = {0.5F, 7.0F, 0.5F};
    node.transform.rotation = glm::angleAxis(-1.3F, glm::vec3(1, 0, 0)); // -z becomes down, nearly
    scene.lights.push_back(light);
    scene.nodes.push_back(node);
}

scene::Scene sceneOf(ClearBy what, scene::AlphaMode mode)
{
    scene::Scene scene;
    scene.images = {{"half", 2, 1, {255, 255, 255, 255, 255, 255, 255, 0}}};
    scene.textures = {scene::Texture{.image = 0}};
    scene.materials.resize(2);
    scene::Material& material = scene.materials[1];
    material.alpha_mode = mode;
    material.stained = mode == scene::AlphaMode::blend;
    material.double_sided = true;
    const bool blends = mode == scene::AlphaMode::blend;
    const glm::vec4 colour = blends ? kGlass : glm::vec4(1.0F, 1.0F, 1.0F, 0.75F);
    if (what != ClearBy::vertices) {
        material.base_colour = colour;
    }
    if (what == ClearBy::texture) {
        material.base_colour_texture.texture = 0;
    }
    addMesh(scene, ground());
    addMesh(scene, card(what, colour));
    addLight(scene, scene::LightType::directional, 3.0F);
    addLight(scene, scene::LightType::spot, 300.0F);
    addLight(scene, scene::LightType::point, 300.0F);
    finishScene(scene);
    return scene;
}

Picture drawn(Gpu& gpu, ClearBy what, scene::AlphaMode mode, const ShadowOptions& shadow, std::uint32_t light)
{
    const scene::Scene scene = sceneOf(what, mode);
    const scene::State state = scene::evaluate(scene, 0.0);
    RenderOptions options;
    options.width = 96;
    options.height = 72;
    options.shadow = shadow;
    const SceneOnGpu uploaded(gpu, scene, state);
    FrameRenderer renderer(uploaded, options);
    const std::vector<ShadedLight> lights = lightsOf(scene, state);
    // From beside the card, so that its shadow and some of it are seen.
    renderer.draw(state, {.position_ws = {0.0, 5.0, 7.0}, .target_ws = {0.0, 0.5, 0.0}}, {lights[light]});
    return renderer.read({.colour = false, .linear = true, .masks = true, .geometry = false});
}

struct ColourCase {
    std::uint32_t light = kSun;
    Filter filter = Filter::pcf;
    Partition partition = Partition::single;
    std::optional<MapFormat> format;
    CascadePass pass = CascadePass::automatic;
    CasterFaces faces = CasterFaces::nearest;
};
std::ostream& operator<<(std::ostream& out, const ColourCase& one)
{
    return out << nameOf(one.filter) << " " << nameOf(one.partition) << " of light " << one.light;
}

class VertexAlpha : public testing::TestWithParam<ColourCase> {
protected:
    void TearDown() override { EXPECT_EQ(gpu_.messages(), std::vector<std::string>{}); }
    void expectAsByTexture(scene::AlphaMode mode)
    {
        const ColourCase one = GetParam();
        ShadowOptions shadow{.technique = kPlainTechnique};
        shadow.technique.filter = one.filter;
        shadow.technique.partition = one.partition;
        shadow.format = one.format;
        shadow.cascades.pass = one.pass;
        shadow.faces = one.faces;
        shadow.map_size = 256;
        shadow.translucent = Translucent::colour;
        const Picture expected = drawn(gpu_, ClearBy::texture, mode, shadow, one.light);
        const Picture found = drawn(gpu_, ClearBy::vertices, mode, shadow, one.light);
        EXPECT_EQ(differing(found.masks.at(0), expected.masks.at(0), 0.01F), 0U);
        EXPECT_EQ(differing(found.linear, expected.linear, 0.01F), 0U);
        const Picture whole = drawn(gpu_, ClearBy::nothing, mode, shadow, one.light);
        EXPECT_GT(differing(whole.masks.at(0), expected.masks.at(0), 0.1F), 200U) << "the clear half counts";
    }

    Gpu gpu_{{.gpu = "software", .validate = true}};
};

TEST_P(VertexAlpha, OfMaskedCastersIsAsATexturesAlpha)
{
    expectAsByTexture(scene::AlphaMode::mask);
}

TEST_P(VertexAlpha, OfBlendedCastersIsAsATexturesAlpha)
{
    expectAsByTexture(scene::AlphaMode::blend);
}

// One of each kind of pass that casters are drawn in.
INSTANTIATE_TEST_SUITE_P(
    Passes, VertexAlpha,
    testing::Values(ColourCase{kSun, Filter::hard}, ColourCase{kSpot, Filter::hard},
                    ColourCase{.light = kSun, .format = MapFormat::r32f},
                    ColourCase{.light = kSpot, .format = MapFormat::r32f}, ColourCase{kSun, Filter::raymarch},
                    ColourCase{.light = kSun, .filter = Filter::vsm}, ColourCase{.light = kSpot, .filter = Filter::vsm},
                    ColourCase{.light = kSun, .filter = Filter::depth_id},
                    ColourCase{.light = kSpot, .filter = Filter::depth_id},
                    ColourCase{.partition = Partition::cascades, .pass = CascadePass::layered},
                    ColourCase{.partition = Partition::sdsm},
                    ColourCase{.partition = Partition::sdsm, .pass = CascadePass::layered},
                    ColourCase{.light = kPoint, .partition = Partition::cube},
                    ColourCase{.light = kPoint, .partition = Partition::paraboloid},
                    ColourCase{.light = kPoint, .partition = Partition::paraboloid, .format = MapFormat::r32f},
                    ColourCase{.light = kSun, .faces = CasterFaces::midpoint},
                    ColourCase{.light = kSpot, .faces = CasterFaces::midpoint}));

} // namespace
} // namespace gnomon::host::test
