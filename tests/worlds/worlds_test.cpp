// SPDX-License-Identifier: Apache-2.0
// The promises of the built-in worlds.
#include "worlds/planes.h"
#include "worlds/worlds.h"

#include "scene/hash.h"
#include "scene/state.h"

#include "same_bytes.h"

#include <glm/geometric.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

namespace gnomon::worlds {
namespace {

using namespace scene;

bool sameTransform(const Transform& a, const Transform& b)
{
    return a.translation == b.translation && a.rotation == b.rotation && a.scale == b.scale;
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
        const std::vector<glm::vec3>& positions =
            object.deformed != kNone ? state.deformed[object.deformed].positions
                                     : scene_.meshes[object.mesh].primitives[object.primitive].positions;
        const glm::vec3 slack(1e-3F);
        const auto isCutAway = [&](const glm::vec3& p) {
            return std::ranges::any_of(
                object.clip_planes, [&](const glm::vec4& plane) { return glm::dot(plane, glm::vec4(p, 1.0F)) < 0.0F; });
        };
        for (std::size_t v = 0; v < positions.size(); v += 7) {
            if (isCutAway(positions[v])) {
                continue;
            }
            const glm::vec3 p(object.world_from_object * glm::vec4(positions[v], 1.0F));
            ASSERT_TRUE((Aabb{object.bounds_ws.min - slack, object.bounds_ws.max + slack}).contains({p, p}))
                << scene_.nodes[object.node].name;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(All, Worlds, testing::ValuesIn(all().begin(), all().end()),
                         [](const auto& world) { return std::string(world.param.name); });

TEST(Planes, ProjectsAsItsHeaderSays)
{
    const Scene scene = load("planes", 0);
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
    const Scene scene = load("spotlit", 0);
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

} // namespace
} // namespace gnomon::worlds
