// SPDX-License-Identifier: Apache-2.0
// What the built-in worlds promise.
#include "scene/worlds.h"

#include "scene/load.h"
#include "scene/state.h"

#include "allocation_count.h"

#include <gnomon/error.h>

#include <glm/geometric.hpp>

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <set>

namespace gnomon::scene {
namespace {

template <typename T>
bool sameBytes(const std::vector<T>& a, const std::vector<T>& b)
{
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

bool sameTransform(const Transform& a, const Transform& b)
{
    return a.translation == b.translation && a.rotation == b.rotation && a.scale == b.scale;
}

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
    static const Scene scene = makeRts(1);
    return scene;
}

class Worlds : public testing::TestWithParam<World> {
protected:
    const Scene scene_ = GetParam().make(7);
};

TEST_P(Worlds, HaveANameViewsAndLights)
{
    EXPECT_EQ(scene_.name, GetParam().name);
    EXPECT_FALSE(GetParam().summary.empty());
    EXPECT_FALSE(scene_.views.empty());
    for (const NamedView& view : scene_.views) {
        EXPECT_FALSE(view.name.empty());
        EXPECT_GT(glm::distance(view.eye, view.target), 0.1F);
    }
    EXPECT_FALSE(scene_.lights.empty());
    for (const Light& light : scene_.lights) {
        EXPECT_FALSE(light.name.empty());
        EXPECT_GT(light.intensity, 0.0F);
    }
    for (const Node& node : scene_.nodes) {
        EXPECT_FALSE(node.name.empty());
    }
    for (const Material& material : scene_.materials) {
        EXPECT_FALSE(material.name.empty());
    }
}

TEST_P(Worlds, AreWellFormed)
{
    for (std::size_t i = 0; i < scene_.nodes.size(); ++i) {
        const Node& node = scene_.nodes[i];
        EXPECT_TRUE(node.parent == kNone || node.parent < i);
        EXPECT_TRUE(node.mesh == kNone || node.mesh < scene_.meshes.size());
        EXPECT_NEAR(glm::length(node.transform.rotation), 1.0F, 1e-3F) << node.name;
    }
    for (const Mesh& mesh : scene_.meshes) {
        EXPECT_FALSE(mesh.primitives.empty()) << mesh.name;
        for (const Primitive& primitive : mesh.primitives) {
            ASSERT_LT(primitive.material, scene_.materials.size()) << mesh.name;
            const std::size_t count = primitive.positions.size();
            ASSERT_EQ(primitive.normals.size(), count);
            ASSERT_TRUE(primitive.uv0.empty() || primitive.uv0.size() == count);
            ASSERT_TRUE(primitive.colours.empty() || primitive.colours.size() == count);
            ASSERT_EQ(primitive.indices.size() % 3, 0U);
            for (const std::uint32_t index : primitive.indices) {
                ASSERT_LT(index, count) << mesh.name;
            }
            for (std::size_t v = 0; v < count; ++v) {
                const glm::vec3& p = primitive.positions[v];
                ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) << mesh.name;
                ASSERT_NEAR(glm::length(primitive.normals[v]), 1.0F, 1e-3F) << mesh.name;
                ASSERT_TRUE(primitive.bounds.contains({p, p})) << mesh.name;
            }
        }
    }
    for (const Image& image : scene_.images) {
        EXPECT_EQ(image.rgba.size(), std::size_t{4} * image.width * image.height) << image.name;
    }
}

/// Faces must be seen from where their normals point, or culling and biasing would take the wrong side.
TEST_P(Worlds, WindFacesTheWayTheirNormalsPoint)
{
    for (const Mesh& mesh : scene_.meshes) {
        for (const Primitive& primitive : mesh.primitives) {
            if (scene_.materials[primitive.material].double_sided) {
                continue;
            }
            for (std::size_t i = 0; i < primitive.indices.size(); i += 3) {
                const std::uint32_t* v = &primitive.indices[i];
                const glm::vec3 face = glm::cross(primitive.positions[v[1]] - primitive.positions[v[0]],
                                                  primitive.positions[v[2]] - primitive.positions[v[0]]);
                const glm::vec3 normal = primitive.normals[v[0]] + primitive.normals[v[1]] + primitive.normals[v[2]];
                ASSERT_GE(glm::dot(face, normal), -1e-6F) << mesh.name << " triangle " << i / 3;
            }
        }
    }
}

TEST_P(Worlds, AreTheSameWhenMadeTwice)
{
    const Scene again = GetParam().make(7);
    ASSERT_EQ(again.nodes.size(), scene_.nodes.size());
    ASSERT_EQ(again.meshes.size(), scene_.meshes.size());
    ASSERT_EQ(again.images.size(), scene_.images.size());
    for (std::size_t i = 0; i < scene_.nodes.size(); ++i) {
        EXPECT_TRUE(sameTransform(again.nodes[i].transform, scene_.nodes[i].transform));
        EXPECT_TRUE(sameBytes(again.nodes[i].instances, scene_.nodes[i].instances));
    }
    for (std::size_t i = 0; i < scene_.meshes.size(); ++i) {
        for (std::size_t p = 0; p < scene_.meshes[i].primitives.size(); ++p) {
            const Primitive& a = scene_.meshes[i].primitives[p];
            const Primitive& b = again.meshes[i].primitives[p];
            EXPECT_TRUE(sameBytes(a.positions, b.positions) && sameBytes(a.normals, b.normals) &&
                        sameBytes(a.colours, b.colours) && sameBytes(a.uv0, b.uv0) && sameBytes(a.indices, b.indices));
        }
    }
    for (std::size_t i = 0; i < scene_.images.size(); ++i) {
        EXPECT_EQ(again.images[i].rgba, scene_.images[i].rgba);
    }
}

TEST_P(Worlds, AdvanceToATimeEqualsEvaluatingItInAnyOrder)
{
    State state = evaluate(scene_, 3.0);
    for (const double time_s : {40.0, 0.0, 1234.5, 7.25}) {
        advance(scene_, time_s, state);
        const State fresh = evaluate(scene_, time_s);
        ASSERT_EQ(state.objects.size(), fresh.objects.size());
        for (std::size_t i = 0; i < state.objects.size(); ++i) {
            ASSERT_EQ(state.objects[i].world_from_object, fresh.objects[i].world_from_object) << i;
            ASSERT_EQ(state.objects[i].bounds_ws.min, fresh.objects[i].bounds_ws.min) << i;
            ASSERT_EQ(state.objects[i].bounds_ws.max, fresh.objects[i].bounds_ws.max) << i;
        }
        EXPECT_EQ(state.bounds_ws.min, fresh.bounds_ws.min);
        EXPECT_EQ(state.bounds_ws.max, fresh.bounds_ws.max);
        EXPECT_EQ(state.time_s, time_s);
        for (std::size_t i = 0; i < state.lights.size(); ++i) {
            EXPECT_EQ(state.lights[i].direction_ws, fresh.lights[i].direction_ws);
            EXPECT_EQ(state.lights[i].up_ws, fresh.lights[i].up_ws);
        }
    }
}

TEST_P(Worlds, MoveOnlyWhatTheyCallDynamic)
{
    if (!scene_.procedural) {
        for (const Node& node : scene_.nodes) {
            EXPECT_FALSE(node.dynamic) << node.name;
        }
        return;
    }
    std::vector<Node> nodes = scene_.nodes;
    std::set<std::size_t> moved;
    for (const double time_s : {0.0, 0.4, 11.0}) {
        scene_.procedural(time_s, nodes);
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            if (!sameTransform(nodes[i].transform, scene_.nodes[i].transform)) {
                moved.insert(i);
            }
        }
    }
    EXPECT_FALSE(moved.empty());
    for (const std::size_t i : moved) {
        EXPECT_TRUE(scene_.nodes[i].dynamic) << scene_.nodes[i].name;
    }
}

TEST_P(Worlds, ObjectBoundsHoldTheirVertices)
{
    const State state = evaluate(scene_, 2.0);
    for (const Object& object : state.objects) {
        ASSERT_TRUE(state.bounds_ws.contains(object.bounds_ws));
        const Primitive& primitive = scene_.meshes[object.mesh].primitives[object.primitive];
        const glm::vec3 slack(1e-3F);
        for (std::size_t v = 0; v < primitive.positions.size(); v += 7) {
            const glm::vec3 p(object.world_from_object * glm::vec4(primitive.positions[v], 1.0F));
            ASSERT_TRUE((Aabb{object.bounds_ws.min - slack, object.bounds_ws.max + slack}).contains({p, p}))
                << scene_.nodes[object.node].name;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(All, Worlds, testing::ValuesIn(worlds().begin(), worlds().end()),
                         [](const auto& world) { return std::string(world.param.name); });

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
    ASSERT_EQ(scene.views.size(), 3U);
    EXPECT_EQ(scene.views[0].name, "camp");
    EXPECT_EQ(scene.views[1].name, "unit");
    EXPECT_EQ(scene.views[2].name, "map");
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
            EXPECT_LE(whole, 265U) << node.name;
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

TEST(Rts, AnotherSeedIsAnotherMap)
{
    const Scene other = makeRts(2);
    EXPECT_FALSE(sameBytes(other.meshes[0].primitives[0].positions, rts().meshes[0].primitives[0].positions));
    EXPECT_EQ(countNodes(other, "building/"), 60U);
}

TEST(Rts, AdvanceAllocatesNothingOnceWarm)
{
    const Scene& scene = rts();
    State state = evaluate(scene, 0.0);
    advance(scene, 0.1, state);
    const std::size_t before = allocationCount();
    constexpr int kFrames = 200;
    const auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < kFrames; ++i) {
        advance(scene, 0.016 * i, state);
    }
    const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - start;
    EXPECT_EQ(allocationCount(), before);
    std::size_t dynamic = 0;
    for (const Object& object : state.objects) {
        dynamic += object.dynamic ? 1 : 0;
    }
    std::printf("advance: %.3f ms (%zu objects, %zu of them dynamic)\n", taken.count() / kFrames, state.objects.size(),
                dynamic);
    EXPECT_GT(dynamic, 3000U);
}

TEST(Planes, ProjectsAsItsHeaderSays)
{
    const Scene scene = makePlanes(0);
    const State state = evaluate(scene, 0.0);
    ASSERT_EQ(state.lights.size(), 2U);
    EXPECT_NEAR(glm::distance(state.lights[0].direction_ws, glm::normalize(PlanesWorld::sun_direction)), 0.0F, 1e-6F);
    EXPECT_EQ(state.lights[1].position_ws, PlanesWorld::spot_position);
    const glm::vec3 to_target = glm::normalize(PlanesWorld::spot_target - PlanesWorld::spot_position);
    EXPECT_NEAR(glm::distance(state.lights[1].direction_ws, to_target), 0.0F, 1e-6F);
    // A corner at height 3 throws its shadow 2.25 m along +x.
    const glm::vec3 corner = PlanesWorld::box_max;
    EXPECT_EQ(PlanesWorld::projectAlongSun(corner), glm::vec3(corner.x + 2.25F, 0.0F, corner.z));
    const glm::vec3 hit = PlanesWorld::projectFrom(PlanesWorld::spot_position, corner);
    EXPECT_NEAR(glm::length(glm::cross(hit - PlanesWorld::spot_position, corner - PlanesWorld::spot_position)), 0.0F,
                1e-4F);
    bool found = false;
    for (const Object& object : state.objects) {
        found = found || (object.bounds_ws.min == PlanesWorld::box_min && object.bounds_ws.max == PlanesWorld::box_max);
    }
    EXPECT_TRUE(found);
}

TEST(Spotlit, HasThreeSpotLightsWithCookies)
{
    const Scene scene = makeSpotlit(0);
    ASSERT_EQ(scene.lights.size(), 3U);
    std::set<std::uint32_t> cookies;
    for (const Light& light : scene.lights) {
        EXPECT_EQ(light.type, LightType::spot);
        ASSERT_LT(light.cookie, scene.images.size());
        cookies.insert(light.cookie);
        const Image& image = scene.images[light.cookie];
        // The border is dark, so that nothing outside the cone is lit whatever the filter.
        for (std::uint32_t x = 0; x < image.width; ++x) {
            EXPECT_LE(image.rgba[std::size_t{4} * x], 2) << image.name;
        }
    }
    EXPECT_EQ(cookies.size(), 3U);
    bool phong = false;
    for (const Material& material : scene.materials) {
        phong = phong || material.model == ShadingModel::phong;
    }
    EXPECT_TRUE(phong);
    for (const Node& node : scene.nodes) {
        if (node.name.ends_with("housing")) {
            EXPECT_FALSE(node.casts);
        }
    }
}

TEST(Load, FindsWorldsByName)
{
    EXPECT_EQ(load("planes", 1).name, "planes");
}

TEST(Load, NamesTheWorldsWhenThereIsNeitherWorldNorFile)
{
    try {
        (void)load("no such thing", 1);
        FAIL() << "no error";
    } catch (const Error& error) {
        const std::string text = error.what();
        EXPECT_NE(text.find("no such thing"), std::string::npos) << text;
        for (const World& world : worlds()) {
            EXPECT_NE(text.find(world.name), std::string::npos) << text;
        }
    }
}

TEST(Load, RefusesADirectory)
{
    const std::string folder = std::filesystem::temp_directory_path().string();
    try {
        (void)load(folder, 1);
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("directory"), std::string::npos) << error.what();
    }
}

} // namespace
} // namespace gnomon::scene
