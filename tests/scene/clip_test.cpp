// SPDX-License-Identifier: Apache-2.0
// Boxes and bounds of objects cut by clip planes.
#include "scene/clip.h"
#include "scene/state.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace gnomon::scene {
namespace {

constexpr float kHalfRoot = 0.70710678F;
const Aabb kCube{glm::vec3(-1.0F), glm::vec3(1.0F)};

void expectBox(const Aabb& box, const glm::vec3& min, const glm::vec3& max)
{
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(box.min[axis], min[axis], 1e-6F) << axis;
        EXPECT_NEAR(box.max[axis], max[axis], 1e-6F) << axis;
    }
}

TEST(ClippedBox, IsTheSmallestAroundWhatIsLeft)
{
    EXPECT_EQ(clipped(kCube, kNoClipPlanes).max, kCube.max);
    expectBox(clipped(kCube, {glm::vec4(0, -1, 0, 0.25F), kNoClipPlane}), {-1, -1, -1}, {1, 0.25F, 1});
    // A corner of the cube, cut off by x + y <= -1: a prism.
    const glm::vec4 corner(-kHalfRoot, -kHalfRoot, 0.0F, -kHalfRoot);
    expectBox(clipped(kCube, {corner, kNoClipPlane}), {-1, -1, -1}, {0, 0, 1});
    expectBox(clipped(kCube, {corner, glm::vec4(1, 0, 0, 0.5F)}), {-0.5F, -1, -1}, {0, -0.5F, 1});
    // A roof: the two planes meet inside of the cube, at a height of 0.5.
    expectBox(clipped(kCube, {glm::vec4(kHalfRoot, -kHalfRoot, 0, 0.5F * kHalfRoot),
                              glm::vec4(-kHalfRoot, -kHalfRoot, 0, 0.5F * kHalfRoot)}),
              {-1, -1, -1}, {1, 0.5F, 1});
}

TEST(ClippedBox, MayBeFlatAPointOrNothing)
{
    const Aabb flat{{-1, 0, -1}, {1, 0, 1}};
    expectBox(clipped(flat, {glm::vec4(1, 0, 0, 0), kNoClipPlane}), {0, 0, -1}, {1, 0, 1});
    EXPECT_TRUE(clipped(flat, {glm::vec4(0, 1, 0, -0.5F), kNoClipPlane}).empty());
    expectBox(clipped(flat, {glm::vec4(0, 1, 0, 0), kNoClipPlane}), flat.min, flat.max); // on the plane is inside
    const Aabb point{glm::vec3(0.5F), glm::vec3(0.5F)};
    expectBox(clipped(point, {glm::vec4(1, 0, 0, 0), kNoClipPlane}), point.min, point.max);
    EXPECT_TRUE(clipped(kCube, {glm::vec4(1, 0, 0, -0.1F), glm::vec4(-1, 0, 0, -0.1F)}).empty());
    EXPECT_TRUE(clipped(Aabb{}, {glm::vec4(1, 0, 0, 0), kNoClipPlane}).empty());
    const Aabb endless{glm::vec3(-1), glm::vec3(std::numeric_limits<float>::infinity())};
    EXPECT_EQ(clipped(endless, {glm::vec4(1, 0, 0, 0), kNoClipPlane}).max, endless.max);
}

TEST(ClippedPolygon, KeepsItsAreaInside)
{
    Polygon square;
    for (const glm::dvec3 corner : {glm::dvec3(0, 0, 0), {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}) {
        square.add(corner);
    }
    const auto area = [](const Polygon& polygon) {
        glm::dvec3 twice(0.0);
        for (std::size_t i = 2; i < polygon.count; ++i) {
            twice += glm::cross(polygon.corners[i - 1] - polygon.corners[0], polygon.corners[i] - polygon.corners[0]);
        }
        return 0.5 * glm::length(twice);
    };
    // Two opposite corners off, an eighth each.
    const glm::vec4 low(kHalfRoot, kHalfRoot, 0, -0.5F * kHalfRoot);
    const glm::vec4 high(-kHalfRoot, -kHalfRoot, 0, 1.5F * kHalfRoot);
    const Polygon left = clipped(square, {low, high});
    EXPECT_EQ(left.count, 6U);
    EXPECT_NEAR(area(left), 0.75, 1e-6);
    EXPECT_EQ(clipped(square, {glm::vec4(0, 0, 1, -1), high}).count, 0U);
}

Primitive cubeCorners()
{
    Primitive primitive;
    for (int i = 0; i < 8; ++i) {
        primitive.positions.push_back(kCube.corner(i));
    }
    primitive.indices = {0, 1, 2, 5, 6, 7};
    return primitive;
}

Scene oneCube()
{
    Scene scene;
    scene.meshes.push_back({"cube", {cubeCorners()}, {}});
    scene.nodes.resize(1);
    scene.nodes[0].mesh = 0;
    scene.nodes[0].transform.translation = {10, 0, 0};
    scene.nodes[0].transform.scale = {2, 1, 1};
    scene.nodes[0].clip_planes[0] = {-1, 0, 0, 0}; // x <= 0 of its own
    return scene;
}

TEST(ClippedObject, HasTheBoundsOfWhatIsLeft)
{
    Scene scene = oneCube();
    finishScene(scene);
    State state = evaluate(scene, 0.0);
    expectBox(state.objects[0].bounds_ws, {8, -1, -1}, {10, 1, 1});
    expectBox(state.bounds_ws, {8, -1, -1}, {10, 1, 1});
    EXPECT_EQ(state.objects[0].clip_planes, scene.nodes[0].clip_planes);
    scene.nodes[0].instances = {glm::mat4(1.0F), glm::mat4(-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1)};
    state = evaluate(scene, 0.0);
    expectBox(state.objects[1].bounds_ws, {10, -1, -1}, {12, 1, 1}); // turned around: each has its own space
}

TEST(ClippedObject, CutAwayWhollyIsNowhere)
{
    Scene scene = oneCube();
    scene.nodes[0].clip_planes[1] = {1, 0, 0, -0.5F};
    scene.nodes.push_back(scene.nodes[0]);
    scene.nodes[1].clip_planes = kNoClipPlanes;
    finishScene(scene);
    const State state = evaluate(scene, 0.0);
    EXPECT_TRUE(state.objects[0].bounds_ws.empty());
    expectBox(state.bounds_ws, {8, -1, -1}, {12, 1, 1});
}

/// The node's own transform plays no part where joints say where vertices are.
TEST(ClippedObject, IsCutInTheWorldWhereItIsSkinned)
{
    Scene scene = oneCube();
    Primitive& primitive = scene.meshes[0].primitives[0];
    primitive.joints.assign(8, glm::u16vec4(0));
    primitive.weights.assign(8, glm::vec4(1, 0, 0, 0));
    scene.nodes.emplace_back().transform.translation = {0.5F, 0, 0};
    scene.skins.push_back({"skin", {1}, {glm::mat4(1.0F)}});
    scene.nodes[0].skin = 0;
    finishScene(scene);
    EXPECT_EQ(evaluate(scene, 0.0).objects[0].world_from_object, glm::mat4(1.0F));
    expectBox(evaluate(scene, 0.0).objects[0].bounds_ws, {-0.5F, -1, -1}, {0, 1, 1});
}

} // namespace
} // namespace gnomon::scene
