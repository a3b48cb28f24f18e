// SPDX-License-Identifier: Apache-2.0
// Clip planes on the GPU: a scene whose objects are cut looks as one whose triangles end there, whatever a map is drawn
// by, and its shadows are the truth's.
#include "host/frame_renderer.h"
#include "panes_scene.h"
#include "scene/clip.h"
#include "scene/state.h"
#include "small_scene.h"
#include "traced.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::host::test {
namespace {

constexpr std::uint32_t kWidth = 160;
constexpr std::uint32_t kHeight = 120;
enum : std::uint32_t { kSun, kSpot, kPoint, kLights };

/// The planes that cut the box, the leaves, the pane and the lamp: one or two, level or at a slant.
using Cuts = std::array<scene::ClipPlanes, 4>;
Cuts someCuts()
{
    const auto plane = [](const glm::vec3& normal, float d) {
        return glm::vec4(glm::normalize(normal), d);
    };
    return {{{plane({-1.0F, -2.0F, 0.5F}, 0.2F), plane({0.0F, 0.0F, 1.0F}, 0.6F)},
             {plane({1.0F, 0.0F, 0.4F}, 0.1F), scene::kNoClipPlane},
             {scene::kNoClipPlane, plane({0.3F, 0.0F, -1.0F}, 0.1F)},
             {plane({0.0F, -1.0F, 0.0F}, 0.1F), scene::kNoClipPlane}}};
}

scene::Primitive cube(std::uint32_t material)
{
    scene::Primitive primitive;
    for (int axis = 0; axis < 3; ++axis) {
        for (const float side : {-1.0F, 1.0F}) {
            glm::vec3 normal(0.0F);
            normal[axis] = side;
            glm::vec3 u(0.0F);
            u[(axis + 1) % 3] = side;
            const glm::vec3 v = glm::cross(normal, u);
            const auto first = static_cast<std::uint32_t>(primitive.positions.size());
            for (const glm::vec3& corner : {normal - u - v, normal + u - v, normal + u + v, normal - u + v}) {
                primitive.positions.push_back(corner);
                primitive.normals.push_back(normal);
            }
            for (const std::uint32_t i : {0U, 1U, 2U, 0U, 2U, 3U}) {
                primitive.indices.push_back(first + i);
            }
        }
    }
    primitive.material = material;
    return primitive;
}

scene::Primitive card(std::uint32_t material)
{
    scene::Primitive primitive;
    primitive.positions = {{-1, 0, -1}, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}};
    primitive.normals.assign(4, {0, 1, 0});
    primitive.indices = {0, 1, 2, 0, 2, 3};
    primitive.material = material;
    return primitive;
}

/// Texture coordinates follow positions, so that they are the same whatever triangles there are.
void unwrap(scene::Primitive& primitive)
{
    primitive.uv0.clear();
    for (const glm::vec3& p : primitive.positions) {
        primitive.uv0.emplace_back(p.x * 0.5F + 0.5F, p.z * 0.5F + 0.5F);
    }
}

/// With its triangles cut themselves.
scene::Primitive bake(const scene::Primitive& whole, const scene::ClipPlanes& planes)
{
    scene::Primitive baked;
    baked.material = whole.material;
    for (std::size_t i = 0; i < whole.indices.size(); i += 3) {
        scene::Polygon triangle;
        for (std::size_t k = 0; k < 3; ++k) {
            triangle.add(glm::dvec3(whole.positions[whole.indices[i + k]]));
        }
        const scene::Polygon left = scene::clipped(triangle, planes);
        const auto first = static_cast<std::uint32_t>(baked.positions.size());
        for (std::size_t k = 0; k < left.count; ++k) {
            baked.positions.emplace_back(left.corners[k]);
            baked.normals.push_back(whole.normals[whole.indices[i]]);
        }
        for (std::uint32_t k = 2; k < left.count; ++k) {
            baked.indices.insert(baked.indices.end(), {first, first + k - 1, first + k});
        }
    }
    return baked;
}

enum class How : std::uint8_t { whole, cut, baked };

void addMaterials(scene::Scene& scene)
{
    scene::Image leaves{"leaves", 16, 16, std::vector<std::uint8_t>(16 * 16 * 4, 255)};
    for (std::uint32_t i = 0; i < 256; ++i) {
        leaves.rgba[i * 4 + 3] = ((i / 32 + i % 16 / 2) & 1U) != 0 ? 255 : 0;
    }
    scene.images = {leaves};
    scene.textures = {scene::Texture{.image = 0}};
    scene.materials.resize(4);
    scene.materials[1].alpha_mode = scene::AlphaMode::mask;
    scene.materials[1].double_sided = true;
    scene.materials[1].base_colour_texture.texture = 0;
    scene.materials[2].alpha_mode = scene::AlphaMode::blend;
    scene.materials[2].stained = true;
    scene.materials[2].base_colour = {0.25F, 0.5F, 1.0F, 0.5F};
    scene.materials[2].double_sided = true;
    scene.materials[3].emissive = {0.5F, 0.4F, 0.1F};
}

void addLights(scene::Scene& scene)
{
    scene.lights.resize(kLights);
    scene.lights[kSun].intensity = 3.0F;
    scene.lights[kSun].angular_diameter_rad = 0.0F; // as the truth takes it, which looks at centres
    scene.lights[kSpot] = {.type = scene::LightType::spot, .intensity = 300.0F, .range_m = 30.0F};
    scene.lights[kPoint] = {.type = scene::LightType::point, .intensity = 200.0F, .range_m = 30.0F};
    const std::array<glm::vec3, kLights> places{{{0, 9, 0}, {1, 8, 2}, {-0.6F, 5.0F, 1.4F}}};
    for (std::uint32_t i = 0; i < kLights; ++i) {
        scene::Node node;
        node.light = i;
        node.transform.translation = places[i];
        node.transform.rotation = glm::angleAxis(-1.3F, glm::vec3(1, 0, 0)); // -z becomes down, nearly
        scene.nodes.push_back(node);
    }
}

scene::Scene sceneOf(How how)
{
    const Cuts cuts = someCuts();
    scene::Scene scene;
    addMaterials(scene);
    scene::Primitive ground = card(0);
    for (glm::vec3& p : ground.positions) {
        p *= 8.0F;
    }
    addMesh(scene, ground);
    const std::array<scene::Primitive, 4> things{cube(scene::kNone), card(1), card(2), cube(3)};
    const std::array<glm::vec3, 4> places{{{-2.0F, 1.2F, 0.0F}, {2.0F, 1.5F, -1.5F}, {0.5F, 2.0F, 1.5F}, {3, 0.6F, 2}}};
    for (std::size_t i = 0; i < things.size(); ++i) {
        addMesh(scene, how == How::baked ? bake(things[i], cuts[i]) : things[i]);
        unwrap(scene.meshes.back().primitives[0]);
        scene::Node& node = scene.nodes.back();
        node.transform.translation = places[i];
        node.transform.scale = glm::vec3(i == 3 ? 0.5F : 1.0F);
        if (how == How::cut) {
            node.clip_planes = cuts[i];
        }
    }
    addLights(scene);
    scene::finishScene(scene);
    return scene;
}

Eye eyeOf()
{
    return {.position_ws = {0.5, 7.0, 7.5}, .target_ws = {0.2, 0.3, 0.0}};
}

struct Drawn {
    Picture picture;
    std::vector<bool> mapped; // by light
};

Drawn drawn(Gpu& gpu, How how, const ShadowOptions& shadow)
{
    const scene::Scene scene = sceneOf(how);
    const scene::State state = scene::evaluate(scene, 0.0);
    RenderOptions options;
    options.width = kWidth;
    options.height = kHeight;
    options.shadow = shadow;
    const SceneOnGpu uploaded(gpu, scene, state);
    FrameRenderer renderer(uploaded, options);
    renderer.draw(state, eyeOf(), lightsOf(scene, state));
    Drawn result{renderer.read({.colour = false, .linear = true, .masks = true, .geometry = true}), {}};
    for (const LightPlan& plan : renderer.plan().lights) {
        result.mapped.push_back(plan.view_count > 0);
    }
    return result;
}

struct Wish {
    const char* name;
    ShadowOptions shadow;
};
std::ostream& operator<<(std::ostream& out, const Wish& wish)
{
    return out << wish.name;
}

/// One for each way that casters' shaders are put together.
std::vector<Wish> wishes()
{
    const auto with = [](Filter filter, auto&& change) {
        ShadowOptions shadow = plainWith(filter);
        shadow.map_size = 256;
        shadow.technique.partition = Partition::single;
        change(shadow);
        return shadow;
    };
    const auto cascades = [](Partition partition, CascadePass pass) {
        return [=](ShadowOptions& shadow) {
            shadow.technique.partition = partition;
            shadow.cascades.pass = pass;
        };
    };
    return {{"depth", with(Filter::hard, [](ShadowOptions&) {})},
            {"colour", with(Filter::pcf, [](ShadowOptions& s) { s.format = MapFormat::r32f; })},
            {"cube", with(Filter::pcf, [](ShadowOptions& s) { s.technique.partition = Partition::cube; })},
            {"warp", with(Filter::hard, [](ShadowOptions& s) { s.technique.fit = Fit::lispsm; })},
            {"averaged", with(Filter::vsm, [](ShadowOptions&) {})},
            {"midpoint", with(Filter::hard, [](ShadowOptions& s) { s.faces = CasterFaces::midpoint; })},
            {"back", with(Filter::hard, [](ShadowOptions& s) { s.faces = CasterFaces::back; })},
            {"layered", with(Filter::hard, cascades(Partition::cascades, CascadePass::layered))},
            {"placed", with(Filter::hard, cascades(Partition::sdsm, CascadePass::each))},
            {"placed_layered", with(Filter::hard, cascades(Partition::sdsm, CascadePass::layered))},
            {"coloured", with(Filter::pcf, [](ShadowOptions& s) { s.translucent = Translucent::colour; })}};
}

class ClipOnGpu : public testing::TestWithParam<Wish> {};

/// Rounding moves an edge by less than a thousandth of a texel, so hardly a texel or a pixel changes sides.
TEST_P(ClipOnGpu, IsAsIfTrianglesEndedThere)
{
    Gpu gpu({.gpu = "software", .validate = true});
    const ShadowOptions& shadow = GetParam().shadow;
    const auto [cut, mapped] = drawn(gpu, How::cut, shadow);
    const Picture baked = drawn(gpu, How::baked, shadow).picture;
    const Picture whole = drawn(gpu, How::whole, shadow).picture;
    constexpr std::size_t kPixels = std::size_t{kWidth} * kHeight;
    ASSERT_EQ(cut.masks.size(), std::size_t{kLights});
    ASSERT_EQ(mapped.size(), std::size_t{kLights});
    EXPECT_TRUE(mapped[kSun] || mapped[kPoint]); // single maps have no point, six faces no sun
    for (std::size_t i = 0; i < kLights; ++i) {
        if (!mapped[i]) {
            continue;
        }
        EXPECT_LE(differing(cut.masks[i], baked.masks[i], 0.02F), kPixels / 400) << i;
        EXPECT_GT(differing(whole.masks[i], baked.masks[i], 0.02F), kPixels / 40) << i;
    }
    EXPECT_LE(differing(cut.linear, baked.linear, 0.02F), kPixels / 100);
    EXPECT_GT(differing(whole.linear, baked.linear, 0.02F), kPixels / 20);
    EXPECT_EQ(gpu.messages(), std::vector<std::string>{});
}

INSTANTIATE_TEST_SUITE_P(Shaders, ClipOnGpu, testing::ValuesIn(wishes()),
                         [](const auto& test) { return std::string(test.param.name); });

/// Box and leaves, in the light of a sun, a spot and a lamp.
TEST(ClipOnGpu, HasTheShadowsOfTheTruth)
{
    Gpu gpu({.gpu = "software", .validate = true});
    ShadowOptions shadow = plainWith(Filter::hard, Partition::automatic);
    shadow.map_size = 1024;
    shadow.translucent = Translucent::none;
    const Picture cut = drawn(gpu, How::cut, shadow).picture;
    const auto truth_of = [](How how, std::uint32_t light) {
        const scene::Scene scene = sceneOf(how);
        return tracedMask(scene, scene::evaluate(scene, 0.0), eyeOf(), kWidth, kHeight, light);
    };
    for (std::uint32_t light = 0; light < kLights; ++light) {
        const std::size_t wrong = wrongPixels(cut.masks[light], truth_of(How::cut, light));
        EXPECT_LT(wrong, std::size_t{kWidth} * kHeight / 400) << light;
        // The uncut scene differs visibly.
        EXPECT_GT(wrongPixels(cut.masks[light], truth_of(How::whole, light)), wrong * 8 + 100) << light;
    }
    EXPECT_EQ(gpu.messages(), std::vector<std::string>{});
}

} // namespace
} // namespace gnomon::host::test
