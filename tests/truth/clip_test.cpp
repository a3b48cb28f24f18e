// SPDX-License-Identifier: Apache-2.0
// Rays of the camera or to a light do not hit parts that clip planes cut away, of one triangle or of many instances.
#include "support.h"

#include "scene_geometry.h"

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>

namespace gnomon::truth::test {
namespace {

constexpr glm::uvec2 kSize{96, 96};
const glm::vec4 kLeftHalf{-1.0F, 0.0F, 0.0F, 0.0F}; // x <= 0

/// A ground and over it a cube of 2 m, from 1 m to 3 m high, that does not hide what lies below it.
scene::Scene cubeOverGround(const scene::ClipPlanes& planes)
{
    scene::Scene scene;
    place(scene, addQuad(scene, level(0.0F, 32.0F)));
    const glm::mat4 up = glm::translate(glm::mat4(1.0F), glm::vec3(0.0F, 2.0F, 0.0F));
    place(scene, addCube(scene), up).clip_planes = planes;
    return scene;
}

/// From below the cube.
View onGround()
{
    return lookDown(0.0, 0.9, 3.0, kSize);
}

std::uint32_t darkOf(const Traced& traced)
{
    std::uint32_t dark = 0;
    for (std::uint32_t y = 0; y < kSize.y; ++y) {
        for (std::uint32_t x = 0; x < kSize.x; ++x) {
            dark += traced.at(x, y) < 0.5 ? 1 : 0;
        }
    }
    return dark;
}

TEST(Clip, ABoxCutInHalfCastsHalfAShadow)
{
    const Light overhead = sun({0.0, -1.0, 0.0});
    for (const Options& options : {hard(), area(64)}) {
        scene::Scene whole = cubeOverGround(scene::kNoClipPlanes);
        scene::Scene half = cubeOverGround({kLeftHalf, scene::kNoClipPlane});
        const std::uint32_t of_whole = darkOf(trace(whole, onGround(), overhead, options));
        EXPECT_GT(of_whole, 900U);
        EXPECT_EQ(darkOf(trace(half, onGround(), overhead, options)) * 2, of_whole);
        scene::Scene none = cubeOverGround({kLeftHalf, glm::vec4(1.0F, 0.0F, 0.0F, -0.01F)});
        EXPECT_EQ(darkOf(trace(none, onGround(), overhead, options)), 0U);
    }
}

/// By light from aside the cut shape's shadow is that of a cube of another form: the slab method in double precision.
TEST(Clip, TheShadowIsExactUnderSunAndLamp)
{
    // The rest reaches from -1 to 0 in x, and from -1 to 0.5 in the cube's y. It is open there, so the light's place
    // lets no ray enter by one opening and leave by the other.
    const scene::ClipPlanes planes{kLeftHalf, glm::vec4(0.0F, -1.0F, 0.0F, 0.5F)};
    for (const Light& light : {sun({-0.4, -1.0, 0.3}), lamp({3.0, 6.0, 1.0}, 0.0)}) {
        scene::Scene scene = cubeOverGround(planes);
        const Traced traced = trace(scene, lookDown(0.0, 0.9, 5.0, kSize), light, hard());
        expectSound(traced);
        std::uint32_t dark = 0;
        std::uint32_t left_out = 0;
        for (std::uint32_t y = 0; y < kSize.y; ++y) {
            for (std::uint32_t x = 0; x < kSize.x; ++x) {
                const auto toCube = [](const glm::dvec3& p) {
                    return (p - glm::dvec3(-0.5, 1.75, 0.0)) / glm::dvec3(0.5, 0.75, 1.0);
                };
                const glm::dvec3 p = traced.point(x, y);
                const bool directional = light.type == scene::LightType::directional;
                const glm::dvec3 end = directional ? p - light.direction_ws * 100.0 : light.position_ws;
                const glm::dvec3 from = toCube(p);
                const bool outer = meetsCube(from, toCube(end) - from, 1.0, 1e-4);
                if (outer != meetsCube(from, toCube(end) - from, 1.0, -1e-4)) {
                    ++left_out;
                    continue;
                }
                dark += outer ? 1 : 0;
                ASSERT_EQ(traced.at(x, y), outer ? 0.0 : 1.0) << x << ' ' << y;
            }
        }
        EXPECT_GT(dark, 200U);
        EXPECT_LT(left_out, 20U);
    }
}

TEST(Clip, TheCameraSeesThrough)
{
    scene::Scene scene = cubeOverGround({kLeftHalf, scene::kNoClipPlane});
    const Traced traced = trace(scene, lookAt({0.0, 9.0, 0.0}, {0.0, 0.0, 0.0}, 0.4, kSize, {0.0, 0.0, -1.0}),
                                sun({0.0, -1.0, 0.0}), hard());
    EXPECT_EQ(traced.id(kSize.x / 2 - 3, kSize.y / 2), 2U);
    EXPECT_EQ(traced.id(kSize.x / 2 + 3, kSize.y / 2), 1U); // the ground, in the light
    EXPECT_EQ(traced.at(kSize.x / 2 + 3, kSize.y / 2), 1.0);
}

/// Planes are in each instance's own space.
TEST(Clip, InstancesAreCutAsWell)
{
    scene::Scene scene = cubeOverGround({kLeftHalf, scene::kNoClipPlane});
    const glm::mat4 aside = glm::translate(glm::mat4(1.0F), glm::vec3(-2.0F, 0.0F, 0.0F));
    const glm::mat4 turned = glm::rotate(glm::mat4(1.0F), 3.1415927F, glm::vec3(0.0F, 1.0F, 0.0F));
    scene.nodes[1].instances = {aside, turned};
    const Traced traced = trace(scene, onGround(), sun({0.0, -1.0, 0.0}), hard());
    const auto at = [&](double x) {
        return traced.at(static_cast<std::uint32_t>((x + 3.0) / 6.0 * kSize.x), kSize.y / 2);
    };
    EXPECT_EQ(at(-2.5), 0.0); // left half of the first
    EXPECT_EQ(at(-1.5), 1.0);
    EXPECT_EQ(at(-0.5), 1.0); // of the second, turned around, the right
    EXPECT_EQ(at(0.5), 0.0);
    scene::finishScene(scene);
    const scene::State state = scene::evaluate(scene, 0.0);
    const SceneGeometry geometry(scene, state, 0);
    EXPECT_TRUE(geometry.part(1).instanced);
    RayContext context;
    for (const auto& [x, meets] : {std::pair(-2.5F, true), {-1.5F, false}, {-0.5F, false}, {0.5F, true}}) {
        RTCRayHit query{};
        query.ray.org_x = x - static_cast<float>(geometry.originWs().x);
        query.ray.org_y = 0.5F - static_cast<float>(geometry.originWs().y);
        query.ray.org_z = 0.25F - static_cast<float>(geometry.originWs().z);
        query.ray.dir_y = 1.0F;
        query.ray.tfar = 100.0F;
        query.ray.mask = 0xFFFFFFFFU;
        query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
        rtcIntersect1(geometry.casters(), &context.base, &query);
        EXPECT_EQ(query.hit.geomID != RTC_INVALID_GEOMETRY_ID, meets) << x;
    }
}

TEST(Clip, AMaskedCardAndAPaneOfGlassAreCutAsWell)
{
    for (const scene::AlphaMode mode : {scene::AlphaMode::mask, scene::AlphaMode::blend}) {
        scene::Scene scene;
        scene.materials.resize(1);
        scene.materials[0].alpha_mode = mode;
        scene.materials[0].base_colour = {0.5F, 0.5F, 0.5F, 1.0F};
        scene.materials[0].stained = true;
        place(scene, addQuad(scene, level(0.0F, 32.0F)));
        place(scene, addQuad(scene, ceiling(1.0F, -2.0F, 2.0F, 4.0F), 0)).clip_planes[0] = kLeftHalf;
        const Traced traced = trace(scene, lookDown(0.0, 0.9, 1.5, {16, 4}), sun({0.0, -1.0, 0.0}), hard());
        const double through = mode == scene::AlphaMode::mask ? 0.0 : 0.5;
        EXPECT_NEAR(traced.at(2, 2), through, 1e-6);
        EXPECT_EQ(traced.at(13, 2), 1.0);
    }
}

} // namespace
} // namespace gnomon::truth::test
