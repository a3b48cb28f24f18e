// SPDX-License-Identifier: Apache-2.0
// Hard shadows against constructions in double precision, and area shadows against many hard ones.
#include "support.h"

#include "worlds/planes.h"
#include "worlds/worlds.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace gnomon::truth::test {
namespace {

using worlds::PlanesWorld;

/// Takes the box of the world `planes` to [-1, 1]^3.
glm::dvec3 toCube(const glm::dvec3& p)
{
    const glm::dvec3 min(PlanesWorld::box_min);
    const glm::dvec3 max(PlanesWorld::box_max);
    return (p - (min + max) * 0.5) / ((max - min) * 0.5);
}

View top(const glm::uvec2& size_px)
{
    return lookAt({1.0, 16.0, 0.02}, {1.0, 0.0, 0.0}, 0.7, size_px);
}

/// Every pixel of the ground whose answer a tenth of a millimetre either way does not change.
void expectBoxShadow(const Light& light)
{
    scene::Scene scene = worlds::load("planes", 1);
    const Traced traced = trace(scene, top({320, 240}), light, hard());
    expectSound(traced);
    std::uint32_t ground = 0;
    std::uint32_t dark = 0;
    std::uint32_t left_out = 0;
    for (std::uint32_t y = 0; y < 240; ++y) {
        for (std::uint32_t x = 0; x < 320; ++x) {
            const glm::dvec3 p = traced.point(x, y);
            if (traced.id(x, y) == 0 || std::abs(p.y) > 1e-5) {
                continue;
            }
            const bool directional = light.type == scene::LightType::directional;
            const glm::dvec3 end = directional ? p - light.direction_ws * 100.0 : light.position_ws;
            const glm::dvec3 from = toCube(p);
            const bool outer = meetsCube(from, toCube(end) - from, 1.0, 1e-4);
            const bool inner = meetsCube(from, toCube(end) - from, 1.0, -1e-4);
            ++ground;
            if (outer != inner) {
                ++left_out;
                continue;
            }
            dark += inner ? 1 : 0;
            ASSERT_EQ(traced.at(x, y), inner ? 0.0 : 1.0) << x << ' ' << y;
        }
    }
    EXPECT_GT(ground, 50000U);
    EXPECT_GT(dark, 500U);
    EXPECT_LT(left_out, 20U);
}

TEST(Planes, sun_shadow_of_the_box_is_exact)
{
    expectBoxShadow(sun(glm::dvec3(PlanesWorld::sun_direction)));
}

TEST(Planes, lamp_shadow_of_the_box_is_exact)
{
    expectBoxShadow(lamp(glm::dvec3(PlanesWorld::spot_position), 0.0));
}

TEST(Planes, near_distance_of_a_lamp_takes_casters_away)
{
    scene::Scene scene = worlds::load("planes", 1);
    // Above the box: its top is 2 m away, its farthest corner 3.6 m, the ground 5 m.
    const glm::dvec3 above(-0.5, 5.0, 0.0);
    const auto darkest = [&](double near_m, double radius_m) {
        const Traced traced = trace(scene, lookDown(-0.5, 1.0, 0.5, {16, 16}), lamp(above, radius_m, near_m), area(64));
        expectSound(traced);
        return traced.at(8, 8);
    };
    EXPECT_EQ(darkest(0.0, 0.1), 0.0);
    EXPECT_EQ(darkest(2.9, 0.1), 0.0); // its underside, 3 m away, still casts
    EXPECT_EQ(darkest(3.8, 0.1), 1.0);
    EXPECT_EQ(darkest(3.8, 0.0), 1.0);
    EXPECT_EQ(darkest(6.0, 0.1), 1.0); // the ground itself is nearer than that
    EXPECT_EQ(darkest(0.0, 8.0), 1.0); // the ground is inside the emitter
}

TEST(NearDistance, of_a_spot_is_a_plane_and_of_a_point_light_a_sphere)
{
    // 3 m below the light and 4 m beside it: 5 m away.
    scene::Scene scene;
    place(scene, addQuad(scene, level(0.0F, 16.0F)));
    place(scene, addQuad(scene, ceiling(2.0F, 3.5F, 4.5F, 0.5F)));
    const glm::dvec3 centre(0.0, 5.0, 0.0);
    const View view = lookDown(4.0 / 3.0 * 5.0, 1.0, 0.1, {4, 4}); // where its shadow falls
    const auto visibility = [&](scene::LightType type, const glm::dvec3& axis, double near_m, const Options& options) {
        Light light = lamp(centre, 0.1, near_m);
        light.type = type;
        light.direction_ws = axis;
        const Traced traced = trace(scene, view, light, options);
        expectSound(traced);
        EXPECT_EQ(traced.visibility.first_blocker_m.values[5] < 5.0F, traced.at(1, 1) < 1.0);
        return traced.at(1, 1);
    };
    const glm::dvec3 down(0.0, -1.0, 0.0);
    const glm::dvec3 aslant = glm::normalize(glm::dvec3(4.0, -3.0, 0.0)); // along it the quad's middle is 5 m deep
    constexpr auto kSpot = scene::LightType::spot;
    constexpr auto kPoint = scene::LightType::point;
    for (const Options& options : {hard(), area(64)}) {
        EXPECT_EQ(visibility(kSpot, down, 2.99, options), 0.0);
        EXPECT_EQ(visibility(kSpot, down, 3.01, options), 1.0);
        EXPECT_EQ(visibility(kPoint, down, 3.01, options), 0.0);
        EXPECT_EQ(visibility(kPoint, down, 4.5, options), 0.0);
        EXPECT_EQ(visibility(kPoint, down, 5.5, options), 1.0);
        EXPECT_EQ(visibility(kSpot, aslant, 4.5, options), 0.0);
        EXPECT_EQ(visibility(kSpot, aslant, 5.5, options), 1.0);
        EXPECT_EQ(visibility(kSpot, down, 6.0, options), 1.0);   // the ground itself is nearer
        EXPECT_EQ(visibility(kSpot, -down, 0.01, options), 1.0); // behind the light
        EXPECT_EQ(visibility(kSpot, -down, 0.0, options), 0.0);  // no plane
        EXPECT_EQ(visibility(kSpot, glm::dvec3(0.0, 2.0, 0.0) * -3.0, 2.99, options), 0.0); // made unit
    }
}

TEST(Planes, camera_sees_what_a_ray_meets_first)
{
    scene::Scene scene = worlds::load("planes", 1);
    const View view = lookAt({6.5, 5.0, 9.5}, {0.6, 1.0, 0.0}, 0.75, {160, 120});
    const Traced traced = trace(scene, view, sun({0.0, -1.0, 0.0}), hard());
    std::uint32_t on_box = 0;
    for (std::uint32_t y = 0; y < 120; ++y) {
        for (std::uint32_t x = 0; x < 160; ++x) {
            if (traced.id(x, y) == 0) {
                continue;
            }
            const glm::dvec3 p = traced.point(x, y);
            const glm::dvec3 clip = glm::dvec3((x + 0.5) / 160 * 2.0 - 1.0, (y + 0.5) / 120 * 2.0 - 1.0, 0.5);
            const glm::dvec4 through = view.world_from_clip * glm::dvec4(clip, 1.0);
            const glm::dvec3 ray = glm::normalize(glm::dvec3(through) / through.w - view.eye_ws);
            ASSERT_LT(glm::length(glm::cross(p - view.eye_ws, ray)), 1e-5); // on the ray
            const float* n = traced.surfaces.normals.pixel(x, y);
            ASSERT_LT(glm::dot(glm::dvec3(n[0], n[1], n[2]), ray), 0.0); // towards the eye
            const glm::dvec3 cube = toCube(p);
            const double largest = std::max({std::abs(cube.x), std::abs(cube.y), std::abs(cube.z)});
            if (std::abs(p.y) < 1e-5) {
                ASSERT_FALSE(meetsCube(toCube(view.eye_ws), cube - toCube(view.eye_ws), 1.0, -1e-5));
            } else {
                ASSERT_NEAR(largest, 1.0, 1e-5);
                ++on_box;
            }
        }
    }
    EXPECT_GT(on_box, 300U);
}

TEST(Area, is_the_mean_of_many_hard_shadows)
{
    scene::Scene scene = worlds::load("planes", 1);
    const double angle = 0.2;
    const glm::dvec3 to_sun = -glm::normalize(glm::dvec3(PlanesWorld::sun_direction));
    const View view = lookDown(1.3, 1.9, 1.6, {48, 32}); // below the box
    const Traced soft = trace(scene, view, sun(-to_sun, angle), area(1024));
    const Tracer tracer(scene, soft.state);
    // A grid of the disc's own: rings of equal area, each with as many points, turned from ring to ring.
    constexpr int kRings = 32;
    constexpr int kAround = 32;
    std::vector<double> mean(soft.visibility.visibility.values.size(), 0.0);
    const glm::dvec3 right = glm::normalize(glm::cross(to_sun, glm::dvec3(0.0, 0.0, 1.0)));
    const glm::dvec3 up = glm::cross(right, to_sun);
    for (int ring = 0; ring < kRings; ++ring) {
        for (int i = 0; i < kAround; ++i) {
            const double rho = std::tan(angle / 2.0) * std::sqrt((ring + 0.5) / kRings);
            const double turn = 2.0 * std::numbers::pi * (i + ring * std::numbers::phi) / kAround;
            const Light light = sun(-(to_sun + rho * (std::cos(turn) * right + std::sin(turn) * up)));
            const Visibility one = tracer.trace(soft.surfaces, view, light, hard()).value();
            for (std::size_t k = 0; k < mean.size(); ++k) {
                mean[k] += double{one.visibility.values[k]} / (kRings * kAround);
            }
        }
    }
    double signed_error = 0.0;
    std::uint32_t penumbra = 0;
    for (std::size_t k = 0; k < mean.size(); ++k) {
        const double v = soft.visibility.visibility.values[k];
        penumbra += v > 0.0 && v < 1.0 ? 1 : 0;
        signed_error += (v - mean[k]) / static_cast<double>(mean.size());
        ASSERT_NEAR(v, mean[k], 0.02 + 4.0 * soft.visibility.standard_error.values[k]) << k;
    }
    EXPECT_GT(penumbra, 300U);
    EXPECT_NEAR(signed_error, 0.0, 5e-4);
}

} // namespace
} // namespace gnomon::truth::test
