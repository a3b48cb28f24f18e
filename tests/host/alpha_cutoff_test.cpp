// SPDX-License-Identifier: Apache-2.0
// Alpha that is equal to the cutoff is solid, in the picture and in maps, wherever it comes from.
#include "host/frame_renderer.h"
#include "scene/state.h"
#include "small_scene.h"

#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::host::test {
namespace {

struct Alpha {
    float cutoff = 0.5F;
    float factor = 1.0F;
    float of_vertices = 1.0F;
    std::uint8_t of_texture = 255;
};
std::ostream& operator<<(std::ostream& out, const Alpha& one)
{
    return out << "cutoff " << one.cutoff << ", factor " << one.factor << ", vertices " << one.of_vertices
               << ", texture " << int{one.of_texture};
}

scene::Primitive level(float half_m, float height_m, std::uint32_t material)
{
    scene::Primitive primitive;
    // Turned and uneven, so that weights of the three corners are no round numbers.
    primitive.positions = {{-half_m, height_m, -0.7F * half_m},
                           {-0.6F * half_m, height_m, half_m},
                           {half_m, height_m, 0.8F * half_m},
                           {0.7F * half_m, height_m, -half_m}};
    primitive.uv0 = {{0.1F, 0.2F}, {0.3F, 5.3F}, {7.1F, 6.4F}, {6.2F, 0.3F}};
    primitive.indices = {0, 1, 2, 0, 2, 3};
    primitive.material = material;
    return primitive;
}

scene::Scene sceneOf(const Alpha& alpha, scene::AlphaMode mode)
{
    scene::Scene scene;
    const std::uint8_t a = alpha.of_texture;
    scene.images = {{"even", 2, 2, {255, 255, 255, a, 255, 255, 255, a, 255, 255, 255, a, 255, 255, 255, a}}};
    scene.textures = {scene::Texture{.image = 0}};
    scene.materials.resize(2);
    scene::Material& card = scene.materials[1];
    card.alpha_mode = mode;
    card.alpha_cutoff = alpha.cutoff;
    card.base_colour.a = alpha.factor;
    card.base_colour_texture.texture = a != 255 ? 0 : scene::kNone;
    card.double_sided = true;
    addMesh(scene, level(6.0F, 0.0F, 0));
    scene::Primitive primitive = level(2.0F, 2.0F, 1);
    primitive.colours.assign(4, glm::vec4(1.0F, 1.0F, 1.0F, alpha.of_vertices));
    addMesh(scene, std::move(primitive));
    scene.lights.resize(2);
    scene.lights[1].type = scene::LightType::spot;
    scene.lights[1].outer_cone_rad = 0.7F;
    scene.lights[1].intensity = 300.0F;
    for (std::uint32_t light = 0; light < 2; ++light) {
        scene::Node node;
        node.light = light;
        node.transform.translation = {0.5F, 7.0F, 0.5F};
        node.transform.rotation = glm::angleAxis(-1.3F, glm::vec3(1, 0, 0)); // -z becomes down, nearly
        scene.nodes.push_back(node);
    }
    finishScene(scene);
    return scene;
}

class AlphaCutoff : public testing::TestWithParam<Alpha> {
protected:
    void TearDown() override { EXPECT_EQ(gpu_.messages(), std::vector<std::string>{}); }
    Picture drawn(const Alpha& alpha, scene::AlphaMode mode)
    {
        const scene::Scene scene = sceneOf(alpha, mode);
        const scene::State state = scene::evaluate(scene, 0.0);
        RenderOptions options;
        options.width = 160;
        options.height = 120;
        options.shadow = {.technique = kPlainTechnique};
        options.shadow.map_size = 256;
        const SceneOnGpu uploaded(gpu_, scene, state);
        FrameRenderer renderer(uploaded, options);
        renderer.draw(state, {.position_ws = {0.3, 5.0, 7.0}, .target_ws = {0.0, 0.5, 0.0}}, lightsOf(scene, state));
        return renderer.read({.colour = false, .linear = true, .masks = true, .geometry = false});
    }

    Gpu gpu_{{.gpu = "software", .validate = true}};
};

TEST_P(AlphaCutoff, IsSolid)
{
    const Picture opaque = drawn(GetParam(), scene::AlphaMode::opaque);
    const Picture masked = drawn(GetParam(), scene::AlphaMode::mask);
    Alpha below = GetParam();
    below.cutoff *= 1.001F;
    const Picture clear = drawn(below, scene::AlphaMode::mask);
    EXPECT_EQ(differing(masked.linear, opaque.linear, 0.01F), 0U);
    EXPECT_GT(differing(clear.linear, opaque.linear, 0.01F), 500U) << "a thousandth less is clear";
    for (std::size_t light = 0; light < 2; ++light) {
        EXPECT_EQ(differing(masked.masks.at(light), opaque.masks.at(light), 0.01F), 0U) << light;
        EXPECT_GT(differing(clear.masks.at(light), opaque.masks.at(light), 0.1F), 100U) << light;
    }
}

INSTANTIATE_TEST_SUITE_P(Sources, AlphaCutoff,
                         testing::Values(Alpha{0.5F, 0.5F}, Alpha{0.3F, 0.3F}, Alpha{0.9F, 0.9F}, Alpha{1.0F, 1.0F},
                                         Alpha{0.001F, 0.001F}, Alpha{0.5F, 1.0F, 0.5F}, Alpha{0.3F, 1.0F, 0.3F},
                                         Alpha{0.7F, 1.0F, 0.7F}, Alpha{0.25F, 0.5F, 0.5F}, Alpha{0.1F, 1.0F, 0.1F},
                                         Alpha{128.0F / 255.0F, 1.0F, 1.0F, 128}, Alpha{77.0F / 255.0F, 1.0F, 1.0F, 77},
                                         Alpha{0.5F * 0.3F * 0.2F, 0.5F, 0.3F, 51}));

} // namespace
} // namespace gnomon::host::test
