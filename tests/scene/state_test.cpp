// SPDX-License-Identifier: Apache-2.0
// Placing, instancing, morphing and skinning against results worked out by hand.
#include "scene/state.h"

#include "allocation_count.h"

#include <gnomon/error.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace gnomon::scene {
namespace {

constexpr float kHalfPi = 1.5707963F;

void expectNear(const glm::vec3& got, const glm::vec3& expected, float tolerance = 1e-5F)
{
    EXPECT_NEAR(got.x, expected.x, tolerance);
    EXPECT_NEAR(got.y, expected.y, tolerance);
    EXPECT_NEAR(got.z, expected.z, tolerance);
}

/// One triangle in the xy plane.
Mesh triangleMesh()
{
    Mesh mesh;
    Primitive& primitive = mesh.primitives.emplace_back();
    primitive.positions = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}};
    primitive.normals.assign(3, glm::vec3(0, 0, 1));
    primitive.indices = {0, 1, 2};
    return mesh;
}

Scene triangleScene()
{
    Scene scene;
    scene.meshes.push_back(triangleMesh());
    scene.nodes.resize(1);
    scene.nodes[0].mesh = 0;
    return scene;
}

TEST(FinishScene, RecentresWhatLiesFarFromItsMeshsOrigin)
{
    Scene scene = triangleScene();
    const glm::vec3 away(100000.0F, 0.0F, -100000.0F);
    scene.meshes[0].primitives.push_back(scene.meshes[0].primitives[0]);
    for (glm::vec3& p : scene.meshes[0].primitives[1].positions) {
        p += away;
    }
    scene.nodes[0].transform.translation = -away;
    scene.nodes[0].clip_planes[0] = {1.0F, 0.0F, 0.0F, 1.0F};
    finishScene(scene);
    const std::vector<Primitive>& primitives = scene.meshes[0].primitives;
    EXPECT_EQ(primitives[0].origin, glm::vec3(0.0F));
    EXPECT_EQ(primitives[1].origin, away);
    EXPECT_EQ(primitives[1].positions, primitives[0].positions);
    const State state = evaluate(scene, 0.0);
    expectNear(glm::vec3(state.objects[1].world_from_object[3]), {0.0F, 0.0F, 0.0F}, 0.0F);
    expectNear(state.objects[1].bounds_ws.max, {1.0F, 2.0F, 0.0F}, 0.0F);
    EXPECT_EQ(state.objects[0].clip_planes[0].w, 1.0F);
    EXPECT_EQ(state.objects[1].clip_planes[0].w, 100001.0F) << "the same plane";

    Scene skinned = triangleScene();
    for (glm::vec3& p : skinned.meshes[0].primitives[0].positions) {
        p += away;
    }
    skinned.nodes[0].skin = 0;
    finishScene(skinned);
    EXPECT_EQ(skinned.meshes[0].primitives[0].origin, glm::vec3(0.0F)) << "its joints know where it is";
}

/// Two joints, the second one up the first; the triangle's corners hang on the first, the second, and half on each.
Scene skinnedScene()
{
    Scene scene = triangleScene();
    Primitive& primitive = scene.meshes[0].primitives[0];
    primitive.joints = {{0, 0, 0, 0}, {1, 0, 0, 0}, {0, 1, 0, 0}};
    primitive.weights = {{1, 0, 0, 0}, {1, 0, 0, 0}, {0.5F, 0.5F, 0, 0}};
    scene.nodes.resize(3);
    scene.nodes[0].skin = 0;
    scene.nodes[0].transform.translation = {100, 0, 0}; // glTF: a skinned mesh ignores its own node
    scene.nodes[2].parent = 1;
    scene.nodes[2].transform.translation = {0, 1, 0};
    Skin& skin = scene.skins.emplace_back();
    skin.joints = {1, 2};
    skin.inverse_bind = {glm::mat4(1.0F), glm::translate(glm::mat4(1.0F), glm::vec3(0, -1, 0))};
    return scene;
}

TEST(State, PlacesChildrenUnderTheirParents)
{
    Scene scene = triangleScene();
    scene.nodes.resize(3);
    scene.nodes[1].parent = 0;
    scene.nodes[2].parent = 1;
    scene.nodes[2].mesh = 0;
    scene.nodes[0].transform.translation = {1, 2, 3};
    scene.nodes[1].transform.rotation = glm::quat(std::cos(kHalfPi / 2), 0, std::sin(kHalfPi / 2), 0); // +x to -z
    scene.nodes[2].use_matrix = true;
    scene.nodes[2].matrix = glm::translate(glm::mat4(1.0F), glm::vec3(5, 0, 0));
    finishScene(scene);
    const State state = evaluate(scene, 0.0);
    ASSERT_EQ(state.objects.size(), 2U);
    expectNear(glm::vec3(state.objects[1].world_from_object[3]), {1, 2, -2});
    expectNear(state.objects[1].bounds_ws.min, {1, 2, -3});
    expectNear(state.objects[1].bounds_ws.max, {1, 4, -2});
}

TEST(State, DrawsAMeshOncePerInstance)
{
    Scene scene = triangleScene();
    scene.nodes[0].transform.scale = glm::vec3(2.0F);
    for (int i = 0; i < 5; ++i) {
        scene.nodes[0].instances.push_back(glm::translate(glm::mat4(1.0F), glm::vec3(static_cast<float>(i), 0, 0)));
    }
    finishScene(scene);
    const State state = evaluate(scene, 0.0);
    ASSERT_EQ(state.objects.size(), 5U);
    for (std::uint32_t i = 0; i < 5; ++i) {
        EXPECT_EQ(state.objects[i].instance, i);
        expectNear(glm::vec3(state.objects[i].world_from_object[3]), {2.0F * static_cast<float>(i), 0, 0});
    }
    expectNear(state.bounds_ws.max, {10, 4, 0});
}

TEST(State, KeepsObjectsOfOneMeshTogether)
{
    Scene scene = triangleScene();
    scene.meshes.push_back(triangleMesh());
    scene.nodes.resize(6);
    for (std::uint32_t i = 0; i < 6; ++i) {
        scene.nodes[i].mesh = i % 2;
    }
    finishScene(scene);
    const State state = evaluate(scene, 0.0);
    for (std::size_t i = 1; i < state.objects.size(); ++i) {
        EXPECT_LE(state.objects[i - 1].mesh, state.objects[i].mesh);
        if (state.objects[i - 1].mesh == state.objects[i].mesh) {
            EXPECT_LT(state.objects[i - 1].node, state.objects[i].node);
        }
    }
}

TEST(State, AddsMorphTargetsByWeight)
{
    Scene scene = triangleScene();
    Primitive& primitive = scene.meshes[0].primitives[0];
    primitive.morph_targets.resize(2);
    primitive.morph_targets[0].positions = {{0, 0, 1}, {0, 0, 2}, {0, 0, 3}};
    primitive.morph_targets[1].positions = {{1, 0, 0}, {1, 0, 0}, {1, 0, 0}};
    primitive.morph_targets[1].normals.assign(3, glm::vec3(0, 1, 0));
    scene.meshes[0].morph_weights = {0.5F, 0.0F};
    scene.nodes[0].transform.translation = {0, 10, 0};
    finishScene(scene);
    State state = evaluate(scene, 0.0);
    ASSERT_EQ(state.deformed.size(), 1U);
    EXPECT_EQ(state.deformed[0].object, 0U);
    expectNear(state.deformed[0].positions[2], {0, 2, 1.5F});  // object space
    expectNear(state.objects[0].bounds_ws.max, {1, 12, 1.5F}); // world space
    scene.nodes[0].morph_weights = {0.0F, 1.0F};               // the node's own go before the mesh's
    state = evaluate(scene, 0.0);
    expectNear(state.deformed[0].positions[1], {2, 0, 0});
    expectNear(state.deformed[0].normals[0], glm::normalize(glm::vec3(0, 1, 1)));
}

TEST(State, SkinsInWorldSpace)
{
    Scene scene = skinnedScene();
    finishScene(scene);
    State state = evaluate(scene, 0.0);
    ASSERT_EQ(state.deformed.size(), 1U);
    EXPECT_EQ(state.objects[0].world_from_object, glm::mat4(1.0F));
    expectNear(state.deformed[0].positions[1], {1, 0, 0}); // the bind pose
    // The upper joint turned by 90 degrees about z: (1, 0) about (0, 1) goes to (1, 2).
    scene.nodes[2].transform.rotation = glm::quat(std::cos(kHalfPi / 2), 0, 0, std::sin(kHalfPi / 2));
    scene.nodes[1].transform.translation = {0, 0, 4};
    state = evaluate(scene, 0.0);
    expectNear(state.deformed[0].positions[0], {0, 0, 4});
    expectNear(state.deformed[0].positions[1], {1, 2, 4});
    // (0, 2): half stays, half goes to (-1, 1).
    expectNear(state.deformed[0].positions[2], {-0.5F, 1.5F, 4});
    expectNear(state.objects[0].bounds_ws.min, {-0.5F, 0, 4});
    expectNear(state.objects[0].bounds_ws.max, {1, 2, 4});
    expectNear(state.deformed[0].normals[1], {0, 0, 1});
}

TEST(State, SkinnedNormalsAreRightUnderUnevenScaleAndMirrors)
{
    Scene scene = skinnedScene();
    scene.meshes[0].primitives[0].normals.assign(3, glm::normalize(glm::vec3(1, 1, 0)));
    finishScene(scene);
    scene.nodes[1].transform.scale = {2, 1, 1};
    expectNear(evaluate(scene, 0.0).deformed[0].normals[0], glm::normalize(glm::vec3(0.5F, 1, 0)));
    scene.nodes[1].transform.scale = {-1, 1, 1};
    expectNear(evaluate(scene, 0.0).deformed[0].normals[0], glm::normalize(glm::vec3(-1, 1, 0)));
}

TEST(State, AdvanceEqualsEvaluateForDeformingGeometryAndAllocatesNothing)
{
    Scene scene = skinnedScene();
    scene.meshes[0].primitives[0].morph_targets.resize(1);
    scene.meshes[0].primitives[0].morph_targets[0].positions.assign(3, glm::vec3(0, 0, 1));
    scene.meshes[0].morph_weights = {0.0F};
    Animation& animation = scene.animations.emplace_back();
    animation.duration_s = 1.0F;
    AnimationChannel& turn = animation.channels.emplace_back();
    turn.node = 2;
    turn.path = AnimationPath::rotation;
    turn.times_s = {0.0F, 1.0F};
    turn.values = {0, 0, 0, 1, 0, 0, std::sin(kHalfPi / 2), std::cos(kHalfPi / 2)};
    AnimationChannel& swell = animation.channels.emplace_back();
    swell.node = 0;
    swell.path = AnimationPath::weights;
    swell.times_s = {0.0F, 1.0F};
    swell.values = {0.0F, 1.0F};
    finishScene(scene);
    State state = evaluate(scene, 0.0);
    EXPECT_TRUE(state.objects[0].dynamic); // because of its joints
    advance(scene, 0.5, state);
    const std::uint64_t before = test::heapAllocations();
    for (const double t : {0.9, 0.1, 0.7}) {
        advance(scene, t, state);
    }
    EXPECT_EQ(test::heapAllocations(), before);
    const State fresh = evaluate(scene, 0.7);
    EXPECT_EQ(state.deformed[0].positions, fresh.deformed[0].positions);
    EXPECT_EQ(state.deformed[0].normals, fresh.deformed[0].normals);
    EXPECT_EQ(state.objects[0].bounds_ws.min, fresh.objects[0].bounds_ws.min);
    EXPECT_EQ(state.bounds_ws.max, fresh.bounds_ws.max);
    EXPECT_GT(state.deformed[0].positions[0].z, 0.5F);
}

TEST(State, PlacesLightsAndCamerasDownMinusZ)
{
    Scene scene;
    scene.nodes.resize(2);
    scene.lights.resize(1);
    scene.cameras.resize(1);
    scene.nodes[0].light = 0;
    scene.nodes[0].transform.rotation = glm::quat(std::cos(kHalfPi / 2), -std::sin(kHalfPi / 2), 0, 0); // -z to -y
    scene.nodes[0].transform.scale = {3, 1, 0.5F};
    scene.nodes[1].camera = 0;
    scene.nodes[1].transform.translation = {1, 2, 3};
    finishScene(scene);
    const State state = evaluate(scene, 0.0);
    ASSERT_EQ(state.lights.size(), 1U);
    expectNear(state.lights[0].direction_ws, {0, -1, 0});
    expectNear(state.lights[0].up_ws, {0, 0, -1});
    ASSERT_EQ(state.cameras.size(), 1U);
    expectNear(state.cameras[0].eye_ws, {1, 2, 3});
    expectNear(state.cameras[0].forward_ws, {0, 0, -1});
    EXPECT_TRUE(state.bounds_ws.empty());
}

TEST(FinishScene, RefusesAChildBeforeItsParent)
{
    Scene scene;
    scene.nodes.resize(2);
    scene.nodes[0].parent = 1;
    EXPECT_THROW(finishScene(scene), Error);
    scene.nodes[0].parent = 0;
    EXPECT_THROW(finishScene(scene), Error);
}

TEST(FinishScene, MakesFlatNormalsAndUnsharedCorners)
{
    Scene scene = triangleScene();
    Primitive& primitive = scene.meshes[0].primitives[0];
    primitive.normals.clear();
    primitive.positions.emplace_back(0, 0, 1);
    primitive.uv0 = {{0, 0}, {1, 0}, {0, 1}, {1, 1}};
    primitive.indices = {0, 1, 2, 0, 3, 1};
    finishScene(scene);
    ASSERT_EQ(primitive.positions.size(), 6U);
    ASSERT_EQ(primitive.normals.size(), 6U);
    expectNear(primitive.normals[2], {0, 0, 1});
    expectNear(primitive.normals[3], {0, 1, 0});
    EXPECT_EQ(primitive.uv0[4], glm::vec2(1, 1));
    expectNear(primitive.bounds.max, {1, 2, 1});
}

TEST(FinishScene, MakesTangentsWhereANormalMapNeedsThem)
{
    Scene scene = triangleScene();
    scene.materials.resize(2);
    scene.materials[1].normal_texture.texture = 0;
    Primitive& primitive = scene.meshes[0].primitives[0];
    primitive.uv0 = {{0, 1}, {1, 1}, {0, 0}}; // v down the image, so up is -v
    primitive.material = 0;
    finishScene(scene);
    EXPECT_TRUE(primitive.tangents.empty());
    primitive.material = 1;
    finishScene(scene);
    ASSERT_EQ(primitive.tangents.size(), 3U);
    expectNear(glm::vec3(primitive.tangents[0]), {1, 0, 0});
    EXPECT_EQ(primitive.tangents[0].w, 1.0F); // the bitangent points up the image, as green does
}

TEST(FinishScene, CarriesTheDynamicHintToChildren)
{
    Scene scene;
    scene.nodes.resize(4);
    scene.nodes[1].parent = 0;
    scene.nodes[2].parent = 1;
    scene.animations.emplace_back().channels.emplace_back().node = 1;
    finishScene(scene);
    EXPECT_FALSE(scene.nodes[0].dynamic);
    EXPECT_TRUE(scene.nodes[1].dynamic);
    EXPECT_TRUE(scene.nodes[2].dynamic);
    EXPECT_FALSE(scene.nodes[3].dynamic);
}

} // namespace
} // namespace gnomon::scene
