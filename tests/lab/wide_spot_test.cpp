// SPDX-License-Identifier: Apache-2.0
// Masks of spot lights that are wider than one frustum holds, up to glTF's 180 degrees, beside the truth.
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

void addBox(scene::Scene& scene, const glm::vec3& low, const glm::vec3& high)
{
    scene::Primitive primitive;
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
        for (const bool far : {false, true}) {
            const auto first = static_cast<std::uint32_t>(primitive.positions.size());
            for (const std::array<bool, 2>& corner :
                 {std::array{false, false}, {true, false}, {true, true}, {false, true}}) {
                glm::vec3 p = far ? high : low;
                const std::uint32_t u = (axis + 1) % 3;
                const std::uint32_t v = (axis + 2) % 3;
                p[static_cast<int>(u)] = (corner[0] ? high : low)[static_cast<int>(u)];
                p[static_cast<int>(v)] = (corner[1] ? high : low)[static_cast<int>(v)];
                primitive.positions.push_back(p);
            }
            const std::array<std::uint32_t, 6> front{0, 1, 2, 0, 2, 3};
            for (std::size_t i = 0; i < front.size(); ++i) {
                primitive.indices.push_back(first + (far ? front[i] : front[front.size() - 1 - i]));
            }
        }
    }
    scene::Node node;
    node.mesh = static_cast<std::uint32_t>(scene.meshes.size());
    scene.meshes.push_back({.name = "box", .primitives = {std::move(primitive)}});
    scene.nodes.push_back(std::move(node));
}

/// A floor with boxes all around a lamp 1.5 m above it.
scene::Scene lampAmongBoxes(float cone_deg)
{
    scene::Scene scene;
    addBox(scene, {-8, -1, -8}, {8, 0, 8});
    addBox(scene, {1, 0, 1}, {2, 1, 2});
    addBox(scene, {-3, 0, 0.5F}, {-2, 0.8F, 1.5F});
    addBox(scene, {-1, 0, -3}, {0.5F, 1.2F, -2.5F});
    addBox(scene, {3.5F, 0, -1}, {4, 1.4F, 0});
    scene::Light lamp;
    lamp.name = "lamp";
    lamp.type = scene::LightType::spot;
    lamp.outer_cone_rad = glm::radians(cone_deg / 2.0F);
    lamp.intensity = 100.0F;
    scene::Node node;
    node.light = 0;
    node.transform.translation = {0.3F, 1.5F, 0.2F};
    node.transform.rotation = glm::quat(glm::vec3(0.0F, 0.0F, -1.0F), glm::vec3(0.0F, -1.0F, 0.0F));
    scene.lights.push_back(std::move(lamp));
    scene.nodes.push_back(std::move(node));
    scene::NamedView view;
    view.name = "view";
    view.eye = {1.0F, 9.0F, 9.0F};
    view.target = {0.0F, 0.0F, 0.0F};
    view.fov_y_rad = 0.8F;
    scene.views = {view};
    finishScene(scene);
    return scene;
}

struct Case {
    Partition partition = Partition::automatic;
    float cone_deg = 0.0F;
};

std::ostream& operator<<(std::ostream& out, const Case& one)
{
    return out << nameOf(one.partition) << " of " << one.cone_deg << " degrees";
}

class WideSpots : public ::testing::TestWithParam<Case> {};

TEST_P(WideSpots, MaskAgreesWithTheTruth)
{
    const Case one = GetParam();
    Stage stage(lampAmongBoxes(one.cone_deg), "view", kSize_px, 0);
    host::RenderOptions options = filterOptions(Filter::pcf, MapFormat::d32f, 512);
    options.shadow.technique.partition = one.partition;
    const truth::Traced truth = stage.hardTruth();
    const Score score = stage.score(options, truth);
    EXPECT_LT(score.error.value().rmse, 0.06);
}

INSTANTIATE_TEST_SUITE_P(Partitions, WideSpots,
                         ::testing::Values(Case{Partition::automatic, 150.0F}, Case{Partition::cube, 150.0F},
                                           Case{Partition::multi, 150.0F}, Case{Partition::paraboloid, 150.0F},
                                           Case{Partition::cube, 180.0F}, Case{Partition::cube, 100.0F}));

} // namespace
} // namespace gnomon::lab::test
