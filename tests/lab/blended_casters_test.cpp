// SPDX-License-Identifier: Apache-2.0
// The mask of a scene with panes of coloured glass beside the truth, of sun and spot light. Without the tints the same
// masks are far from it.
#include "stage.h"

#include "scene/state.h"

#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <ostream>
#include <utility>

namespace gnomon::lab::test {
namespace {

constexpr glm::uvec2 kSize_px{240, 160};

void addQuad(scene::Scene& scene, const std::array<glm::vec3, 4>& corners, std::uint32_t material)
{
    scene::Primitive primitive;
    primitive.positions.assign(corners.begin(), corners.end());
    primitive.indices = {0, 1, 2, 0, 2, 3};
    primitive.material = material;
    scene::Node node;
    node.mesh = static_cast<std::uint32_t>(scene.meshes.size());
    scene.meshes.push_back({.name = "quad", .primitives = {std::move(primitive)}});
    scene.nodes.push_back(std::move(node));
}

void addLight(scene::Scene& scene, scene::Light light, const glm::vec3& from, const glm::vec3& to)
{
    scene::Node node;
    node.light = static_cast<std::uint32_t>(scene.lights.size());
    node.transform.translation = from;
    node.transform.rotation = glm::quat(glm::vec3(0.0F, 0.0F, -1.0F), glm::normalize(to - from));
    scene.lights.push_back(std::move(light));
    scene.nodes.push_back(std::move(node));
}

/// A ground with a wall on it, a red pane that leans over the ground before a level blue one, and a sun and a spot
/// light whose shadows of all three cross each other.
scene::Scene panesAndWall()
{
    scene::Scene scene;
    scene.materials.resize(3);
    for (scene::Material& material : scene.materials) {
        material.double_sided = true;
    }
    scene.materials[1].alpha_mode = scene::AlphaMode::blend;
    scene.materials[1].stained = true;
    scene.materials[1].base_colour = {1.0F, 0.1F, 0.1F, 0.8F};
    scene.materials[2].alpha_mode = scene::AlphaMode::blend;
    scene.materials[2].stained = true;
    scene.materials[2].base_colour = {0.2F, 0.4F, 1.0F, 0.5F};
    addQuad(scene, {{{-6, 0, -6}, {-6, 0, 6}, {6, 0, 6}, {6, 0, -6}}}, 0);
    addQuad(scene, {{{-3, 0, -1}, {-1, 0, -1}, {-1, 2.5F, -1}, {-3, 2.5F, -1}}}, 0);
    addQuad(scene, {{{-2, 0.5F, 1}, {0.5F, 0.5F, 1}, {1, 2.5F, 0}, {-1.5F, 2.5F, 0}}}, 1);
    addQuad(scene, {{{0, 1, -1}, {0, 1, 2}, {2.5F, 1, 2}, {2.5F, 1, -1}}}, 2);
    addLight(scene, {.name = "sun"}, {3, 6, 2}, {0, 0, 0});
    scene::Light spot;
    spot.name = "spot";
    spot.type = scene::LightType::spot;
    spot.outer_cone_rad = 0.7F;
    spot.range_m = 30.0F;
    addLight(scene, spot, {2, 7, 2}, {0, 0, 0});
    scene::NamedView view;
    view.name = "view";
    view.eye = {1.0F, 7.0F, 8.0F};
    view.target = {0.0F, 0.0F, 0.0F};
    view.fov_y_rad = 0.7F;
    scene.views = {view};
    finishScene(scene);
    return scene;
}

struct Case {
    std::uint32_t light = 0;
    Filter filter = Filter::hard;
    bool area_truth = false;
    double most_rmse = 0.0;
};

std::ostream& operator<<(std::ostream& out, const Case& one)
{
    return out << nameOf(one.filter) << (one.light == 0 ? " of the sun" : " of the spot light");
}

class BlendedCasters : public ::testing::TestWithParam<Case> {};

TEST_P(BlendedCasters, MaskAgreesWithTheTruth)
{
    const Case one = GetParam();
    Stage stage(panesAndWall(), "view", kSize_px, one.light);
    host::RenderOptions options = filterOptions(one.filter, MapFormat::d32f, 1024);
    const truth::Traced truth = one.area_truth ? stage.areaTruth(64) : stage.hardTruth();
    const double rmse = stage.score(options, truth).error.value().rmse;
    EXPECT_LT(rmse, one.most_rmse);
    options.shadow.translucent = Translucent::colour;
    EXPECT_EQ(stage.score(options, truth).error.value().rmse, rmse) << "what is measured is the luminance";
    options.shadow.translucent = Translucent::none;
    EXPECT_GT(stage.score(options, truth).error.value().rmse, 5.0 * one.most_rmse);
}

// A third more than what they err.
INSTANTIATE_TEST_SUITE_P(Lights, BlendedCasters,
                         ::testing::Values(Case{0, Filter::hard, false, 0.012}, Case{1, Filter::hard, false, 0.021},
                                           Case{0, Filter::pcf, true, 0.0083}, Case{1, Filter::pcf, true, 0.019},
                                           Case{0, Filter::raymarch, true, 0.0076},
                                           Case{1, Filter::raymarch, true, 0.0172}));

} // namespace
} // namespace gnomon::lab::test
