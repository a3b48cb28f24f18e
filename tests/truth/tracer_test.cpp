// SPDX-License-Identifier: Apache-2.0
// Input at the edge of sense, scenes far from the origin, and deformed ones.
#include "support.h"

#include "worlds/worlds.h"

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <set>

namespace gnomon::truth::test {
namespace {

TEST(Degenerate, triangles_and_transforms_do_no_harm)
{
    scene::Scene scene;
    place(scene, addQuad(scene, level(0.0F, 8.0F)));
    const std::uint32_t cube = addCube(scene);
    scene::Primitive& primitive = scene.meshes[cube].primitives[0];
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const auto first = static_cast<std::uint32_t>(primitive.positions.size());
    for (const glm::vec3& p : {glm::vec3(0.0F), glm::vec3(nan, 0.0F, 0.0F), glm::vec3(INFINITY, 1.0F, 1.0F)}) {
        primitive.positions.push_back(p);
        primitive.uv0.emplace_back(0.0F);
    }
    primitive.indices.insert(primitive.indices.end(), {first, first, first, 0, 0, 1, 0, 1, first + 1, 0, 1, first + 2});
    scene.nodes.reserve(16);
    place(scene, cube, glm::translate(glm::mat4(1.0F), glm::vec3(0.0F, 2.0F, 0.0F)));
    place(scene, cube, glm::mat4(0.0F));
    place(scene, cube,
          glm::scale(glm::translate(glm::mat4(1.0F), glm::vec3(-2.5F, 1.0F, 0.0F)), glm::vec3(1.0F, 0.0F, 1.0F)));
    place(scene, cube, glm::mat4(nan));
    place(scene, cube, glm::scale(glm::mat4(1.0F), glm::vec3(1e-30F)));
    scene.meshes.push_back({.name = "empty", .primitives = {scene::Primitive{}}});
    place(scene, static_cast<std::uint32_t>(scene.meshes.size() - 1));
    for (const Options& options : {hard(), area(20)}) {
        const Traced traced =
            trace(scene, lookAt({3.0, 5.0, 6.0}, {0.0, 1.0, 0.0}, 0.9, {40, 30}), sun({0.1, -1.0, 0.2}, 0.3), options);
        expectSound(traced);
        const auto& ids = traced.surfaces.object_ids.values;
        EXPECT_EQ(std::set(ids.begin(), ids.end()), (std::set<std::uint32_t>{0, 1, 2, 4})); // 4 is merely flat
    }
}

TEST(Degenerate, nothing_to_see)
{
    scene::Scene scene;
    const Traced traced = trace(scene, lookDown(0.0, 1.0, 1.0, {1, 1}), sun({0.0, -1.0, 0.0}), area(4));
    expectSound(traced);
    EXPECT_EQ(traced.id(0, 0), 0U);
    EXPECT_EQ(traced.at(0, 0), 1.0);
    EXPECT_EQ(*traced.surfaces.triangle_ids.pixel(0, 0), scene::kNone);
    EXPECT_EQ(traced.visibility.rays, 0U);
}

TEST(Degenerate, camera_and_light_inside_geometry_and_below_the_horizon)
{
    scene::Scene scene = worlds::load("planes", 1);
    // In the box: its sides are seen through, and the ground below it is dark under a light outside it.
    const Traced inside = trace(scene, lookDown(-0.5, 2.5, 0.2, {8, 8}), sun({0.0, -1.0, 0.0}), area(16));
    expectSound(inside);
    EXPECT_EQ(inside.id(4, 4), 1U);
    EXPECT_EQ(inside.at(4, 4), 0.0);
    // A lamp in the box lights nothing outside.
    const Traced lamp_inside = trace(scene, lookDown(3.0, 2.5, 0.5, {8, 8}), lamp({-0.5, 2.5, 0.0}, 0.1), area(16));
    expectSound(lamp_inside);
    EXPECT_EQ(lamp_inside.at(4, 4), 0.0);
    EXPECT_NEAR(*lamp_inside.visibility.first_blocker_m.pixel(4, 4),
                glm::length(glm::dvec3(0.5, 2.5 - 2.5 / 3.5, 0.0) - lamp_inside.point(4, 4)), 0.5);
    // Below the horizon, and exactly along the ground.
    for (const glm::dvec3& direction : {glm::dvec3(0.3, 1.0, 0.0), glm::dvec3(1.0, 0.0, 0.0)}) {
        const Traced below = trace(scene, lookDown(3.0, 2.5, 0.5, {8, 8}), sun(direction, 1.0), area(16));
        expectSound(below);
        EXPECT_EQ(below.at(4, 4), 0.0);
        EXPECT_EQ(below.visibility.rays, 0U);
    }
    // A sun that the horizon cuts: 5 degrees high, 20 wide. The part above it is a circle's segment.
    const double height = 5.0 * std::numbers::pi / 180.0;
    const double angle = 20.0 * std::numbers::pi / 180.0;
    const Traced cut = trace(scene, lookDown(10.0, 2.5, 0.5, {16, 16}),
                             sun({-std::cos(height), -std::sin(height), 0.0}, angle), area(256));
    const double t = std::tan(height) / std::tan(angle / 2.0);
    const double share = 1.0 - (std::acos(t) - t * std::sqrt(1.0 - t * t)) / std::numbers::pi;
    double mean = 0.0;
    for (const float v : cut.visibility.visibility.values) {
        mean += double{v} / 256.0;
    }
    EXPECT_NEAR(mean, share, 0.002);
    EXPECT_EQ(*cut.visibility.first_blocker_m.pixel(3, 3), std::numeric_limits<float>::infinity());
}

TEST(Degenerate, camera_without_a_direction_sees_nothing)
{
    scene::Scene scene = worlds::load("planes", 1);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const double value : {0.0, nan}) {
        const Traced traced =
            trace(scene, {{0.0, 5.0, 0.0}, glm::dmat4(value), {3, 2}}, sun({0.0, -1.0, 0.0}), area(4));
        expectSound(traced);
        EXPECT_EQ(traced.id(1, 1), 0U);
    }
}

TEST(FarAway, ten_kilometres_change_nothing)
{
    const glm::dvec3 offset(10240.0, 1024.0, -10240.0);
    const auto at = [&](const glm::dvec3& by, const Options& options) {
        scene::Scene scene = worlds::load("planes", 1);
        for (scene::Node& node : scene.nodes) {
            node.transform.translation += glm::vec3(by);
        }
        const View view = lookAt(by + glm::dvec3(6.5, 5.0, 9.5), by + glm::dvec3(0.6, 1.0, 0.0), 0.75, {120, 90});
        return trace(scene, view, sun({3.0, -4.0, 0.25}, 0.05), options);
    };
    for (const Options& options : {hard(), area(64)}) {
        const Traced here = at(glm::dvec3(0.0), options);
        const Traced there = at(offset, options);
        std::uint32_t different = 0;
        for (std::size_t i = 0; i < here.visibility.visibility.values.size(); ++i) {
            different += here.visibility.visibility.values[i] != there.visibility.visibility.values[i] ? 1 : 0;
        }
        EXPECT_LE(different, 5U);
        EXPECT_GT(*std::max_element(here.surfaces.object_ids.values.begin(), here.surfaces.object_ids.values.end()),
                  1U);
    }
}

TEST(Morphed, quad_takes_its_shadow_with_it)
{
    scene::Scene scene;
    place(scene, addQuad(scene, level(0.0F, 8.0F)));
    const std::uint32_t moving = addQuad(scene, ceiling(1.0F, -1.5F, -0.5F, 0.5F));
    // From x in [-1.5, -0.5] to x in [0.5, 1.5], and from height 1 to height 2, in two seconds.
    scene.meshes[moving].primitives[0].morph_targets.push_back({.positions = {4, glm::vec3(2.0F, 1.0F, 0.0F)}});
    scene.meshes[moving].morph_weights = {0.0F};
    place(scene, moving).use_matrix = false; // a node with a matrix is not animated
    scene.animations.push_back(
        {.channels =
             {{.node = 1, .path = scene::AnimationPath::weights, .times_s = {0.0F, 2.0F}, .values = {0.0F, 1.0F}}},
         .duration_s = 2.0F});
    for (const double time_s : {0.0, 0.5, 2.0}) {
        const Traced traced = trace(scene, lookDown(0.0, 0.9, 2.0, {80, 8}), sun({0.0, -1.0, 0.0}), hard(), time_s);
        ASSERT_EQ(traced.state.deformed.size(), 1U);
        for (std::uint32_t x = 0; x < 80; ++x) {
            const double from_middle = std::abs(traced.point(x, 4).x - (time_s - 1.0));
            ASSERT_EQ(traced.id(x, 4), 1U);
            ASSERT_EQ(traced.at(x, 4), from_middle < 0.5 ? 0.0 : 1.0) << time_s << ' ' << x;
            if (from_middle < 0.5) {
                ASSERT_NEAR(*traced.visibility.first_blocker_m.pixel(x, 4), 1.0 + time_s / 2.0, 1e-4);
            }
        }
    }
}

class Skinned : public ::testing::TestWithParam<const char*> {};

TEST_P(Skinned, figure_moves_and_its_lit_side_is_lit)
{
    const std::string file = sharedScene(std::string("skinned/") + GetParam());
    if (file.empty()) {
        GTEST_SKIP() << "NO SCENES: set GNOMON_SHARED to the folder that has scenes/";
    }
    scene::Scene scene = worlds::load(file, 1);
    const scene::State state = scene::evaluate(scene, 0.0);
    ASSERT_FALSE(state.deformed.empty());
    const glm::dvec3 centre(state.bounds_ws.centre());
    const double size = glm::length(glm::dvec3(state.bounds_ws.extent()));
    const View view = lookAt(centre + glm::dvec3(0.9, 0.4, 0.7) * size, centre, 0.8, {128, 96});
    const glm::dvec3 to_sun = glm::normalize(glm::dvec3(1.0, 1.2, 0.6));
    const Traced first = trace(scene, view, sun(-to_sun), area(16), 0.0);
    const Traced second = trace(scene, view, sun(-to_sun), area(16), 0.35);
    expectSound(first);
    expectSound(second);
    EXPECT_NE(first.surfaces.object_ids.values, second.surfaces.object_ids.values);
    for (const Traced* traced : {&first, &second}) {
        std::uint32_t facing = 0;
        double lit = 0.0;
        for (std::uint32_t y = 0; y < 96; ++y) {
            for (std::uint32_t x = 0; x < 128; ++x) {
                const float* n = traced->surfaces.normals.pixel(x, y);
                if (traced->id(x, y) != 0 && glm::dot(glm::dvec3(n[0], n[1], n[2]), to_sun) > 0.2) {
                    ++facing;
                    lit += traced->at(x, y);
                }
            }
        }
        EXPECT_GT(facing, 200U);
        EXPECT_GT(lit / facing, 0.7);
    }
}

INSTANTIATE_TEST_SUITE_P(figures, Skinned, ::testing::Values("Fox.glb", "CesiumMan.glb"));

} // namespace
} // namespace gnomon::truth::test
