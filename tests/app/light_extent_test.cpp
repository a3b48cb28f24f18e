// SPDX-License-Identifier: Apache-2.0
#include "shot_parts.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include <cmath>

namespace gnomon {
namespace {

/// The triangle (0, 0, 0), (2, 0, 0), (0, 2, 0), placed.
struct OneTriangle {
    scene::Scene scene;
    scene::State state;

    explicit OneTriangle(const glm::mat4& world_from_object = glm::mat4(1.0F),
                         scene::AlphaMode alpha = scene::AlphaMode::opaque,
                         const scene::ClipPlanes& clip_planes = scene::kNoClipPlanes)
    {
        scene::Primitive primitive;
        primitive.positions = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}};
        primitive.indices = {0, 1, 2};
        primitive.material = 0;
        scene.materials.emplace_back().alpha_mode = alpha;
        scene.meshes.emplace_back().primitives.push_back(primitive);
        scene::Node node;
        node.mesh = 0;
        node.use_matrix = true;
        node.matrix = world_from_object;
        node.clip_planes = clip_planes;
        scene.nodes.push_back(node);
        scene::finishScene(scene);
        state = scene::evaluate(scene, 0.0);
    }
    [[nodiscard]] double distanceTo(const glm::dvec3& point) const
    {
        double low = 0.0;
        double high = 64.0;
        for (int i = 0; i < 60; ++i) {
            const double middle = (low + high) / 2.0;
            (app::holdsSurface(scene, state, point, middle) ? high : low) = middle;
        }
        return high;
    }
};

TEST(LightExtent, IsHeldAgainstFaceEdgesAndCorners)
{
    const OneTriangle there;
    constexpr double kNear = 1e-6;
    EXPECT_NEAR(there.distanceTo({0.5, 0.5, 3.0}), 3.0, kNear);
    EXPECT_NEAR(there.distanceTo({0.5, 0.5, -3.0}), 3.0, kNear);           // from behind
    EXPECT_NEAR(there.distanceTo({1.0, -2.0, 0.0}), 2.0, kNear);           // beside an edge, in the plane
    EXPECT_NEAR(there.distanceTo({2.0, 2.0, 1.0}), std::sqrt(3.0), kNear); // the long edge, and above
    EXPECT_NEAR(there.distanceTo({-3.0, -4.0, 0.0}), 5.0, kNear);          // corners
    EXPECT_NEAR(there.distanceTo({6.0, -3.0, 0.0}), 5.0, kNear);
    EXPECT_NEAR(there.distanceTo({-3.0, 6.0, 12.0}), 13.0, kNear);
    EXPECT_FALSE(app::holdsSurface(there.scene, there.state, {0.5, 0.5, 0.0}, 0.0)); // no extent, no surface in it
}

TEST(LightExtent, KnowsOnlyTheTriangleNotItsBounds)
{
    const OneTriangle there;
    EXPECT_FALSE(app::holdsSurface(there.scene, there.state, {1.9, 1.9, 0.0}, 1.2)); // inside the box
    EXPECT_TRUE(app::holdsSurface(there.scene, there.state, {1.9, 1.9, 0.0}, 1.3));
}

TEST(LightExtent, FollowsTheObjectsPlace)
{
    const glm::mat4 moved = glm::scale(glm::translate(glm::mat4(1.0F), {10, 0, 0}), glm::vec3(1, 1, 0));
    EXPECT_NEAR(OneTriangle(moved).distanceTo({10.5, 0.5, 2.0}), 2.0, 1e-5);
    const glm::mat4 line = glm::scale(glm::mat4(1.0F), glm::vec3(1, 0, 1)); // flattened: a line along x
    EXPECT_NEAR(OneTriangle(line).distanceTo({1.0, 3.0, 4.0}), 5.0, 1e-5);
}

TEST(LightExtent, PassesOverWhatIsBlended)
{
    const OneTriangle there(glm::mat4(1.0F), scene::AlphaMode::blend);
    EXPECT_FALSE(app::holdsSurface(there.scene, there.state, {0.5, 0.5, 0.0}, 50.0));
}

TEST(LightExtent, PassesOverWhatIsCutAway)
{
    const glm::vec4 right(1, 0, 0, -1); // x >= 1 of its own: a smaller triangle from (1, 0, 0) on
    const glm::mat4 moved = glm::translate(glm::mat4(1.0F), {10, 0, 0});
    const OneTriangle part(moved, scene::AlphaMode::opaque, {right, scene::kNoClipPlane});
    EXPECT_NEAR(part.distanceTo({10.5, 0.5, 0.0}), 0.5, 1e-6);
    EXPECT_NEAR(part.distanceTo({7.0, -3.0, 0.0}), 5.0, 1e-6);
    const OneTriangle none(moved, scene::AlphaMode::opaque, {right, glm::vec4(-1, 0, 0, 0.5F)});
    EXPECT_FALSE(app::holdsSurface(none.scene, none.state, {10.5, 0.5, 0.0}, 50.0));
}

} // namespace
} // namespace gnomon
