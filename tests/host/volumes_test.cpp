// SPDX-License-Identifier: Apache-2.0
// Filter volumes on the GPU: its mask is the truth of hard light, whatever casts and wherever the eye is.
#include "host/frame_renderer.h"
#include "scene/state.h"
#include "small_scene.h"
#include "traced.h"

#include <gnomon/error.h>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace gnomon::host::test {
namespace {

enum : std::uint32_t { kSunLight, kSpotLight, kPointLight, kShutInLight, kVolumeLights };

ShadowOptions byVolumes(OpenCasters open = OpenCasters::refuse)
{
    ShadowOptions shadow;
    shadow.technique.filter = Filter::volumes;
    shadow.volumes.open = open;
    return shadow;
}

/// Counter-clockwise seen from outside, with a vertex for each corner of each triangle.
void addFace(scene::Primitive& out, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c)
{
    const glm::vec3 normal = glm::normalize(glm::cross(b - a, c - a));
    for (const glm::vec3& p : {a, b, c}) {
        out.indices.push_back(static_cast<std::uint32_t>(out.positions.size()));
        out.positions.push_back(p);
        out.normals.push_back(normal);
    }
}

/// Eight faces, each divided in four, its corners drawn in and out: closed and not convex.
scene::Primitive body(const glm::vec3& wave)
{
    scene::Primitive out;
    const auto at = [&](const glm::vec3& p) {
        const glm::vec3 unit = glm::normalize(p);
        return unit * (0.7F + 0.3F * std::sin(glm::dot(wave, unit) + wave.x));
    };
    for (int octant = 0; octant < 8; ++octant) {
        const glm::vec3 x((octant & 1) != 0 ? 1.0F : -1.0F, 0, 0);
        glm::vec3 y(0, (octant & 2) != 0 ? 1.0F : -1.0F, 0);
        glm::vec3 z(0, 0, (octant & 4) != 0 ? 1.0F : -1.0F);
        if (x.x * y.y * z.z < 0.0F) {
            std::swap(y, z);
        }
        addFace(out, at(x), at(x + y), at(z + x));
        addFace(out, at(x + y), at(y), at(y + z));
        addFace(out, at(z + x), at(y + z), at(z));
        addFace(out, at(x + y), at(y + z), at(z + x));
    }
    return out;
}

scene::Primitive cubeOf(float h)
{
    scene::Primitive out;
    for (int axis = 0; axis < 3; ++axis) {
        for (const float side : {-1.0F, 1.0F}) {
            glm::vec3 n(0.0F);
            n[axis] = side;
            glm::vec3 u(0.0F);
            u[(axis + 1) % 3] = side;
            const glm::vec3 v = glm::cross(n, u);
            addFace(out, h * (n - u - v), h * (n + u - v), h * (n + u + v));
            addFace(out, h * (n - u - v), h * (n + u + v), h * (n - u + v));
        }
    }
    return out;
}

void addGround(scene::Scene& scene)
{
    scene::Primitive ground;
    addFace(ground, {-9, 0, -9}, {-9, 0, 9}, {9, 0, 9});
    addFace(ground, {-9, 0, -9}, {9, 0, 9}, {9, 0, -9});
    addMesh(scene, ground);
    scene.nodes.back().casts = false; // it is open
}

void addVolumeLights(scene::Scene& scene)
{
    scene.lights.resize(kVolumeLights);
    scene.lights[kSunLight].intensity = 3.0F;
    scene.lights[kSpotLight] = {.type = scene::LightType::spot, .intensity = 300.0F, .range_m = 30.0F};
    scene.lights[kSpotLight].outer_cone_rad = 1.04F; // nothing of the pictures is beside it
    scene.lights[kPointLight] = {.type = scene::LightType::point, .intensity = 200.0F, .range_m = 30.0F};
    scene.lights[kShutInLight] = {.type = scene::LightType::point, .intensity = 200.0F, .range_m = 9.0F};
    const std::array<glm::vec3, kVolumeLights> places{
        {{0, 9, 0}, {1.5F, 8.2F, 2.4F}, {-0.6F, 5.0F, 1.4F}, {2.5F, 0.9F, 1.5F}}}; // they graze no face (kGrazing)
    for (std::uint32_t i = 0; i < kVolumeLights; ++i) {
        scene::Node node;
        node.light = i;
        node.transform.translation = places[i];
        node.transform.rotation = glm::angleAxis(-1.3F, glm::vec3(1, 0, 0)); // -z becomes down, nearly
        scene.nodes.push_back(node);
    }
}

/// A body, a mirrored one, a cube around a lamp, one of two primitives that are open alone, and one that a morph target
/// draws up.
scene::Scene closedScene()
{
    scene::Scene scene;
    addGround(scene);
    addMesh(scene, body({2.1F, 4.0F, -3.0F}));
    scene.nodes.back().transform.translation = {-2.0F, 1.3F, 0.4F};
    addMesh(scene, body({-3.2F, 1.0F, 5.0F}));
    scene.nodes.back().transform.translation = {0.7F, 2.2F, -1.5F};
    scene.nodes.back().transform.scale = {-1.0F, 0.7F, 1.2F};
    addMesh(scene, cubeOf(0.5F));
    scene.nodes.back().transform.translation = {2.5F, 0.9F, 1.5F};
    scene::Primitive half = cubeOf(0.4F);
    scene::Primitive rest = half;
    half.indices.resize(9);
    rest.indices.erase(rest.indices.begin(), rest.indices.begin() + 9);
    addMesh(scene, half);
    scene.meshes.back().primitives.push_back(rest);
    scene.nodes.back().transform.translation = {-0.4F, 0.8F, 2.6F};
    scene::Primitive drawn_up = cubeOf(0.4F);
    scene::MorphTarget target;
    for (const glm::vec3& p : drawn_up.positions) {
        target.positions.push_back({p.y > 0.0F ? 0.7F : 0.0F, p.y > 0.0F ? 0.9F : 0.0F, 0.0F});
    }
    drawn_up.morph_targets.push_back(target);
    addMesh(scene, drawn_up);
    scene.meshes.back().morph_weights = {1.0F};
    scene.nodes.back().transform.translation = {2.0F, 0.7F, -2.5F};
    addVolumeLights(scene);
    scene::finishScene(scene);
    return scene;
}

RenderOptions sized(std::uint32_t width, std::uint32_t height)
{
    RenderOptions options;
    options.width = width;
    options.height = height;
    options.shadow = byVolumes();
    return options;
}

/// From above, from in a shadow, and so near to a caster that the near plane cuts its volume.
std::array<Eye, 3> someEyes()
{
    return {Eye{.position_ws = {0.5, 7.0, 7.5}, .target_ws = {0.2, 0.3, 0.0}},
            Eye{.position_ws = {-2.1, 0.25, 0.5}, .target_ws = {4.0, 0.1, 0.9}},
            Eye{.position_ws = {2.2, 1.6, 1.0}, .target_ws = {-1.0, 0.5, 0.2}, .near_m = 0.2}};
}

TEST(Volumes, AreTheTruthOnClosedScenes)
{
    constexpr std::uint32_t kWide = 192;
    constexpr std::uint32_t kHigh = 128;
    Gpu gpu({.gpu = "software", .validate = true});
    const scene::Scene scene = closedScene();
    const scene::State state = scene::evaluate(scene, 0.0);
    const SceneOnGpu uploaded(gpu, scene, state);
    FrameRenderer renderer(uploaded, sized(kWide, kHigh));
    std::size_t dark = 0;
    for (const Eye& eye : someEyes()) {
        renderer.draw(state, eye, lightsOf(scene, state));
        const Picture picture = renderer.read({.colour = false, .masks = true});
        ASSERT_EQ(picture.masks.size(), std::size_t{kVolumeLights});
        for (std::uint32_t light = 0; light < kVolumeLights; ++light) {
            const LightPlan& planned = renderer.plan().lights[light];
            if (planned.outcome.kind == OutcomeKind::no_receiver || planned.outcome.kind == OutcomeKind::no_caster) {
                continue;
            }
            EXPECT_EQ(planned.outcome.kind, OutcomeKind::ok) << planned.outcome.reason;
            EXPECT_GT(planned.volume_count, 0U);
            EXPECT_EQ(planned.view_count, 0U);
            const ImageF truth = tracedMask(scene, state, eye, kWide, kHigh, light);
            EXPECT_LE(wrongPixels(picture.masks[light], truth), std::size_t{kWide} * kHigh / 1000) << light;
            dark += static_cast<std::size_t>(std::ranges::count_if(truth.values, [](float v) { return v < 0.5F; }));
        }
    }
    EXPECT_GT(dark, std::size_t{kWide} * kHigh);
    EXPECT_EQ(gpu.messages(), std::vector<std::string>{});
}

/// A picture of 64 x 64 of random bodies, turned, scaled and mirrored, each lit by a sun, a spot and a lamp.
TEST(Volumes, AreTheTruthOfRandomBodies)
{
    Gpu gpu({.gpu = "software", .validate = true});
    std::mt19937 random(3);
    const auto in = [&](double low, double high) {
        return static_cast<float>(low + (high - low) * static_cast<double>(random()) / 4294967296.0);
    };
    std::size_t wrong = 0;
    std::size_t pixels = 0;
    for (int i = 0; i < 6; ++i) {
        scene::Scene scene;
        addGround(scene);
        for (int k = 0; k < 4; ++k) {
            addMesh(scene, body({in(-5, 5), in(-5, 5), in(-5, 5)}));
            scene::Node& node = scene.nodes.back();
            node.transform.translation = {in(-3, 3), in(0.9, 3), in(-3, 3)};
            node.transform.rotation = glm::normalize(glm::quat(in(-1, 1), in(-1, 1), in(-1, 1), in(-1, 1)));
            node.transform.scale = {in(0.4, 1.2) * (k % 2 == 0 ? 1.0F : -1.0F), in(0.4, 1.2), in(0.4, 1.2)};
        }
        addVolumeLights(scene);
        scene::finishScene(scene);
        const scene::State state = scene::evaluate(scene, 0.0);
        const Eye eye{.position_ws = {in(-4, 4), in(3, 7), in(5, 8)}, .target_ws = {in(-1, 1), 0.3, in(-1, 1)}};
        const SceneOnGpu uploaded(gpu, scene, state);
        FrameRenderer renderer(uploaded, sized(64, 64));
        renderer.draw(state, eye, lightsOf(scene, state));
        const Picture picture = renderer.read({.colour = false, .masks = true});
        for (const std::uint32_t light : {kSunLight, kSpotLight, kPointLight}) {
            ASSERT_EQ(renderer.plan().lights[light].outcome.kind, OutcomeKind::ok);
            wrong += wrongPixels(picture.masks[light], tracedMask(scene, state, eye, 64, 64, light));
            pixels += std::size_t{64} * 64;
        }
    }
    EXPECT_LE(wrong, pixels / 1000);
    EXPECT_EQ(gpu.messages(), std::vector<std::string>{});
}

TEST(Volumes, OfOpenCastersAreRefusedOrLeftOut)
{
    Gpu gpu({.gpu = "software", .validate = true});
    scene::Scene scene = closedScene();
    scene.nodes[0].casts = true; // the ground
    const scene::State state = scene::evaluate(scene, 0.0);
    const VolumeFaults faults = volumeFaults(scene, state);
    EXPECT_EQ(faults.objects, 1U);
    EXPECT_EQ(faults.sentences,
              (std::vector<std::string>{"mesh without a name is open: 4 of its edges have one triangle"}));
    const SceneOnGpu uploaded(gpu, scene, state);
    FrameRenderer renderer(uploaded, sized(64, 48));
    renderer.draw(state, someEyes()[0], lightsOf(scene, state));
    EXPECT_EQ(renderer.plan().lights[kSunLight].outcome.kind, OutcomeKind::refused);
    EXPECT_NE(renderer.plan().lights[kSunLight].outcome.reason.find("volumes.open=skip"), std::string_view::npos);
    const Picture lit = renderer.read({.colour = false, .masks = true});
    EXPECT_TRUE(std::ranges::all_of(lit.masks[kSunLight].values, [](float v) { return v == 1.0F; }));
    renderer.setShadows(byVolumes(OpenCasters::skip));
    renderer.draw(state, someEyes()[0], lightsOf(scene, state));
    const LightPlan& planned = renderer.plan().lights[kSunLight];
    EXPECT_EQ(planned.outcome.kind, OutcomeKind::ok) << planned.outcome.reason;
    EXPECT_EQ(planned.left_out, 1U);
    EXPECT_EQ(gpu.messages(), std::vector<std::string>{});
}

TEST(Volumes, SayWhyTheyCannotBeHad)
{
    const auto sentencesOf = [](auto&& change) {
        scene::Scene scene = closedScene();
        scene.materials.resize(1);
        change(scene);
        return volumeFaults(scene, scene::evaluate(scene, 0.0)).sentences;
    };
    const auto of = [](scene::AlphaMode mode) {
        return [=](scene::Scene& scene) {
            scene.materials[0].alpha_mode = mode;
            scene.meshes[1].primitives[0].material = 0;
            scene.meshes[1].name = "leaves";
        };
    };
    EXPECT_EQ(sentencesOf([](scene::Scene&) {}), std::vector<std::string>{});
    EXPECT_EQ(sentencesOf(of(scene::AlphaMode::mask)), std::vector<std::string>{"mesh leaves is masked"});
    EXPECT_EQ(sentencesOf(of(scene::AlphaMode::blend)), std::vector<std::string>{"mesh leaves is blended"});
    EXPECT_EQ(sentencesOf([](scene::Scene& scene) {
                  scene.meshes[1].name = "post";
                  scene.nodes[1].clip_planes[0] = {0.0F, 1.0F, 0.0F, 0.2F};
              }),
              std::vector<std::string>{"mesh post is cut by clip planes"});
    EXPECT_EQ(sentencesOf([](scene::Scene& scene) { // one of two primitives that close each other
                  scene.meshes[4].name = "parts";
                  scene.meshes[4].primitives[0].material = 0;
                  scene.materials[0].alpha_mode = scene::AlphaMode::mask;
              })
                  .size(),
              2U);
}

/// Full shadow is b, as it is with maps.
TEST(Volumes, AreLightened)
{
    Gpu gpu({.gpu = "software", .validate = true});
    const scene::Scene scene = closedScene();
    const scene::State state = scene::evaluate(scene, 0.0);
    const SceneOnGpu uploaded(gpu, scene, state);
    FrameRenderer renderer(uploaded, sized(64, 48));
    const auto darkestOf = [&](const ShadowOptions& shadow) {
        renderer.setShadows(shadow);
        renderer.draw(state, someEyes()[0], lightsOf(scene, state));
        float darkest = 1.0F;
        const ImageF mask = renderer.read({.colour = false, .masks = true}).masks[kSunLight];
        for (const float v : mask.values) {
            darkest = v > 0.0F ? std::min(darkest, v) : darkest; // 0 faces away
        }
        return darkest;
    };
    EXPECT_EQ(darkestOf(byVolumes()), 1.0F);
    for (const LightenAs as : {LightenAs::remap, LightenAs::add}) {
        ShadowOptions shadow = byVolumes();
        shadow.lighten = 0.4F;
        shadow.lighten_as = as;
        EXPECT_NEAR(darkestOf(shadow), 0.4F, 1.0F / 255.0F);
    }
}

} // namespace
} // namespace gnomon::host::test
