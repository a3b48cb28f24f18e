// SPDX-License-Identifier: Apache-2.0
// Objects and lights in groups: a light's rays pass through what is in none of its groups.
#include "support.h"

#include "camera_rays.h"
#include "scene_geometry.h"
#include "shadow_rays.h"

#include <glm/ext/matrix_transform.hpp>
#include <gtest/gtest.h>

namespace gnomon::truth::test {
namespace {

/// A ground under two ceilings, from x = 0 on to the right in group 0, to the left in group 3.
scene::Scene ceilings(scene::AlphaMode alpha = scene::AlphaMode::opaque)
{
    scene::Scene scene;
    scene.materials.emplace_back().alpha_mode = alpha;
    place(scene, addQuad(scene, level(0.0F, 32.0F)));
    place(scene, addQuad(scene, ceiling(1.0F, 0.0F, 4.0F, 4.0F), 0));
    place(scene, addQuad(scene, ceiling(1.0F, -4.0F, 0.0F, 4.0F), 0)).groups = 8;
    return scene;
}

struct Sides {
    double group3 = 0.0;
    double group0 = 0.0;
};
Sides sidesOf(scene::Scene scene, Light light, std::uint32_t groups, const Options& options)
{
    light.groups = groups;
    const Traced traced = trace(scene, lookDown(0.0, 8.0, 2.0, {16, 4}), light, options);
    expectSound(traced);
    return {traced.at(2, 2), traced.at(13, 2)};
}

TEST(Groups, RaysPassThroughThoseOfOthers)
{
    for (const scene::AlphaMode alpha : {scene::AlphaMode::opaque, scene::AlphaMode::blend}) {
        for (const Options& options : {hard(), area(64)}) {
            for (const Light& light : {sun({0.0, -1.0, 0.0}), lamp({0.0, 6.0, 0.0}, 0.05)}) {
                const auto sides = [&](std::uint32_t groups) {
                    return sidesOf(ceilings(alpha), light, groups, options);
                };
                EXPECT_EQ(sides(0xFFFFFFFFU).group0, 0.0);
                EXPECT_EQ(sides(0xFFFFFFFFU).group3, 0.0);
                EXPECT_EQ(sides(1).group0, 0.0);
                EXPECT_EQ(sides(1).group3, 1.0);
                EXPECT_EQ(sides(8).group0, 1.0);
                EXPECT_EQ(sides(8).group3, 0.0);
                EXPECT_EQ(sides(2).group0, 1.0);
                EXPECT_EQ(sides(2).group3, 1.0);
            }
        }
    }
}

/// An object in no group is seen, and casts for no light.
TEST(Groups, WithoutOneIsSeenAndCastsNothing)
{
    scene::Scene scene = ceilings();
    scene.nodes[1].groups = 0;
    EXPECT_EQ(sidesOf(scene, sun({0.0, -1.0, 0.0}), 0xFFFFFFFFU, hard()).group0, 1.0);
    const Traced below =
        trace(scene, lookAt({2.0, 0.5, 0.0}, {2.0, 1.0, 0.1}, 0.2, {4, 4}), sun({0.0, 1.0, 0.0}), hard());
    EXPECT_EQ(below.id(2, 2), 2U);
}

TEST(Groups, HoldForInstancesToo)
{
    scene::Scene scene;
    place(scene, addQuad(scene, level(0.0F, 32.0F)));
    const std::uint32_t cube = addCube(scene);
    const glm::mat4 up = glm::translate(glm::mat4(1.0F), glm::vec3(0.0F, 3.0F, 0.0F));
    place(scene, cube, glm::translate(up, glm::vec3(4.0F, 0.0F, 0.0F)));
    place(scene, cube, glm::translate(up, glm::vec3(-4.0F, 0.0F, 0.0F))).groups = 8;
    scene::finishScene(scene);
    const scene::State state = scene::evaluate(scene, 0.0);
    const SceneGeometry geometry(scene, state, 0);
    ASSERT_TRUE(geometry.part(1).instanced);
    Light light = sun({0.0, -1.0, 0.0});
    light.groups = 8;
    const ShadowRays rays(geometry, light, hard());
    const auto visibilityAt = [&](double x) {
        Receiver receiver;
        receiver.rel = glm::dvec3(x, 0.01, 0.0) - geometry.originWs();
        return rays.trace(receiver).visibility;
    };
    EXPECT_EQ(visibilityAt(4.0), 1.0);
    EXPECT_EQ(visibilityAt(-4.0), 0.0);
}

} // namespace
} // namespace gnomon::truth::test
