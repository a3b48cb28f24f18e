// SPDX-License-Identifier: Apache-2.0
// The facts of worlds/ring.h about the world `ring`.
#include "allocation_count.h"
#include "same_bytes.h"

#include "scene/state.h"
#include "worlds/ring.h"
#include "worlds/worlds.h"

#include <glm/geometric.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

namespace gnomon::worlds {
namespace {

using namespace scene;

using World = RingWorld;

const Scene& ring()
{
    static const Scene scene = load("ring", 1);
    return scene;
}

const State& ringAtZero()
{
    static const State state = evaluate(ring(), 0.0);
    return state;
}

std::size_t countNodes(const Scene& scene, std::string_view prefix)
{
    std::size_t count = 0;
    for (const Node& node : scene.nodes) {
        count += node.name.starts_with(prefix) ? 1 : 0;
    }
    return count;
}

/// Metres from the axis.
double fromAxis(const glm::vec3& p)
{
    return std::hypot(static_cast<double>(p.x), static_cast<double>(p.y) - World::radius_m);
}

TEST(RingWorldNumbers, TilesGoRoundOnce)
{
    EXPECT_NEAR(World::tile_m * World::tiles_around, 2.0 * std::numbers::pi * World::radius_m, 1e-9);
    EXPECT_EQ(World::sectors * World::sector_tiles, World::tiles_around);
    EXPECT_EQ(World::angleOf(0.0), 0.0);
    EXPECT_NEAR(World::angleOf(24.0), std::numbers::pi / 2.0, 1e-12);
    for (const double tiles : {-4.0, 3.25, 47.5}) {
        EXPECT_EQ(World::place(tiles, 1.0, 2.0), World::place(tiles + World::tiles_around, 1.0, 2.0));
        EXPECT_NEAR(glm::dot(World::up(tiles), World::along(tiles)), 0.0F, 1e-6F);
        const glm::vec3 off = World::place(tiles, 1.5, -3.0) - World::place(tiles, 0.5, -3.0);
        EXPECT_NEAR(glm::distance(off, World::up(tiles)), 0.0F, 1e-5F);
        EXPECT_NEAR(fromAxis(World::place(tiles, 1.5, 7.0)), World::radius_m - 1.5, 1e-5);
    }
    EXPECT_GT(World::place(2.0, 0.0, 0.0).x, 3.9F);
    EXPECT_GT(World::place(4.0, 0.0, 0.0).y, 0.9F) << "the deck rises";
}

TEST(Ring, HasWhatWasPromised)
{
    const Scene& scene = ring();
    EXPECT_EQ(countNodes(scene, "deck/"), std::size_t{World::tiles_around} * World::tiles_across);
    EXPECT_EQ(countNodes(scene, "hull/"), std::size_t{4} * World::tiles_around);
    EXPECT_GT(countNodes(scene, "wall/"), 150U);
    EXPECT_GT(countNodes(scene, "room/"), 400U);
    EXPECT_GE(countNodes(scene, "walker/"), 5U * 40U);
    ASSERT_EQ(scene.views.size(), 4U);
    constexpr std::array<const char*, 4> kViews{"deck", "bar", "overview", "duel"};
    for (std::size_t i = 0; i < kViews.size(); ++i) {
        EXPECT_EQ(scene.views[i].name, kViews[i]);
    }
    const std::size_t objects = ringAtZero().objects.size();
    EXPECT_GE(objects, 1500U);
    EXPECT_LE(objects, 4000U);
    std::size_t masked = 0;
    for (const Object& object : ringAtZero().objects) {
        masked += scene.materials[object.material].alpha_mode == AlphaMode::mask ? 1 : 0;
    }
    EXPECT_GT(masked, 80U) << "objects of leaves";
}

TEST(Ring, HasManyPointLightsOfManyKindsAndSomeCastNoShadow)
{
    std::size_t casting = 0;
    std::size_t moods = 0;
    std::set<std::tuple<float, float, float>> colours;
    std::set<float> ranges;
    std::set<float> radii;
    for (const Light& light : ring().lights) {
        EXPECT_EQ(light.type, LightType::point) << light.name;
        EXPECT_GT(light.range_m, 0.0F) << light.name;
        EXPECT_GT(light.radius_m, 0.0F) << light.name;
        EXPECT_EQ(light.casts_shadow, !light.name.starts_with("mood ")) << light.name;
        (light.casts_shadow ? casting : moods) += 1;
        colours.emplace(light.colour.x, light.colour.y, light.colour.z);
        ranges.insert(light.range_m);
        radii.insert(light.radius_m);
    }
    EXPECT_GE(casting, 60U);
    EXPECT_GE(moods, 10U);
    EXPECT_LE(casting + moods, 128U);
    EXPECT_GE(colours.size(), 7U);
    EXPECT_GE(ranges.size(), 10U);
    EXPECT_GE(radii.size(), 7U);
}

/// A lamp casts around its own light, and its bulb, which the light is inside, does not.
TEST(Ring, LightsAreInsideTheirLamps)
{
    const Scene& scene = ring();
    const State& state = ringAtZero();
    std::size_t lamps = 0;
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        const Node& node = scene.nodes[i];
        if (node.light == kNone || !scene.lights[node.light].casts_shadow) {
            continue;
        }
        ++lamps;
        const glm::vec3 place(state.world_from_node[i][3]);
        ASSERT_NE(node.parent, kNone) << node.name;
        Aabb lamp;
        std::size_t bulbs = 0;
        for (const Object& object : state.objects) {
            if (object.node == node.parent) {
                EXPECT_TRUE(object.casts) << node.name;
                for (const glm::vec3& p : scene.meshes[object.mesh].primitives[object.primitive].positions) {
                    const glm::vec3 surface(object.world_from_object * glm::vec4(p, 1.0F));
                    ASSERT_GT(glm::distance(surface, place), scene.lights[node.light].radius_m) << node.name;
                }
                lamp.min = glm::min(lamp.min, object.bounds_ws.min);
                lamp.max = glm::max(lamp.max, object.bounds_ws.max);
            }
            if (scene.nodes[object.node].parent == node.parent && scene.nodes[object.node].name.ends_with("/bulb")) {
                ++bulbs;
                EXPECT_FALSE(object.casts || object.receives) << node.name;
                EXPECT_NEAR(glm::distance(object.bounds_ws.centre(), place), 0.0F, 0.01F) << node.name;
                for (const glm::vec3& p : scene.meshes[object.mesh].primitives[object.primitive].positions) {
                    const glm::vec3 surface(object.world_from_object * glm::vec4(p, 1.0F));
                    const float share = glm::distance(surface, place) / scene.lights[node.light].radius_m;
                    ASSERT_GT(share, 1.0F) << node.name;
                    ASSERT_LT(share, 1.1F) << node.name;
                }
            }
        }
        EXPECT_EQ(bulbs, 1U) << node.name;
        EXPECT_TRUE(lamp.contains({place, place})) << node.name;
    }
    EXPECT_GE(lamps, 60U);
}

struct Corner {
    glm::vec3 normal{0.0F};
    int tiles = 0;
};

/// Every vertex along a tile's border is a vertex of its neighbour, to the bit, with the same normal.
TEST(Ring, TilesShareTheVerticesAndNormalsOfTheirBorders)
{
    const Scene& scene = ring();
    const auto less = [](const glm::vec3& a, const glm::vec3& b) {
        return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
    };
    std::map<glm::vec3, Corner, decltype(less)> corners(less);
    std::size_t vertices = 0;
    for (const Node& node : scene.nodes) {
        if (!node.name.starts_with("deck/") && !node.name.starts_with("hull/")) {
            continue;
        }
        const Primitive& primitive = scene.meshes[node.mesh].primitives[0];
        vertices += primitive.positions.size();
        for (std::size_t i = 0; i < primitive.positions.size(); ++i) {
            Corner& corner = corners[primitive.positions[i]];
            if (corner.tiles++ == 0) {
                corner.normal = primitive.normals[i];
            }
            ASSERT_NEAR(glm::distance(corner.normal, primitive.normals[i]), 0.0F, 1e-6F) << node.name;
        }
    }
    // All the way round, and across from one hull's upper border to the other's, no vertex is there twice: each of 9 by
    // 4 steps of the deck and 2 by 6 + 4 of the hulls, and one row more.
    constexpr std::size_t kRows = 4U * World::tiles_around;
    constexpr std::size_t kColumns = 4U * World::tiles_across + 2U * (6U + 4U) + 1U;
    EXPECT_EQ(corners.size(), kRows * kColumns);
    EXPECT_GT(vertices, corners.size());
}

TEST(Ring, WallsMeetTheirNeighboursToTheBit)
{
    const Scene& scene = ring();
    const auto verticesOf = [&](const std::string& name) {
        std::set<std::array<float, 3>> all;
        for (const Node& node : scene.nodes) {
            if (node.name == name) {
                for (const glm::vec3& p : scene.meshes[node.mesh].primitives[0].positions) {
                    all.insert({p.x, p.y, p.z});
                }
            }
        }
        return all;
    };
    for (const auto& [a, b] : {std::pair{"wall/+16", "wall/+17"}, std::pair{"wall/across -4,0", "wall/across -4,1"}}) {
        const auto first = verticesOf(a);
        const auto second = verticesOf(b);
        ASSERT_FALSE(first.empty()) << a;
        ASSERT_FALSE(second.empty()) << b;
        std::size_t shared = 0;
        for (const auto& p : first) {
            shared += second.count(p);
        }
        EXPECT_GE(shared, 8U) << a << " and " << b;
    }
}

TEST(Ring, EverythingOfTheStationStaysInsideItsHull)
{
    const Scene& scene = ring();
    State state = evaluate(scene, 0.0);
    for (const double time_s : {0.0, 60.0, 3600.0}) {
        advance(scene, time_s, state);
        for (const Object& object : state.objects) {
            const std::string& name = scene.nodes[object.node].name;
            if (name.starts_with("space/")) {
                EXPECT_FALSE(object.casts || object.receives) << name;
                continue;
            }
            if (object.bounds_ws.empty()) {
                EXPECT_NE(object.clip_planes, kNoClipPlanes) << name;
                continue;
            }
            const glm::vec3 centre = object.bounds_ws.centre();
            EXPECT_LT(std::abs(centre.z), World::half_width_m + 0.5) << name;
            if (!name.starts_with("beam/") && !name.starts_with("rail/") && !name.starts_with("line/")) {
                EXPECT_LT(fromAxis(centre), World::radius_m + 0.2) << name;
                EXPECT_GT(fromAxis(centre), World::radius_m - 7.0) << name;
            }
        }
    }
}

TEST(Ring, OnlyWhatShadesNothingDoesNotCast)
{
    for (const Node& node : ring().nodes) {
        if (node.mesh == kNone || node.casts) {
            continue;
        }
        bool known = node.name.ends_with("/bulb");
        for (const char* prefix : {"deck/", "hull/", "rail/", "rug/", "line/", "space/"}) {
            known = known || node.name.starts_with(prefix);
        }
        EXPECT_TRUE(known) << node.name;
    }
}

TEST(Ring, WalkersKeepTheirFeetOnTheDeckAndFaceTheirWay)
{
    const Scene& scene = ring();
    std::vector<Node> before = scene.nodes;
    std::vector<Node> after = scene.nodes;
    scene.procedural(500.0, before);
    scene.procedural(500.5, after);
    std::size_t walkers = 0;
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        const Node& node = scene.nodes[i];
        if (!node.name.starts_with("walker/") || node.parent != kNone) {
            continue;
        }
        ++walkers;
        const glm::vec3 from = before[i].transform.translation;
        const glm::vec3 way = after[i].transform.translation - from;
        EXPECT_GT(glm::length(way) / 0.5F, 0.6F) << node.name;
        EXPECT_LT(glm::length(way) / 0.5F, 1.7F) << node.name;
        const glm::vec3 facing = after[i].transform.rotation * glm::vec3(0, 0, 1);
        EXPECT_GT(glm::dot(glm::normalize(way), facing), 0.9F) << node.name;
        EXPECT_NEAR(fromAxis(from), World::radius_m, 0.12) << node.name;
        const glm::vec3 up = before[i].transform.rotation * glm::vec3(0, 1, 0);
        const glm::vec3 to_axis = glm::normalize(glm::vec3(-from.x, World::radius_m - from.y, 0.0));
        EXPECT_GT(glm::dot(up, to_axis), 0.9999F) << node.name;
    }
    EXPECT_GE(walkers, 40U);
}

TEST(Ring, EveryViewHasAHundredObjectsInFront)
{
    for (const NamedView& view : ring().views) {
        const glm::vec3 forward = glm::normalize(view.target - view.eye);
        std::size_t seen = 0;
        for (const Object& object : ringAtZero().objects) {
            const glm::vec3 to = object.bounds_ws.centre() - view.eye;
            const float along = glm::dot(to, forward);
            seen +=
                object.receives && along > 0.0F && along > std::cos(0.5F * view.fov_y_rad) * glm::length(to) ? 1 : 0;
        }
        EXPECT_GT(seen, 100U) << view.name;
        if (view.name != "overview") {
            EXPECT_LT(fromAxis(view.eye), World::radius_m) << view.name;
            EXPECT_LT(std::abs(view.eye.z), World::half_width_m) << view.name;
        }
    }
}

/// Deck, hull and all other rooms are whole. Things that hang on the front go with it.
TEST(Ring, TheFrontOfOneRoomIsCutAway)
{
    std::size_t walls = 0;
    std::size_t posts = 0;
    std::size_t gone = 0;
    for (const Object& object : ringAtZero().objects) {
        const std::string& name = ring().nodes[object.node].name;
        if (object.clip_planes == kNoClipPlanes) {
            EXPECT_FALSE(object.bounds_ws.empty()) << name;
            continue;
        }
        walls += name.starts_with("wall/-") ? 1 : 0;
        posts += name.starts_with("post/-") ? 1 : 0;
        if (object.bounds_ws.empty()) {
            ++gone;
            continue;
        }
        // Whole, the middle of its bounds would be at 1.4 m.
        EXPECT_GT(fromAxis(object.bounds_ws.centre()), World::radius_m - 1.2) << name;
        EXPECT_LT(object.bounds_ws.max.z, 0.0F) << name;
        EXPECT_LT(object.bounds_ws.min.x, 0.0F) << name;
    }
    EXPECT_EQ(walls, std::size_t{World::sector_tiles});
    EXPECT_GE(posts, 2U);
    EXPECT_EQ(gone, 4U) << "the walls over two doors, and a sign of two materials";
}

TEST(Ring, TheSeedMovesWalkersAndLeavesTheStation)
{
    const Scene other = load("ring", 2);
    ASSERT_EQ(other.nodes.size(), ring().nodes.size());
    bool moved = false;
    for (std::size_t i = 0; i < other.nodes.size(); ++i) {
        const bool same = other.nodes[i].transform.translation == ring().nodes[i].transform.translation;
        if (!other.nodes[i].dynamic) {
            EXPECT_TRUE(same) << other.nodes[i].name;
        }
        moved = moved || !same;
    }
    EXPECT_TRUE(moved);
}

} // namespace
} // namespace gnomon::worlds
