// SPDX-License-Identifier: Apache-2.0
// Where objects stand, and which of them are seen, cast and receive.
#include "support.h"

#include "camera_rays.h"
#include "scene_geometry.h"
#include "shadow_rays.h"

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace gnomon::truth::test {
namespace {

/// A cube many times: turned, stretched, mirrored, far smaller, half sunk into the ground.
scene::Scene cubes()
{
    scene::Scene scene;
    place(scene, addQuad(scene, level(0.0F, 32.0F)));
    scene::Node& node = place(scene, addCube(scene));
    node.matrix = glm::scale(glm::mat4(1.0F), glm::vec3(1.0F, 1.25F, 1.0F));
    const auto instance = [&](const glm::vec3& at, float turn, const glm::vec3& scale) {
        const glm::mat4 turned =
            glm::rotate(glm::translate(glm::mat4(1.0F), at), turn, glm::normalize(glm::vec3(0.2F, 1.0F, -0.4F)));
        node.instances.push_back(glm::scale(turned, scale));
    };
    instance({-3.0F, 1.5F, 0.0F}, 0.4F, {1.0F, 0.5F, 0.7F});
    instance({0.0F, 2.0F, 1.0F}, -1.2F, {-0.6F, 0.9F, 0.3F});
    instance({3.0F, 0.8F, -1.0F}, 2.2F, {0.4F, -1.1F, 0.8F});
    instance({0.5F, 1.0F, -3.0F}, 0.9F, {-0.5F, -0.5F, -0.2F});
    instance({-2.0F, 0.0F, 3.0F}, 0.1F, {0.01F, 2.0F, 0.5F});
    instance({2.0F, 2.0F, 2.5F}, 0.0F, {0.5F, 0.0F, 0.5F}); // flat
    return scene;
}

/// Takes the cube [-1, 1]^3 to where it stands; a flat one is a micrometre thick.
glm::dmat4 solid(const scene::Object& object)
{
    glm::dmat4 m(object.world_from_object);
    if (m[1] == glm::dvec4(0.0)) {
        m[1] = glm::dvec4(glm::normalize(glm::cross(glm::dvec3(m[2]), glm::dvec3(m[0]))) * 1e-6, 0.0);
    }
    return m;
}

/// Whether a cube, grown by `margin` of its half size, stands between the two points.
bool cubeBefore(const scene::State& state, const glm::dvec3& from, const glm::dvec3& to, double margin)
{
    return std::any_of(state.objects.begin(), state.objects.end(), [&](const scene::Object& object) {
        if (object.mesh != 1) {
            return false;
        }
        const glm::dmat4 inverse = glm::inverse(solid(object));
        const glm::dvec3 start(inverse * glm::dvec4(from, 1.0));
        const glm::dvec3 end(inverse * glm::dvec4(to, 1.0));
        return meetsCube(start, end - start, 1.0, margin);
    });
}

/// The budget of triangles that are copied: all, or none.
class Instances : public ::testing::TestWithParam<std::uint64_t> {};

TEST_P(Instances, mirrored_and_stretched_cubes_are_seen_and_cast_where_they_stand)
{
    scene::Scene scene = cubes();
    scene::finishScene(scene);
    const scene::State state = scene::evaluate(scene, 0.0);
    const SceneGeometry geometry(scene, state, GetParam());
    ASSERT_EQ(geometry.part(1).instanced, GetParam() == 0);
    ASSERT_FALSE(geometry.part(6).instanced); // a flat one has no inverse
    ASSERT_TRUE(geometry.part(6).skewed);
    const View view = lookAt({1.0, 9.0, 12.0}, {0.0, 1.0, 0.0}, 0.7, {160, 120});
    const CameraRays camera(geometry, view);
    const Light light = sun({0.5, -1.0, -0.3});
    const ShadowRays rays(geometry, light, hard());
    std::uint32_t counted = 0;
    std::uint32_t dark = 0;
    std::uint32_t on_flat = 0;
    for (std::uint32_t y = 0; y < 120; ++y) {
        for (std::uint32_t x = 0; x < 160; ++x) {
            const auto seen = camera.trace({x + 0.5, y + 0.5});
            ASSERT_TRUE(seen.has_value());
            const glm::dvec3 p = view.eye_ws + seen->point;
            ASSERT_FALSE(cubeBefore(state, view.eye_ws, view.eye_ws + seen->point * (1.0 - 1e-5), -1e-4));
            if (state.objects[seen->object].mesh == 0) {
                ASSERT_FALSE(cubeBefore(state, view.eye_ws, p, -1e-4));
            } else {
                const glm::dvec3 q(glm::inverse(solid(state.objects[seen->object])) * glm::dvec4(p, 1.0));
                const bool flat = geometry.part(seen->object).skewed;
                ASSERT_NEAR(std::max({std::abs(q.x), std::abs(q.y), std::abs(q.z), flat ? 1.0 : 0.0}), 1.0, 1e-3);
                on_flat += flat ? 1 : 0;
            }
            // Off the surface, so that the cube that the point is on does not count by rounding.
            const glm::dvec3 start = p + seen->normal * 1e-4;
            const glm::dvec3 end = start - light.direction_ws * 100.0;
            const bool faces = glm::dot(seen->normal, light.direction_ws) < 0.0;
            const bool outer = cubeBefore(state, start, end, 2e-3);
            const bool inner = cubeBefore(state, start, end, -2e-3);
            Receiver receiver{.object = seen->object, .triangle = seen->triangle};
            receiver.normal = seen->normal;
            const auto triangle = geometry.triangle(seen->object, seen->triangle);
            ASSERT_TRUE(triangle.has_value());
            receiver.rel = offSurface(p - geometry.originWs(), *triangle, seen->normal);
            const double v = rays.trace(receiver).visibility;
            if (!faces) {
                ASSERT_EQ(v, 0.0);
            } else if (state.objects[seen->object].mesh == 0 && outer == inner) {
                ASSERT_EQ(v, inner ? 0.0 : 1.0) << x << ' ' << y;
                ++counted;
                dark += inner ? 1 : 0;
            }
        }
    }
    EXPECT_GT(counted, 10000U);
    EXPECT_GT(dark, 500U);
    EXPECT_GT(on_flat, 100U);
}

INSTANTIATE_TEST_SUITE_P(copied_or_instanced, Instances, ::testing::Values(std::uint64_t{1} << 30, std::uint64_t{0}));

/// A cube over the ground, flattened along its y axis by `flatten` (0: for good), turned and moved; or the square that
/// this is to look like, two-sided.
Traced flattened(const glm::mat4& placed, float flatten, bool as_square, const Options& options)
{
    scene::Scene scene;
    scene.materials.resize(1);
    scene.materials[0].double_sided = true;
    place(scene, addQuad(scene, level(0.0F, 8.0F)));
    place(scene, as_square ? addQuad(scene, level(0.0F, 1.0F), 0) : addCube(scene),
          as_square ? placed : glm::scale(placed, glm::vec3(1.0F, flatten, 1.0F)));
    return trace(scene, lookAt({2.0, 6.0, 5.0}, {0.0, 0.8, 0.0}, 0.6, {120, 90}), sun({0.3, -1.0, 0.2}, 0.2), options);
}

TEST(Flattened, cube_is_seen_lit_and_casts_as_a_square)
{
    const glm::mat4 raised = glm::translate(glm::mat4(1.0F), glm::vec3(0.1F, 1.2F, -0.3F));
    const glm::mat4 turned = glm::rotate(raised, 0.7F, glm::normalize(glm::vec3(0.5F, 0.3F, -0.8F)));
    for (const glm::mat4& placed : {raised, turned}) {
        for (const Options& options : {hard(), area(64)}) {
            const Traced cube = flattened(placed, 0.0F, false, options);
            const Traced square = flattened(placed, 0.0F, true, options);
            expectSound(cube);
            double error = 0.0;
            std::uint32_t on_cube = 0;
            std::uint32_t other = 0;
            for (std::uint32_t y = 0; y < 90; ++y) {
                for (std::uint32_t x = 0; x < 120; ++x) {
                    on_cube += cube.id(x, y) == 2 ? 1 : 0;
                    other += cube.id(x, y) != square.id(x, y) ? 1 : 0;
                    error += std::abs(cube.at(x, y) - square.at(x, y));
                }
            }
            EXPECT_GT(on_cube, 800U);
            EXPECT_LE(other, 4U);
            EXPECT_LE(error, 4.0); // of 10800 pixels, at the rims of both
        }
    }
    // These must fail: a square that is not there, and a cube that is not flat.
    const Traced square = flattened(raised, 0.0F, true, hard());
    const Traced cube = flattened(raised, 0.2F, false, hard());
    EXPECT_NE(square.surfaces.object_ids.values, cube.surfaces.object_ids.values);
}

/// A ceiling over the ground, seen from above through its back unless it is two-sided; the middle is in its shadow.
struct Flags {
    double visibility = 0.0;
    std::uint32_t id = 0;
};
template <typename F>
Flags middleUnder(const F& change, double eye_height_m = 4.0)
{
    scene::Scene scene;
    scene.materials.resize(1);
    place(scene, addQuad(scene, level(0.0F, 8.0F)));
    place(scene, addQuad(scene, ceiling(1.0F, -1.0F, 1.0F, 1.0F), 0));
    change(scene);
    const Traced traced = trace(scene, lookDown(0.0, eye_height_m, 0.5, {4, 4}), sun({0.0, -1.0, 0.0}), area(64));
    expectSound(traced);
    return {traced.at(1, 2), traced.id(1, 2)};
}

TEST(Flags, decide_what_is_seen_casts_and_receives)
{
    const auto expect = [](const Flags& flags, std::uint32_t id, double visibility) {
        EXPECT_EQ(flags.id, id);
        EXPECT_EQ(flags.visibility, visibility);
    };
    expect(middleUnder([](scene::Scene&) {}), 1, 0.0); // seen through from behind, yet casts
    expect(middleUnder([](scene::Scene& s) { s.materials[0].double_sided = true; }), 2, 1.0);
    expect(middleUnder([](scene::Scene& s) { s.nodes[1].casts = false; }), 1, 1.0);
    expect(middleUnder([](scene::Scene& s) { s.nodes[0].receives = false; }), 1, 1.0);
    expect(middleUnder([](scene::Scene& s) { s.materials[0].alpha_mode = scene::AlphaMode::blend; }), 1, 0.0);
    // From its front, an object that does not cast is still seen, and a blended one is not.
    const auto flip = [](scene::Scene& s) {
        std::reverse(s.meshes[1].primitives[0].indices.begin(), s.meshes[1].primitives[0].indices.end());
    };
    expect(middleUnder(flip), 2, 1.0);
    expect(middleUnder([&](scene::Scene& s) {
               flip(s);
               s.nodes[1].casts = false;
           }),
           2, 1.0);
    expect(middleUnder([&](scene::Scene& s) {
               flip(s);
               s.materials[0].alpha_mode = scene::AlphaMode::blend;
           }),
           1, 0.0);
    // Nearer than the camera's near plane, or beyond its far plane, nothing is seen.
    expect(middleUnder(flip, 1.0005), 1, 0.0);
}

TEST(Flags, mirrored_quad_shows_the_side_that_a_mirror_makes_its_front)
{
    const auto mirror = [](scene::Scene& s) {
        s.nodes[1].matrix = glm::scale(glm::mat4(1.0F), glm::vec3(-1.0F, 1.0F, 1.0F));
    };
    EXPECT_EQ(middleUnder(mirror).id, 1U); // mirrored along its own plane it still faces down
    const auto overturn = [](scene::Scene& s) {
        s.nodes[1].matrix = glm::translate(glm::mat4(1.0F), glm::vec3(0.0F, 2.0F, 0.0F));
        s.nodes[1].matrix = glm::scale(s.nodes[1].matrix, glm::vec3(1.0F, -1.0F, 1.0F));
    };
    EXPECT_EQ(middleUnder(overturn).id, 2U); // mirrored through it, up
}

} // namespace
} // namespace gnomon::truth::test
