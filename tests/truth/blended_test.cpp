// SPDX-License-Identifier: Apache-2.0
// The light that passes blended surfaces.
#include "support.h"

#include "scene_geometry.h"
#include "shadow_rays.h"

#include <glm/ext/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace gnomon::truth::test {
namespace {

constexpr float kAlpha = 0.5F;
constexpr double kLuminance = 0.2126 * 0.25 + 0.7152 * 0.5 + 0.0722 * 1.0; // of kTint
const glm::vec3 kTint{0.25F, 0.5F, 1.0F};

/// A ground under panes at these heights, which reach from x = 0 on.
scene::Scene panes(const std::vector<float>& heights)
{
    scene::Scene scene;
    scene::Material glass;
    glass.alpha_mode = scene::AlphaMode::blend;
    glass.stained = true;
    glass.base_colour = glm::vec4(kTint, kAlpha);
    scene.materials.push_back(glass);
    place(scene, addQuad(scene, level(0.0F, 32.0F)));
    for (const float height : heights) {
        place(scene, addQuad(scene, ceiling(height, 0.0F, 4.0F, 4.0F), 0));
    }
    return scene;
}

/// The light left of the panes' edge, and right of it.
struct Sides {
    double free = 0.0;
    double under = 0.0;
};
Sides sidesOf(scene::Scene scene, const Light& light, const Options& options)
{
    const Traced traced = trace(scene, lookDown(0.0, 8.0, 2.0, {16, 4}), light, options);
    expectSound(traced);
    return {traced.at(2, 2), traced.at(13, 2)};
}

TEST(Blended, OnePaneTintsWhatLiesBehindItAndNothingElse)
{
    const double once = 1.0 - kAlpha * (1.0 - kLuminance);
    for (const Options& options : {hard(), area(64)}) {
        for (const Light& light : {sun({0.0, -1.0, 0.0}), lamp({0.0, 6.0, 0.0}, 0.05)}) {
            const Sides sides = sidesOf(panes({1.0F}), light, options);
            EXPECT_EQ(sides.free, 1.0);
            EXPECT_NEAR(sides.under, once, 1e-6);
        }
    }
}

TEST(Blended, PaneThatIsNotStainedTakesWhatItCovers)
{
    for (const Options& options : {hard(), area(64)}) {
        scene::Scene one = panes({1.0F});
        one.materials[0].stained = false;
        EXPECT_NEAR(sidesOf(one, sun({0.0, -1.0, 0.0}), options).under, 1.0 - kAlpha, 1e-6);
        one.materials[0].base_colour = glm::vec4(1.0F);
        EXPECT_EQ(sidesOf(one, sun({0.0, -1.0, 0.0}), options).under, 0.0) << "white, and there all the same";
    }
}

TEST(Blended, PanesMultiplyColourByColour)
{
    const Sides sides = sidesOf(panes({1.0F, 2.0F}), sun({0.0, -1.0, 0.0}), area(64));
    const glm::dvec3 through = 1.0 - double{kAlpha} * (1.0 - glm::dvec3(kTint));
    const glm::dvec3 twice = through * through;
    EXPECT_NEAR(sides.under, 0.2126 * twice.x + 0.7152 * twice.y + 0.0722 * twice.z, 1e-6);
    EXPECT_EQ(sides.free, 1.0);
}

TEST(Blended, PaneBehindTheReceiverTintsNothing)
{
    const Sides sides = sidesOf(panes({-1.0F}), sun({0.0, -1.0, 0.0}), area(64));
    EXPECT_EQ(sides.under, 1.0);
}

TEST(Blended, PaneThatDoesNotCastTintsNothing)
{
    scene::Scene scene = panes({1.0F});
    scene.nodes[1].casts = false;
    EXPECT_EQ(sidesOf(scene, sun({0.0, -1.0, 0.0}), hard()).under, 1.0);
}

TEST(Blended, InstancesTintAsWell)
{
    scene::Scene scene = panes({1.0F});
    scene.nodes[1].instances = {glm::mat4(1.0F), glm::translate(glm::mat4(1.0F), glm::vec3(0.0F, 1.0F, 0.0F))};
    scene::finishScene(scene);
    const scene::State state = scene::evaluate(scene, 0.0);
    const SceneGeometry geometry(scene, state, 0);
    ASSERT_TRUE(geometry.part(1).instanced);
    Receiver receiver;
    receiver.rel = glm::dvec3(2.0, 0.001, 0.5) - geometry.originWs();
    const glm::dvec3 through = 1.0 - double{kAlpha} * (1.0 - glm::dvec3(kTint));
    const glm::dvec3 twice = through * through;
    for (const Options& options : {hard(), area(64)}) {
        const ShadowRays rays(geometry, sun({0.0, -1.0, 0.0}), options);
        EXPECT_NEAR(rays.trace(receiver).visibility, 0.2126 * twice.x + 0.7152 * twice.y + 0.0722 * twice.z, 1e-6);
    }
}

TEST(Blended, VerticesSayWhereAndByWhatItTints)
{
    scene::Scene scene = panes({1.0F});
    scene.materials[0].base_colour = glm::vec4(1.0F);
    std::vector<glm::vec4>& colours = scene.meshes[1].primitives[0].colours;
    for (const glm::vec3& p : scene.meshes[1].primitives[0].positions) {
        colours.emplace_back(kTint, p.x > 2.0F ? kAlpha : 0.0F); // from nothing at x = 0 to half at x = 4
    }
    const Traced traced = trace(scene, lookDown(2.0, 8.0, 2.0, {16, 4}), sun({0.0, -1.0, 0.0}), hard());
    for (std::uint32_t x = 0; x < 16; ++x) {
        const double share = (x + 0.5) / 16.0;
        EXPECT_NEAR(traced.at(x, 2), 1.0 - share * kAlpha * (1.0 - kLuminance), 1e-5) << x;
    }
}

/// The texture's alpha, too, and its colours, which are stored by the curve of sRGB.
TEST(Blended, TextureSaysWhereAndByWhatItTints)
{
    scene::Scene scene = panes({1.0F});
    scene.images = {{"half", 2, 1, {188, 188, 188, 255, 188, 188, 188, 0}}};
    scene.textures = {scene::Texture{.image = 0, .magnify_linear = false}};
    scene.materials[0].base_colour = glm::vec4(1.0F);
    scene.materials[0].base_colour_texture.texture = 0;
    const Traced traced = trace(scene, lookDown(2.0, 8.0, 2.0, {16, 4}), sun({0.0, -1.0, 0.0}), hard());
    const double one = traced.at(2, 2);
    const double other = traced.at(13, 2);
    EXPECT_NEAR(std::min(one, other), 0.5, 0.01); // 188 is half of the light
    EXPECT_EQ(std::max(one, other), 1.0);
}

} // namespace
} // namespace gnomon::truth::test
