// SPDX-License-Identifier: Apache-2.0
// The shadow of sparse leaves keeps its weight when the map's texels grow far beyond the leaves.
#include "host/frame_renderer.h"
#include "scene/state.h"

#include <gtest/gtest.h>

#include <string>

namespace gnomon::host::test {
namespace {

scene::Mesh quad(float half_size_m, float y, std::uint32_t material)
{
    scene::Primitive primitive;
    primitive.positions = {{-half_size_m, y, -half_size_m},
                           {-half_size_m, y, half_size_m},
                           {half_size_m, y, half_size_m},
                           {half_size_m, y, -half_size_m}};
    primitive.uv0 = {{0, 0}, {0, 1}, {1, 1}, {1, 0}};
    primitive.indices = {0, 1, 2, 0, 2, 3};
    primitive.material = material;
    scene::Mesh mesh;
    mesh.primitives = {primitive};
    return mesh;
}

// A ground under a card whose texture is opaque in one texel of four, scattered; the sun stands overhead.
scene::Scene leavesOverGround()
{
    scene::Scene scene;
    scene::Image leaves{"leaves", 256, 256, std::vector<std::uint8_t>(256 * 256 * 4, 255)};
    for (std::uint32_t i = 0; i < 256 * 256; ++i) {
        const std::uint32_t mixed = (i + 1) * 2654435761U; // Knuth's multiplicative hash
        leaves.rgba[i * 4 + 3] = (mixed >> 24U) < 64 ? 255 : 0;
    }
    scene.images = {leaves};
    scene.textures = {scene::Texture{.image = 0}};
    scene.materials.resize(2);
    scene.materials[1].alpha_mode = scene::AlphaMode::mask;
    scene.materials[1].double_sided = true;
    scene.materials[1].base_colour_texture.texture = 0;
    scene.meshes = {quad(10.0F, 0.0F, 0), quad(4.0F, 2.0F, 1)};
    scene.nodes.resize(3);
    scene.nodes[0].mesh = 0;
    scene.nodes[1].mesh = 1;
    scene.nodes[1].receives = false;
    scene.nodes[2].light = 0;
    scene.nodes[2].transform.rotation = glm::angleAxis(-1.5707964F, glm::vec3(1, 0, 0)); // -z becomes down
    scene.lights.resize(1);
    finishScene(scene);
    return scene;
}

// Mean darkness of the ground, seen from below the card so that the card hides none of it.
double shadowOf(Gpu& gpu, std::uint32_t map_size)
{
    const scene::Scene scene = leavesOverGround();
    const scene::State state = scene::evaluate(scene, 0.0);
    RenderOptions options;
    options.width = 160;
    options.height = 120;
    options.shadow.map_size = map_size;
    options.shadow.border_texels = 2.0;
    const SceneOnGpu uploaded(gpu, scene, state);
    FrameRenderer renderer(uploaded, options);
    renderer.draw(state, {.position_ws = {0.0, 1.9, 0.01}, .target_ws = {0, 0, 0}, .fov_y_rad = 1.4},
                  lightsOf(scene, state));
    const Picture picture = renderer.read({.colour = false, .linear = false, .masks = true, .geometry = false});
    double dark = 0.0;
    for (const float v : picture.masks.at(0).values) {
        dark += 1.0 - v;
    }
    return dark / static_cast<double>(picture.masks[0].values.size());
}

TEST(MaskedCaster, KeepsItsShadowWhenTexelsGrow)
{
    Gpu gpu({.gpu = "software", .validate = true});
    const double fine = shadowOf(gpu, 1024);
    EXPECT_NEAR(fine, 0.25, 0.08);
    for (const std::uint32_t size : {128U, 32U}) {
        EXPECT_NEAR(shadowOf(gpu, size), fine, 0.1) << size;
    }
    EXPECT_EQ(gpu.messages(), std::vector<std::string>{});
}

} // namespace
} // namespace gnomon::host::test
