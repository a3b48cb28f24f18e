// SPDX-License-Identifier: Apache-2.0
// Each kind of artefact, planted on purpose, must show in its own class of errors and hardly in the others.
#include "stage.h"

#include "scene/state.h"
#include "worlds/worlds.h"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::lab::test {
namespace {

struct Box {
    glm::vec3 min{0.0F};
    glm::vec3 max{0.0F};
};

void addNode(scene::Scene& scene, const std::string& name, scene::Primitive primitive)
{
    scene::Mesh mesh;
    mesh.name = name;
    mesh.primitives.push_back(std::move(primitive));
    scene::Node node;
    node.name = name;
    node.mesh = static_cast<std::uint32_t>(scene.meshes.size());
    scene.meshes.push_back(std::move(mesh));
    scene.nodes.push_back(std::move(node));
}

/// Corners counter-clockwise, seen from where `normal` points to.
void addQuad(scene::Primitive& primitive, const std::array<glm::vec3, 4>& corners, glm::vec3 normal)
{
    const auto first = static_cast<std::uint32_t>(primitive.positions.size());
    primitive.positions.insert(primitive.positions.end(), corners.begin(), corners.end());
    primitive.normals.insert(primitive.normals.end(), 4, normal);
    for (const std::uint32_t corner : {0U, 1U, 2U, 0U, 2U, 3U}) {
        primitive.indices.push_back(first + corner);
    }
}

scene::Primitive boxOf(const Box& box)
{
    scene::Primitive primitive;
    for (int axis = 0; axis < 3; ++axis) {
        for (const bool far : {false, true}) {
            glm::vec3 normal{0.0F};
            normal[axis] = far ? 1.0F : -1.0F;
            const int u = (axis + 1) % 3;
            const int v = (axis + 2) % 3;
            std::array<glm::vec3, 4> corners;
            for (int i = 0; i < 4; ++i) {
                corners[i][axis] = (far ? box.max : box.min)[axis];
                const bool high_u = i == 1 || i == 2;
                const bool high_v = i >= 2;
                corners[i][u] = (high_u ? box.max : box.min)[u];
                corners[i][v] = (high_v ? box.max : box.min)[v];
            }
            if (!far) {
                std::swap(corners[1], corners[3]);
            }
            addQuad(primitive, corners, normal);
        }
    }
    return primitive;
}

constexpr float kGroundHalf_m = 20.0F;

/// Boxes over a ground of 40 x 40 m under a sun that falls along `sun_ws`, and one view.
scene::Scene boxesUnderTheSun(const std::vector<Box>& boxes, glm::vec3 sun_ws, const scene::NamedView& view)
{
    scene::Scene scene;
    scene::Primitive ground;
    constexpr float kHalf = kGroundHalf_m;
    addQuad(ground, {{{-kHalf, 0, kHalf}, {kHalf, 0, kHalf}, {kHalf, 0, -kHalf}, {-kHalf, 0, -kHalf}}}, {0, 1, 0});
    addNode(scene, "ground", std::move(ground));
    for (const Box& box : boxes) {
        addNode(scene, "box", boxOf(box));
    }
    scene.lights.emplace_back().name = "sun";
    scene::Node sun;
    sun.name = "sun";
    sun.light = 0;
    sun.transform.rotation = glm::quat(glm::vec3(0.0F, 0.0F, -1.0F), glm::normalize(sun_ws));
    scene.nodes.push_back(sun);
    scene.views = {view};
    scene::finishScene(scene);
    return scene;
}

using Class = double ClassErrors::*;
struct NamedClass {
    const char* name;
    Class member;
};
constexpr std::array kClasses{NamedClass{"edge", &ClassErrors::edge}, NamedClass{"acne", &ClassErrors::acne},
                              NamedClass{"detached", &ClassErrors::detached},
                              NamedClass{"bleeding", &ClassErrors::bleeding},
                              NamedClass{"terminator", &ClassErrors::terminator}};

/// The artefact's own class must rise to `factor` times what it was and to `least` at least; every other class by at
/// most `share` of that rise.
void expectPlanted(const Score& before, const Score& after, Class own, double factor, double least, double share)
{
    const ClassErrors& sound = before.classification.value().errors;
    const ClassErrors& planted = after.classification.value().errors;
    const double rise = planted.*own - sound.*own;
    for (const NamedClass& each : kClasses) {
        std::printf("%-9s %.6f -> %.6f%s\n", each.name, sound.*each.member, planted.*each.member,
                    each.member == own ? "  planted" : "");
        if (each.member != own) {
            EXPECT_LE(std::abs(planted.*each.member - sound.*each.member), share * rise) << each.name;
        }
    }
    EXPECT_GE(planted.*own, least);
    EXPECT_GE(planted.*own, factor * (sound.*own));
}

host::RenderOptions withBias(host::RenderOptions options, float constant_m)
{
    options.shadow.bias = {.automatic = false, .constant_m = constant_m};
    return options;
}

TEST(Planted, NoBiasAtAllIsAcne)
{
    Stage stage(worlds::load("planes", 1), "side", {256, 144});
    const Score sound = stage.score(hardOptions(1024));
    const Score planted = stage.score(withBias(hardOptions(1024), 0.0F));
    expectPlanted(sound, planted, &ClassErrors::acne, 10.0, 0.1, 0.1);
}

TEST(Planted, ABiasOfMetresDetachesShadowsOfWhatStandsOnTheGround)
{
    // 0.4 m high: every blocker of the ground is within 0.5 m along the ray, 1 % of the scene's diagonal is 0.566 m.
    const scene::NamedView close{
        .name = "close", .eye = {0.0F, 3.0F, 0.6F}, .target = {0.2F, 0.0F, 0.0F}, .fov_y_rad = 0.45F};
    Stage stage(boxesUnderTheSun({{{-1.2F, 0.0F, -0.9F}, {0.0F, 0.4F, 0.9F}}}, {0.6F, -0.8F, 0.0F}, close), "close",
                {320, 240});
    const Score sound = stage.score(hardOptions(1024));
    const Score planted = stage.score(withBias(hardOptions(1024), 3.0F));
    expectPlanted(sound, planted, &ClassErrors::detached, 10.0, 0.02, 0.3);
}

TEST(Planted, AMapOfHalfTheResolutionErrsAtEdges)
{
    // The sun comes from a corner, so that no edge runs along the map's texels.
    const scene::NamedView view{
        .name = "above", .eye = {0.5F, 9.0F, 4.0F}, .target = {0.5F, 0.0F, 0.5F}, .fov_y_rad = 0.5F};
    Stage stage(boxesUnderTheSun({{{-1.2F, 0.0F, -0.9F}, {0.0F, 1.5F, 0.9F}}}, {0.5F, -0.8F, 0.35F}, view), "above",
                {320, 240});
    const Score sound = stage.score(hardOptions(512));
    const Score planted = stage.score(hardOptions(256));
    expectPlanted(sound, planted, &ClassErrors::edge, 1.5, 1e-3, 0.01);
}

/// A slab and, much higher, three slats, whose shadows lie within the slab's.
constexpr std::array<Box, 4> kSlabAndSlats{
    Box{{-2.6F, 2.0F, -2.0F}, {0.0F, 2.05F, 2.0F}},
    Box{{-19.5F, 15.0F, -1.6F}, {-19.2F, 15.05F, 1.6F}},
    Box{{-18.9F, 15.0F, -1.6F}, {-18.6F, 15.05F, 1.6F}},
    Box{{-18.3F, 15.0F, -1.6F}, {-18.0F, 15.05F, 1.6F}},
};
constexpr glm::dvec3 kSun{0.8, -0.6, 0.0};

/// How far along the ray to the sun the last thing is that stops it, the one that a shadow map sees; 0: nothing does.
double lastBlocker_m(const glm::dvec3& point_ws)
{
    double farthest = 0.0;
    for (const Box& box : kSlabAndSlats) {
        double enter = 0.0;
        double leave = 1e9;
        for (int axis = 0; axis < 3; ++axis) {
            const double low = box.min[axis] - point_ws[axis];
            const double high = box.max[axis] - point_ws[axis];
            if (kSun[axis] == 0.0) {
                leave = low > 0.0 || high < 0.0 ? -1.0 : leave;
                continue;
            }
            enter = std::max(enter, std::min(low / -kSun[axis], high / -kSun[axis]));
            leave = std::min(leave, std::max(low / -kSun[axis], high / -kSun[axis]));
        }
        farthest = enter < leave ? std::max(farthest, leave) : farthest;
    }
    return farthest;
}

enum class DepthTest : std::uint8_t { compare_each, chebyshev };

/// Visibility of a point of the ground from `kTaps` x `kTaps` texels around it, in a map whose depths are measured from
/// the ground (so that its own slope plays no part): the share of texels that light it, or the bound that their mean
/// and variance give.
/// Based on: W. Donnelly, A. Lauritzen, "Variance Shadow Maps", 2006, eq. 5.
double groundVisibility(const glm::dvec3& point_ws, double half_width_m, DepthTest test)
{
    constexpr int kTaps = 9;
    double lit = 0.0;
    double mean = 0.0;
    double mean_of_squares = 0.0;
    for (int i = 0; i < kTaps * kTaps; ++i) {
        const glm::dvec2 place = glm::dvec2(i % kTaps, i / kTaps) * (2.0 / (kTaps - 1)) - 1.0;
        const double depth = -lastBlocker_m(point_ws + glm::dvec3(place.x, 0.0, place.y) * half_width_m);
        lit += depth == 0.0 ? 1.0 : 0.0;
        mean += depth;
        mean_of_squares += depth * depth;
    }
    constexpr double kCount = kTaps * kTaps;
    mean /= kCount;
    const double variance = std::max(mean_of_squares / kCount - mean * mean, 1e-9);
    const double receiver = 0.0; // the ground's own depth
    if (test == DepthTest::compare_each || receiver <= mean) {
        return test == DepthTest::compare_each ? lit / kCount : 1.0;
    }
    return variance / (variance + (receiver - mean) * (receiver - mean));
}

/// The mask of the ground by either test; elsewhere the truth.
ImageF filteredMask(Stage& stage, double half_width_m, DepthTest test)
{
    const truth::Traced& truth = stage.hardTruth();
    ImageF mask = truth.visibility.visibility;
    for (std::uint32_t y = 0; y < mask.height; ++y) {
        for (std::uint32_t x = 0; x < mask.width; ++x) {
            const float* p = truth.surfaces.points.pixel(x, y);
            const glm::dvec3 point_ws = stage.subject().eye.position_ws + glm::dvec3(p[0], p[1], p[2]);
            if (*truth.surfaces.object_ids.pixel(x, y) != 0 && std::abs(point_ws.y) < 1e-3) {
                *mask.pixel(x, y) = static_cast<float>(groundVisibility(point_ws, half_width_m, test));
            }
        }
    }
    return mask;
}

TEST(Planted, MomentsOfTwoBlockersBleed)
{
    const scene::NamedView view{
        .name = "ground", .eye = {3.0F, 10.0F, 0.0F}, .target = {1.4F, 0.0F, 0.0F}, .fov_y_rad = 0.43F};
    Stage stage(boxesUnderTheSun({kSlabAndSlats.begin(), kSlabAndSlats.end()}, glm::vec3(kSun), view), "ground",
                {320, 240});
    const host::Picture picture = stage.geometry();
    const auto scoreOf = [&](DepthTest test) {
        const ImageF mask = filteredMask(stage, 0.05, test); // less than 3 pixels
        return scoreMask(stage.subject(), stage.hardTruth(), picture, mask, false);
    };
    expectPlanted(scoreOf(DepthTest::compare_each), scoreOf(DepthTest::chebyshev), &ClassErrors::bleeding, 10.0, 1e-3,
                  0.1);
}

} // namespace
} // namespace gnomon::lab::test
