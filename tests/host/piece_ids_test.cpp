// SPDX-License-Identifier: Apache-2.0
// Ids by face: what an object throws on itself is there where each of its pieces has an id, and is not where it has
// one.
#include "host/frame_renderer.h"
#include "scene/state.h"
#include "small_scene.h"

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::host::test {
namespace {

constexpr std::uint32_t kSide = 128;

void addQuad(scene::Primitive& out, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& d)
{
    const auto first = static_cast<std::uint32_t>(out.positions.size());
    const glm::vec3 normal = glm::normalize(glm::cross(b - a, d - a));
    for (const glm::vec3& p : {a, b, c, d}) {
        out.positions.push_back(p);
        out.normals.push_back(normal);
    }
    for (const std::uint32_t i : {0U, 1U, 2U, 0U, 2U, 3U}) {
        out.indices.push_back(first + i);
    }
}

/// A wall and a step before it, in one mesh: an L, six deep along z.
scene::Primitive stepped()
{
    const std::vector<glm::vec2> outline{{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 3}, {0, 3}}; // counter-clockwise
    scene::Primitive out;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const glm::vec2 a = outline[i];
        const glm::vec2 b = outline[(i + 1) % outline.size()];
        addQuad(out, {a, 3.0F}, {a, -3.0F}, {b, -3.0F}, {b, 3.0F});
    }
    for (const float z : {-3.0F, 3.0F}) {
        addQuad(out, {0, 0, z}, {4, 0, z}, {4, 1, z}, {0, 1, z});
        addQuad(out, {0, 1, z}, {1, 1, z}, {1, 3, z}, {0, 3, z});
    }
    return out;
}

/// The sun comes over the wall, at 45 degrees: two metres of the step are in the wall's shadow.
scene::Scene steppedScene()
{
    scene::Scene scene;
    addMesh(scene, stepped());
    scene::Light sun;
    sun.intensity = 3.0F;
    scene.lights.push_back(sun);
    scene::Node node;
    node.light = 0;
    // -z turned to (1, -1, 0).
    node.transform.rotation = glm::angleAxis(-glm::half_pi<float>(), glm::vec3(0, 1, 0)) *
                              glm::angleAxis(-0.5F * glm::half_pi<float>(), glm::vec3(1, 0, 0));
    scene.nodes.push_back(node);
    scene::finishScene(scene);
    return scene;
}

ImageF maskOf(FrameRenderer& renderer, const scene::Scene& scene, const scene::State& state, const Eye& eye)
{
    renderer.draw(state, eye, lightsOf(scene, state));
    EXPECT_EQ(renderer.plan().lights[0].outcome.kind, OutcomeKind::ok) << renderer.plan().lights[0].outcome.reason;
    return renderer.read({.colour = false, .masks = true}).masks[0];
}

std::size_t darkIn(const ImageF& mask)
{
    return static_cast<std::size_t>(std::ranges::count_if(mask.values, [](float v) { return v < 0.5F; }));
}

TEST(PieceIds, PutAStepInTheShadowOfItsOwnWall)
{
    const scene::Scene scene = steppedScene();
    const scene::State state = scene::evaluate(scene, 0.0);
    Gpu gpu({.gpu = "software", .validate = true});
    const SceneOnGpu uploaded(gpu, scene, state);
    RenderOptions options;
    options.width = kSide;
    options.height = kSide;
    options.shadow.technique = kPlainTechnique;
    options.shadow.map_size = 256;
    FrameRenderer renderer(uploaded, options);
    const Eye eye{.position_ws = {2.5, 6.0, 0.5}, .target_ws = {2.5, 1.0, 0.0}};
    const auto drawn = [&](Filter filter, IdOf of) {
        options.shadow.technique.filter = filter;
        options.shadow.ids.of = of;
        renderer.setShadows(options.shadow);
        return maskOf(renderer, scene, state, eye);
    };
    const ImageF depths = drawn(Filter::hard, IdOf::object);
    const std::size_t in_shadow = darkIn(depths);
    EXPECT_GT(in_shadow, kSide * kSide / 8);
    // The wall's far side faces away from the sun, and is dark without a map.
    const ImageF whole = drawn(Filter::id, IdOf::object);
    const ImageF faces = drawn(Filter::id, IdOf::face);
    EXPECT_LT(darkIn(whole), in_shadow / 4);
    // One of 256 texels over 8 m is four pixels at most: the shadow is smaller by that along its edge.
    std::size_t lost = 0;
    std::size_t more = 0;
    for (std::size_t i = 0; i < depths.values.size(); ++i) {
        lost += depths.values[i] < 0.5F && faces.values[i] >= 0.5F ? 1 : 0;
        more += depths.values[i] >= 0.5F && faces.values[i] < 0.5F ? 1 : 0;
    }
    EXPECT_LT(lost, kSide * 5);
    EXPECT_LT(more, kSide / 4);
    // By the closed form: on the step, at y = 1, the shadow ends at x = 3.
    for (const auto& [x, is_lit] : {std::pair{1.3, false}, std::pair{2.0, false}, std::pair{2.7, false},
                                    std::pair{3.3, true}, std::pair{3.8, true}}) {
        const Camera camera = cameraOf(eye, kSide, kSide, state.bounds_ws);
        for (const double z : {-1.0, 0.0, 0.7}) {
            const glm::dvec4 clip = camera.clip_from_world * glm::dvec4(x, 1.0, z, 1.0);
            const auto column = static_cast<std::uint32_t>((0.5 + 0.5 * clip.x / clip.w) * kSide);
            const auto row = static_cast<std::uint32_t>((0.5 + 0.5 * clip.y / clip.w) * kSide);
            ASSERT_LT(column, kSide);
            ASSERT_LT(row, kSide);
            EXPECT_EQ(*faces.pixel(column, row), is_lit ? 1.0F : 0.0F) << x << " " << z;
            EXPECT_EQ(*whole.pixel(column, row), 1.0F) << x << " " << z;
        }
    }
    EXPECT_EQ(gpu.messages(), std::vector<std::string>{});
}

// A box that is skinned has the pieces of its rest pose; here is one that moves and lights, under a lamp, too.
TEST(PieceIds, AreOfDeformedMeshesToo)
{
    const scene::Scene scene = smallScene();
    Gpu gpu({.gpu = "software", .validate = true});
    const scene::State state = scene::evaluate(scene, 0.0);
    const SceneOnGpu uploaded(gpu, scene, state);
    RenderOptions options;
    options.width = 64;
    options.height = 64;
    options.shadow.technique = kPlainTechnique;
    options.shadow.technique.filter = Filter::depth_id;
    options.shadow.ids.of = IdOf::face;
    options.shadow.map_size = 128;
    FrameRenderer renderer(uploaded, options);
    for (const double time_s : {0.0, 0.7}) {
        const scene::State now = scene::evaluate(scene, time_s);
        renderer.draw(now, smallEye(), lightsOf(scene, now));
        const Plan& plan = renderer.plan();
        ASSERT_EQ(plan.object_pieces.size(), now.objects.size());
        for (std::size_t i = 0; i < now.objects.size(); ++i) {
            const scene::Mesh& mesh = scene.meshes[now.objects[i].mesh];
            EXPECT_EQ(plan.object_pieces[i], mesh.name == "mover" || mesh.name == "glow" || mesh.name == "shy" ? 6 : 1)
                << mesh.name;
        }
        const Picture picture = renderer.read({.colour = false, .masks = true});
        for (const ImageF& mask : picture.masks) {
            EXPECT_GT(darkIn(mask), 0U);
            EXPECT_LT(darkIn(mask), mask.values.size());
        }
    }
    EXPECT_EQ(gpu.messages(), std::vector<std::string>{});
}

} // namespace
} // namespace gnomon::host::test
