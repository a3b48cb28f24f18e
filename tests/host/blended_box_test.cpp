// SPDX-License-Identifier: Apache-2.0
// A closed blended box does not tint itself: what faces the light is lit evenly, by every filter.
#include "host/frame_renderer.h"
#include "panes_scene.h"
#include "scene/state.h"
#include "small_scene.h"

#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::host::test {
namespace {

enum : std::uint32_t { kSun, kSpot, kPoint };

scene::Primitive box()
{
    scene::Primitive primitive;
    for (std::uint32_t i = 0; i < 8; ++i) {
        primitive.positions.emplace_back((i & 1U) != 0 ? 1 : -1, (i & 2U) != 0 ? 1 : -1, (i & 4U) != 0 ? 1 : -1);
    }
    primitive.indices = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                         2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
    primitive.material = 0;
    return primitive;
}

/// Two boxes, turned and leaning, neither of which is in the other's light.
scene::Scene boxes()
{
    scene::Scene scene;
    scene::Material& glass = scene.materials.emplace_back();
    glass.alpha_mode = scene::AlphaMode::blend;
    glass.base_colour = {0.2F, 0.5F, 0.8F, 0.6F};
    glass.metallic = 0.0F;
    for (const float x : {-2.2F, 2.2F}) {
        addMesh(scene, box());
        scene::Node& node = scene.nodes.back();
        node.transform.translation = {x, 0.0F, 0.0F};
        node.transform.rotation =
            x < 0.0F ? glm::quat(1, 0, 0, 0) : glm::angleAxis(0.4F, glm::normalize(glm::vec3(1, 2, 0.3F)));
    }
    for (const scene::LightType type :
         {scene::LightType::directional, scene::LightType::spot, scene::LightType::point}) {
        scene::Light light;
        light.type = type;
        light.intensity = type == scene::LightType::directional ? 3.0F : 300.0F;
        light.outer_cone_rad = 0.7F;
        light.range_m = 30.0F;
        scene::Node node;
        node.light = static_cast<std::uint32_t>(scene.lights.size());
        node.transform.translation = {0.5F, 7.0F, 4.0F};
        node.transform.rotation = glm::angleAxis(-1.05F, glm::vec3(1, 0, 0)) * glm::angleAxis(0.2F, glm::vec3(0, 1, 0));
        scene.lights.push_back(light);
        scene.nodes.push_back(node);
    }
    finishScene(scene);
    return scene;
}

class BlendedBox : public testing::Test {
protected:
    void TearDown() override { EXPECT_EQ(gpu_.messages(), std::vector<std::string>{}); }
    ImageF drawn(std::uint32_t light, const ShadowOptions* shadow)
    {
        RenderOptions options;
        options.width = 160;
        options.height = 120;
        options.shadows = shadow != nullptr;
        options.shadow = shadow != nullptr ? *shadow : options.shadow;
        FrameRenderer renderer(uploaded_, options);
        renderer.draw(state_, {.position_ws = {-1.0, 4.0, 7.0}, .target_ws = {0.0, 0.0, 0.0}},
                      {lightsOf(scene_, state_)[light]});
        return renderer.read({.colour = false, .linear = true}).linear;
    }
    void expectEven(std::uint32_t light, ShadowOptions shadow)
    {
        shadow.translucent = Translucent::colour;
        EXPECT_EQ(differing(drawn(light, &shadow), drawn(light, nullptr), 0.01F), 0U)
            << nameOf(shadow.technique.filter) << " " << nameOf(shadow.technique.partition) << ", light " << light
            << ", map " << shadow.map_size.value_or(0);
    }

    Gpu gpu_{{.gpu = "software", .validate = true}};
    scene::Scene scene_ = boxes();
    scene::State state_ = scene::evaluate(scene_, 0.0);
    SceneOnGpu uploaded_{gpu_, scene_, state_};
};

TEST_F(BlendedBox, IsLitEvenlyByEveryFilterAndPartition)
{
    for (const ShadowOptions& shadow : plainWithAll()) {
        for (const std::uint32_t light : {kSun, kSpot}) {
            expectEven(light, shadow);
        }
    }
    expectEven(kPoint, plainWith(Filter::pcf, Partition::cube));
    expectEven(kPoint, plainWith(Filter::pcf, Partition::paraboloid));
}

TEST_F(BlendedBox, IsLitEvenlyWithMapsOfAnySize)
{
    for (const std::uint32_t size : {32U, 64U, 512U, 2048U}) {
        ShadowOptions shadow = plainWith(Filter::pcf);
        shadow.map_size = size;
        for (const std::uint32_t light : {kSun, kSpot}) {
            expectEven(light, shadow);
        }
    }
}

} // namespace
} // namespace gnomon::host::test
