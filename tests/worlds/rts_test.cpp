// SPDX-License-Identifier: Apache-2.0
// The promises of the world `rts`.
#include "allocation_count.h"
#include "same_bytes.h"

#include "scene/state.h"
#include "worlds/rts.h"
#include "worlds/worlds.h"

#include <glm/geometric.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <string_view>

namespace gnomon::worlds {
namespace {

using namespace scene;

std::size_t triangles(const Mesh& mesh)
{
    std::size_t count = 0;
    for (const Primitive& primitive : mesh.primitives) {
        count += primitive.indices.size() / 3;
    }
    return count;
}

std::size_t countNodes(const Scene& scene, std::string_view prefix)
{
    std::size_t count = 0;
    for (const Node& node : scene.nodes) {
        count += node.name.starts_with(prefix) ? 1 : 0;
    }
    return count;
}

const Scene& rts()
{
    static const Scene scene = load("rts", 1);
    return scene;
}

TEST(Rts, HasWhatWasPromised)
{
    const Scene& scene = rts();
    std::size_t terrain = 0;
    for (const Mesh& mesh : scene.meshes) {
        terrain += mesh.name.starts_with("terrain/") ? triangles(mesh) : 0;
    }
    EXPECT_GE(terrain, 130'000U);
    EXPECT_EQ(countNodes(scene, "terrain/"), 256U);
    EXPECT_EQ(countNodes(scene, "building/"), 60U);
    EXPECT_EQ(countNodes(scene, "debris/"), 2000U);
    EXPECT_EQ(countNodes(scene, "unit/"), 3U * 400U);
    EXPECT_EQ(scene.lights.size(), 1U);
    EXPECT_EQ(scene.lights[0].type, LightType::directional);
    ASSERT_EQ(scene.views.size(), 4U);
    EXPECT_EQ(scene.views[0].name, "camp");
    EXPECT_EQ(scene.views[1].name, "unit");
    EXPECT_EQ(scene.views[2].name, "map");
    EXPECT_EQ(scene.views[3].name, "giant");
    std::size_t trees = 0;
    for (const Node& node : scene.nodes) {
        if (node.name.starts_with("grove/")) {
            trees += node.instances.size();
            EXPECT_LE(triangles(scene.meshes[node.mesh]), 150U) << node.name;
        }
    }
    EXPECT_EQ(trees, 400U);
}

TEST(Rts, KeepsShapesLight)
{
    const Scene& scene = rts();
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        const Node& node = scene.nodes[i];
        if (node.name.starts_with("unit/") && node.parent == kNone) {
            const std::size_t whole = triangles(scene.meshes[node.mesh]) +
                                      triangles(scene.meshes[scene.nodes[i + 1].mesh]) +
                                      triangles(scene.meshes[scene.nodes[i + 2].mesh]);
            EXPECT_LE(whole, 270U) << node.name;
        }
        if (node.name.starts_with("debris/")) {
            EXPECT_GE(triangles(scene.meshes[node.mesh]), 12U);
            EXPECT_LE(triangles(scene.meshes[node.mesh]), 40U);
            EXPECT_TRUE(node.casts);
        }
    }
    EXPECT_LE(scene.meshes.size(), 256U + 120U); // everything but terrain and water is shared
}

TEST(Rts, HasAlphaMaskedLeavesThatCoverPartOfTheirCards)
{
    const Scene& scene = rts();
    int masked = 0;
    for (const Material& material : scene.materials) {
        if (material.alpha_mode != AlphaMode::mask) {
            continue;
        }
        ++masked;
        const Image& image = scene.images[scene.textures[material.base_colour_texture.texture].image];
        std::size_t solid = 0;
        for (std::size_t i = 3; i < image.rgba.size(); i += 4) {
            solid += image.rgba[i] >= 128 ? 1 : 0;
        }
        const double share = static_cast<double>(solid) / (static_cast<double>(image.width) * image.height);
        EXPECT_GT(share, 0.15) << image.name;
        EXPECT_LT(share, 0.85) << image.name;
    }
    EXPECT_GE(masked, 2);
}

TEST(Rts, DebrisFloatsAboveTheUnitsAndEverythingStaysInBounds)
{
    const Scene& scene = rts();
    State state = evaluate(scene, 0.0);
    for (const double time_s : {0.0, 60.0, 3600.0}) {
        advance(scene, time_s, state);
        for (const Object& object : state.objects) {
            const Node& node = scene.nodes[object.node];
            if (node.name.starts_with("debris/")) {
                EXPECT_GT(object.bounds_ws.min.y, 18.0F) << node.name;
            }
            EXPECT_LT(object.bounds_ws.max.y, 90.0F) << node.name;
            EXPECT_GT(object.bounds_ws.min.y, -20.0F) << node.name;
            EXPECT_LT(std::abs(object.bounds_ws.centre().x), 260.0F) << node.name;
            EXPECT_LT(std::abs(object.bounds_ws.centre().z), 260.0F) << node.name;
        }
    }
}

TEST(Rts, UnitsWalkAtAWalkingPaceOnTheGround)
{
    const Scene& scene = rts();
    std::vector<Node> before = scene.nodes;
    std::vector<Node> after = scene.nodes;
    scene.procedural(5.0, before);
    scene.procedural(5.5, after);
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        if (scene.nodes[i].name.starts_with("unit/") && scene.nodes[i].parent == kNone) {
            const glm::vec3 way = after[i].transform.translation - before[i].transform.translation;
            const float speed = glm::length(glm::vec2(way.x, way.z)) / 0.5F;
            EXPECT_GT(speed, 0.9F) << scene.nodes[i].name;
            EXPECT_LT(speed, 2.1F) << scene.nodes[i].name;
            EXPECT_LT(std::abs(way.y), 0.8F) << scene.nodes[i].name;
            const glm::vec3 facing = after[i].transform.rotation * glm::vec3(0, 0, 1);
            EXPECT_GT(glm::dot(glm::normalize(glm::vec3(way.x, 0, way.z)), facing), 0.9F) << scene.nodes[i].name;
        }
    }
}

TEST(Rts, OnlyTerrainTooFlatToShadeAnythingDoesNotCast)
{
    const Scene& scene = rts();
    std::size_t casting = 0;
    for (const Node& node : scene.nodes) {
        if (!node.name.starts_with("terrain/")) {
            continue;
        }
        casting += node.casts ? 1 : 0;
        const Primitive& primitive = scene.meshes[node.mesh].primitives[0];
        float steepest = 0.0F;
        for (std::size_t i = 0; i < primitive.indices.size(); i += 3) {
            const std::uint32_t* v = &primitive.indices[i];
            const glm::vec3 n = glm::normalize(glm::cross(primitive.positions[v[1]] - primitive.positions[v[0]],
                                                          primitive.positions[v[2]] - primitive.positions[v[0]]));
            steepest = std::max(steepest, std::sqrt(1.0F - n.y * n.y) / n.y);
        }
        EXPECT_TRUE(node.casts || steepest <= kFlatChunkSlope + 1e-4F) << node.name << " " << steepest;
    }
    EXPECT_GT(casting, 40U);
    EXPECT_LT(casting, 256U);
}

} // namespace
} // namespace gnomon::worlds
