// SPDX-License-Identifier: Apache-2.0
// Where smooth-shaded bodies turn away from the light. A ball whose vertices have the ball's normals is lit as a ball
// is, however few triangles it has: a point sees all of the light's disc that is above its horizon.
#include "support.h"

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace gnomon::truth::test {
namespace {

constexpr std::uint32_t kSide_px = 128;

/// addBall() with the ball's normals. `outward`: -1 turns them, and the triangles, inward.
scene::Scene smoothBall(std::uint32_t rings, float radius_m, bool outward = true)
{
    scene::Scene scene;
    const std::uint32_t mesh = addBall(scene, rings);
    scene::Primitive& ball = scene.meshes[mesh].primitives[0];
    for (const glm::vec3& position : ball.positions) {
        ball.normals.push_back(outward ? position : -position);
    }
    for (std::size_t i = 0; !outward && i < ball.indices.size(); i += 3) {
        std::swap(ball.indices[i], ball.indices[i + 1]);
    }
    place(scene, mesh, glm::scale(glm::mat4(1.0F), glm::vec3(radius_m)));
    return scene;
}

/// Share of a disc above a line, `height` over its middle in radii.
double shareAbove(double height)
{
    const double h = std::clamp(height, -1.0, 1.0);
    return 0.5 + (std::asin(h) + h * std::sqrt(1.0 - h * h)) / std::numbers::pi;
}

struct Facing {
    double sine = 0.0; // of the light's height over the smooth surface
    double visibility = 0.0;
    bool triangle_faces = false;
};

std::vector<Facing> facings(const Traced& traced, const glm::dvec3& to_light)
{
    std::vector<Facing> all;
    for (std::uint32_t y = 0; y < kSide_px; ++y) {
        for (std::uint32_t x = 0; x < kSide_px; ++x) {
            if (traced.id(x, y) != 0) {
                const float* n = traced.surfaces.normals.pixel(x, y);
                const double sine = glm::dot(glm::normalize(traced.point(x, y)), to_light);
                all.push_back({sine, traced.at(x, y), glm::dot(glm::dvec3(n[0], n[1], n[2]), to_light) > 0.0});
            }
        }
    }
    std::sort(all.begin(), all.end(), [](const Facing& a, const Facing& b) { return a.sine < b.sine; });
    return all;
}

TEST(Terminator, OfASmoothBallIsThatOfTheBall)
{
    const glm::dvec3 to_light = glm::normalize(glm::dvec3(-1.0, 0.7, 0.3));
    for (const std::uint32_t rings : {5U, 8U, 24U}) {
        for (const float radius_m : {0.001F, 1.0F, 1000.0F}) {
            scene::Scene scene = smoothBall(rings, radius_m);
            const View view = lookAt(glm::dvec3(0.5, 0.5, 3.0) * double{radius_m}, {}, 0.6, {kSide_px, kSide_px});
            const Traced traced = trace(scene, view, sun(-to_light), hard());
            expectSound(traced);
            int turned = 0;
            int wrong = 0;
            for (const Facing& at : facings(traced, to_light)) {
                turned += at.visibility == 1.0 && !at.triangle_faces ? 1 : 0;
                // A few thousandths: in the middle of a triangle its own normal counts.
                wrong += std::abs(at.sine) > 0.004 && at.visibility != (at.sine > 0.0 ? 1.0 : 0.0) ? 1 : 0;
            }
            EXPECT_EQ(wrong, 0) << rings << " " << radius_m;
            EXPECT_GT(turned, 20) << rings << " " << radius_m; // triangles that were dark
        }
    }
}

TEST(Terminator, OfAWideSunRisesAsTheDiscDoes)
{
    const glm::dvec3 to_light = glm::normalize(glm::dvec3(-1.0, 0.7, 0.3));
    constexpr double kHalf_rad = 0.25;
    scene::Scene scene = smoothBall(8, 1.0F);
    const View view = lookAt({0.5, 0.5, 3.0}, {}, 0.6, {kSide_px, kSide_px});
    const Traced traced = trace(scene, view, sun(-to_light, 2.0 * kHalf_rad), area(4096));
    double last = 0.0;
    int rising = 0;
    for (const Facing& at : facings(traced, to_light)) {
        if (std::abs(at.sine) < 0.004) {
            continue;
        }
        // The rays' disc has the tangent of the half angle as its radius.
        const double height = at.sine / (std::tan(kHalf_rad) * std::sqrt(1.0 - at.sine * at.sine));
        const double expected = at.sine > 0.0 ? shareAbove(height) : 0.0;
        ASSERT_NEAR(at.visibility, expected, 0.02) << at.sine;
        ASSERT_GT(at.visibility, last - 0.02) << at.sine;
        last = std::max(last, at.visibility);
        rising += at.visibility > 0.5 && at.visibility < 0.99 ? 1 : 0;
    }
    EXPECT_EQ(last, 1.0);
    EXPECT_GT(rising, 500);
}

TEST(Terminator, OfABallWithoutNormalsIsThatOfItsTriangles)
{
    const glm::dvec3 to_light = glm::normalize(glm::dvec3(-1.0, 0.7, 0.3));
    scene::Scene scene = smoothBall(8, 1.0F);
    scene.meshes[0].primitives[0].normals.clear();
    const View view = lookAt({0.5, 0.5, 3.0}, {}, 0.6, {kSide_px, kSide_px});
    const Traced traced = trace(scene, view, sun(-to_light), hard());
    for (const Facing& at : facings(traced, to_light)) {
        ASSERT_EQ(at.visibility, at.triangle_faces ? 1.0 : 0.0);
    }
    EXPECT_EQ(traced.surfaces.smooth_normals.values, traced.surfaces.normals.values);
}

// Its wall is as thin as can be, and rays that start in a hollow must not pass it.
TEST(Terminator, NoLightComesThroughTheWallOfAHollowBall)
{
    for (const std::uint32_t rings : {5U, 8U, 24U}) {
        scene::Scene scene = smoothBall(rings, 1.0F, false);
        const View view = lookAt({0.1, 0.2, 0.0}, {0.0, 0.3, 1.0}, 1.6, {kSide_px, kSide_px});
        for (const glm::dvec3 to_light : {glm::dvec3(0.0, 1.0, 0.0), glm::dvec3(1.0, 0.2, 0.1)}) {
            for (const Options& options : {hard(), area(64)}) {
                const Traced traced = trace(scene, view, sun(-to_light), options);
                EXPECT_NE(traced.id(0, 0), 0U);
                const std::vector<float>& seen = traced.visibility.visibility.values;
                EXPECT_EQ(*std::max_element(seen.begin(), seen.end()), 0.0F) << rings;
            }
        }
    }
}

// Its sides face away as they do, whatever its normals say.
TEST(Terminator, OfABoxWithSmoothedEdgesIsThatOfTheBox)
{
    const glm::dvec3 to_light = glm::normalize(glm::dvec3(-1.0, 0.7, -0.1));
    const View view = lookAt({1.5, 2.0, 4.0}, {}, 0.8, {kSide_px, kSide_px});
    scene::Scene flat;
    place(flat, addCube(flat));
    scene::Scene smooth;
    const std::uint32_t cube = addCube(smooth);
    for (const glm::vec3& position : smooth.meshes[cube].primitives[0].positions) {
        smooth.meshes[cube].primitives[0].normals.push_back(glm::normalize(position));
    }
    place(smooth, cube);
    const Traced expected = trace(flat, view, sun(-to_light), area(64));
    const Traced traced = trace(smooth, view, sun(-to_light), area(64));
    EXPECT_EQ(traced.visibility.visibility.values, expected.visibility.visibility.values);
    EXPECT_EQ(traced.surfaces.smooth_normals.values, expected.surfaces.normals.values);
}

// An object before a body shades the side that turns away as well.
TEST(Terminator, InShadowIsDark)
{
    const glm::dvec3 to_light = glm::normalize(glm::dvec3(-1.0, 0.0, 0.3));
    scene::Scene scene = smoothBall(8, 1.0F);
    // A wall that all but touches the ball.
    const glm::vec3 across(-0.3F, 0.0F, -1.0F);
    const glm::vec3 middle = glm::vec3(to_light) * 1.05F;
    const std::uint32_t wall =
        addQuad(scene, {middle - across * 3.0F - glm::vec3(0, 3, 0), middle + across * 3.0F - glm::vec3(0, 3, 0),
                        middle + across * 3.0F + glm::vec3(0, 3, 0), middle - across * 3.0F + glm::vec3(0, 3, 0)});
    place(scene, wall);
    const View view = lookAt({3.0, 0.5, 3.0}, {}, 0.6, {kSide_px, kSide_px});
    const Traced traced = trace(scene, view, sun(-to_light), area(64));
    int pixels = 0;
    for (std::uint32_t y = 0; y < kSide_px; ++y) {
        for (std::uint32_t x = 0; x < kSide_px; ++x) {
            pixels += traced.id(x, y) == 1 ? 1 : 0;
            ASSERT_TRUE(traced.id(x, y) != 1 || traced.at(x, y) == 0.0) << x << " " << y;
        }
    }
    EXPECT_GT(pixels, 3000);
}

} // namespace
} // namespace gnomon::truth::test
