// SPDX-License-Identifier: Apache-2.0
// A surface does not shadow itself: not a plane of many triangles under grazing light, not a convex body, at any scale
// and however far from the world's origin.
#include "support.h"

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace gnomon::truth::test {
namespace {

struct Placed {
    double size_m;
    glm::vec3 at;
};

class SelfShadow : public ::testing::TestWithParam<Placed> {};

/// n by n quads of different sizes in one tilted plane, halved along one diagonal or the other; the corners' rounding
/// is all that keeps it from being flat.
scene::Primitive tiltedPlane(const glm::mat4& world_from_plane, std::uint32_t n, bool other_diagonal)
{
    scene::Primitive primitive;
    for (std::uint32_t row = 0; row <= n; ++row) {
        for (std::uint32_t column = 0; column <= n; ++column) {
            const auto along = [n](std::uint32_t i) {
                const float t = static_cast<float>(i) / static_cast<float>(n) * 2.0F - 1.0F;
                return t * t * t;
            };
            primitive.positions.emplace_back(world_from_plane * glm::vec4(along(column), 0.0F, -along(row), 1.0F));
        }
    }
    for (std::uint32_t row = 0; row < n; ++row) {
        for (std::uint32_t column = 0; column < n; ++column) {
            const std::uint32_t a = row * (n + 1) + column;
            const std::uint32_t d = a + n + 1;
            if (other_diagonal) {
                primitive.indices.insert(primitive.indices.end(), {a, a + 1, d, a + 1, d + 1, d});
            } else {
                primitive.indices.insert(primitive.indices.end(), {a, a + 1, d + 1, a, d + 1, d});
            }
        }
    }
    return primitive;
}

TEST_P(SelfShadow, plane_under_grazing_light_is_lit_everywhere)
{
    const auto [size_m, at] = GetParam();
    std::uint64_t pixels = 0;
    std::uint64_t dark = 0;
    for (int turn = 0; turn < 12; ++turn) {
        const auto angle = static_cast<float>(turn);
        glm::mat4 tilt = glm::rotate(glm::mat4(1.0F), 0.37F * angle, glm::normalize(glm::vec3(0.3F, 0.5F, 1.0F)));
        const glm::dmat4 exact(tilt);
        const glm::dvec3 up(exact[1]);
        tilt = glm::scale(tilt, glm::vec3(static_cast<float>(size_m)));
        // Two surfaces in one place, which must not take each other for casters.
        scene::Scene scene;
        scene.meshes.push_back(
            {.name = "planes", .primitives = {tiltedPlane(tilt, 9, false), tiltedPlane(tilt, 6, true)}});
        place(scene, 0, glm::translate(glm::mat4(1.0F), at));
        const glm::dvec3 target(at);
        const View view =
            lookAt(target + (up * 2.0 + glm::dvec3(exact[0])) * size_m, target, 0.6, {64, 64}, glm::dvec3(exact[2]));
        const double height = 1.5 * std::numbers::pi / 180.0;
        const glm::dvec3 to_sun =
            std::sin(height) * up + std::cos(height) * (std::cos(1.1 * angle) * glm::dvec3(exact[0]) +
                                                        std::sin(1.1 * angle) * glm::dvec3(exact[2]));
        const Traced traced = trace(scene, view, sun(-to_sun), area(16));
        expectSound(traced);
        for (std::size_t i = 0; i < traced.visibility.visibility.values.size(); ++i) {
            pixels += traced.surfaces.object_ids.values[i] != 0 ? 1 : 0;
            dark += traced.visibility.visibility.values[i] < 1.0F ? 1 : 0;
        }
    }
    EXPECT_GT(pixels, 20000U);
    EXPECT_EQ(dark, 0U) << "of " << pixels;
}

TEST_P(SelfShadow, ball_is_dark_only_where_it_faces_away)
{
    const auto [size_m, at] = GetParam();
    scene::Scene scene;
    place(scene, addBall(scene, 40),
          glm::scale(glm::translate(glm::mat4(1.0F), at), glm::vec3(static_cast<float>(size_m))));
    const glm::dvec3 target(at);
    const View view = lookAt(target + glm::dvec3(1.0, 1.5, 3.0) * size_m, target, 0.6, {128, 128});
    const glm::dvec3 to_sun = glm::normalize(glm::dvec3(-1.0, 0.7, 1.0));
    const Traced traced = trace(scene, view, sun(-to_sun), hard());
    std::uint32_t lit = 0;
    std::uint32_t wrong = 0;
    for (std::uint32_t y = 0; y < 128; ++y) {
        for (std::uint32_t x = 0; x < 128; ++x) {
            if (traced.id(x, y) == 0) {
                continue;
            }
            const float* n = traced.surfaces.normals.pixel(x, y);
            const double facing = glm::dot(glm::dvec3(n[0], n[1], n[2]), to_sun);
            lit += facing > 0.0 ? 1 : 0;
            wrong += traced.at(x, y) != (facing > 0.0 ? 1.0 : 0.0) ? 1 : 0;
        }
    }
    EXPECT_GT(lit, 4000U);
    EXPECT_EQ(wrong, 0U);
}

INSTANTIATE_TEST_SUITE_P(scales_and_places, SelfShadow,
                         ::testing::Values(Placed{1e-3, {0, 0, 0}}, Placed{1.0, {0, 0, 0}}, Placed{1e3, {0, 0, 0}},
                                           Placed{1.0, {3.0F, -2.0F, 7.0F}}, Placed{5.0, {10240.0F, 8.0F, -10240.0F}}));

} // namespace
} // namespace gnomon::truth::test
