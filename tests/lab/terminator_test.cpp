// SPDX-License-Identifier: Apache-2.0
// The mask where smooth-shaded bodies turn away from the light: a ball of few triangles is lit as a ball is, and
// whatever shades it shades it there too.
#include "stage.h"

#include "scene/state.h"

#include <gnomon/choices.h>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>

namespace gnomon::lab::test {
namespace {

constexpr glm::uvec2 kSize_px{240, 240};
const glm::vec3 kToSun = glm::normalize(glm::vec3(-1.0F, 0.5F, 0.2F));

void add(scene::Scene& scene, scene::Primitive primitive)
{
    scene::Node node;
    node.mesh = static_cast<std::uint32_t>(scene.meshes.size());
    scene.meshes.push_back({.name = "mesh", .primitives = {std::move(primitive)}});
    scene.nodes.push_back(std::move(node));
}

/// A convex ball of radius 1 around the origin.
scene::Primitive ball(std::uint32_t rings, bool smooth)
{
    scene::Primitive primitive;
    for (std::uint32_t ring = 0; ring <= rings; ++ring) {
        for (std::uint32_t column = 0; column < 2 * rings; ++column) {
            const float polar = std::numbers::pi_v<float> * static_cast<float>(ring) / static_cast<float>(rings);
            const float around = std::numbers::pi_v<float> * static_cast<float>(column) / static_cast<float>(rings);
            primitive.positions.emplace_back(std::sin(polar) * std::sin(around), std::cos(polar),
                                             std::sin(polar) * std::cos(around));
        }
    }
    if (smooth) {
        primitive.normals = primitive.positions;
    }
    for (std::uint32_t ring = 0; ring < rings; ++ring) {
        for (std::uint32_t column = 0; column < 2 * rings; ++column) {
            const std::uint32_t a = ring * 2 * rings + column;
            const std::uint32_t b = ring * 2 * rings + (column + 1) % (2 * rings);
            const std::uint32_t c = a + 2 * rings;
            const std::uint32_t d = b + 2 * rings;
            primitive.indices.insert(primitive.indices.end(), {a, c, d, a, d, b});
        }
    }
    return primitive;
}

/// A square of 8 m across the way to the sun, `away_m` from the ball's middle.
scene::Primitive wall(float away_m)
{
    const glm::vec3 right = glm::normalize(glm::cross(glm::vec3(0, 1, 0), kToSun)) * 4.0F;
    const glm::vec3 up = glm::normalize(glm::cross(kToSun, right)) * 4.0F;
    const glm::vec3 middle = kToSun * away_m;
    scene::Primitive primitive;
    primitive.positions = {middle - right - up, middle + right - up, middle + right + up, middle - right + up};
    primitive.indices = {0, 1, 2, 0, 2, 3};
    return primitive;
}

scene::Scene underTheSun(scene::Primitive body)
{
    scene::Scene scene;
    add(scene, std::move(body));
    scene.lights.emplace_back().name = "sun";
    scene::Node sun;
    sun.name = "sun";
    sun.light = 0;
    sun.transform.rotation = glm::quat(glm::vec3(0.0F, 0.0F, -1.0F), -kToSun);
    scene.nodes.push_back(sun);
    scene::NamedView view;
    view.name = "view";
    view.eye = {1.2F, 0.8F, 3.4F};
    view.target = {0.0F, 0.0F, 0.0F};
    view.fov_y_rad = 0.62F;
    scene.views = {view};
    return scene;
}

struct Tally {
    int terminator = 0; // pixels that only the smooth normal turns to the sun
    int dark = 0;       // of these, in mask and truth
    int dark_truth = 0;
};

/// Every pixel of the ball (object 0) with N·L > 0.05 by the ball itself.
Tally tallyOf(Stage& stage, const Score& score)
{
    const truth::Traced& truth = stage.hardTruth();
    Tally tally;
    for (std::size_t i = 0; i < score.mask.values.size(); ++i) {
        const glm::vec3 point = stage.subject().eye.position_ws + glm::dvec3(truth.surfaces.points.values[3 * i],
                                                                             truth.surfaces.points.values[3 * i + 1],
                                                                             truth.surfaces.points.values[3 * i + 2]);
        const glm::vec3 normal(truth.surfaces.normals.values[3 * i], truth.surfaces.normals.values[3 * i + 1],
                               truth.surfaces.normals.values[3 * i + 2]);
        if (truth.surfaces.object_ids.values[i] == 1 && glm::dot(glm::normalize(point), kToSun) > 0.055F &&
            glm::dot(normal, kToSun) <= 0.0F) {
            ++tally.terminator;
            tally.dark += score.mask.values[i] < 0.98F ? 1 : 0;
            tally.dark_truth += truth.visibility.visibility.values[i] < 0.98F ? 1 : 0;
        }
    }
    return tally;
}

class TerminatorOfFilters : public ::testing::TestWithParam<std::pair<Filter, MapFormat>> {};

TEST_P(TerminatorOfFilters, OfASmoothBallHasNoSteps)
{
    const auto [filter, format] = GetParam();
    for (const std::uint32_t rings : {6U, 10U}) {
        for (const std::uint32_t map_size : {128U, 1024U}) {
            scene::Scene scene = underTheSun(ball(rings, true));
            scene::finishScene(scene);
            Stage stage(std::move(scene), "view", kSize_px);
            const Score score = stage.score(filterOptions(filter, format, map_size));
            const Tally tally = tallyOf(stage, score);
            EXPECT_GT(tally.terminator, 500);
            EXPECT_EQ(tally.dark_truth, 0);
            EXPECT_EQ(tally.dark, 0) << rings << " " << map_size;
            EXPECT_GT(score.pixels.counts.terminator, 500U);
            EXPECT_LT(score.classification.value().errors.terminator, 1e-5);
        }
    }
}

TEST_P(TerminatorOfFilters, OfAShadedBallIsDark)
{
    const auto [filter, format] = GetParam();
    scene::Scene scene = underTheSun(ball(8, true));
    add(scene, wall(1.02F));
    scene::finishScene(scene);
    Stage stage(std::move(scene), "view", kSize_px);
    const Score score = stage.score(filterOptions(filter, format, 512));
    const Tally tally = tallyOf(stage, score);
    EXPECT_GT(tally.terminator, 500);
    EXPECT_EQ(tally.dark_truth, tally.terminator);
    EXPECT_EQ(tally.dark, tally.terminator);
}

INSTANTIATE_TEST_SUITE_P(Filters, TerminatorOfFilters,
                         ::testing::Values(std::pair(Filter::hard, MapFormat::d32f),
                                           std::pair(Filter::pcf, MapFormat::d32f),
                                           std::pair(Filter::pcss, MapFormat::d32f),
                                           std::pair(Filter::raymarch, MapFormat::d32f)));

// The class is none of a mesh without normals, whose triangles are its surface.
TEST(Terminator, OfAFlatBallIsThatOfItsTriangles)
{
    scene::Scene scene = underTheSun(ball(8, false));
    scene::finishScene(scene);
    Stage stage(std::move(scene), "view", kSize_px);
    const Score score = stage.score(hardOptions(1024));
    const Tally tally = tallyOf(stage, score);
    EXPECT_GT(tally.terminator, 500);
    EXPECT_EQ(tally.dark_truth, tally.terminator);
    EXPECT_EQ(tally.dark, tally.terminator);
    EXPECT_EQ(score.pixels.counts.terminator, 0U);
    EXPECT_EQ(score.classification.value().errors.terminator, 0.0);
}

} // namespace
} // namespace gnomon::lab::test
