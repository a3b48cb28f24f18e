// SPDX-License-Identifier: Apache-2.0
// Filter smoothies on the GPU: how wide its penumbrae are and where, that maps which are kept keep their fins, and that
// fins say what edges found in the map say.
#include "host/frame_renderer.h"
#include "scene/state.h"
#include "small_scene.h"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace gnomon::host::test {
namespace {

ShadowOptions smooth(Filter filter, Soften soften = Soften::none)
{
    ShadowOptions shadow{.technique = kPlainTechnique};
    shadow.technique.filter = filter;
    shadow.technique.soften = soften;
    shadow.map_size = 512;
    shadow.smoothies.reach_texels = 32;
    return shadow;
}

// A wall that stands on the ground, thin along the light, and ends at x = 0.
constexpr double kSunAngle = 0.07;
constexpr std::uint32_t kSide = 256;
constexpr double kView_m = 8.0; // that many metres of the ground in the picture, from z = -1 on

scene::Scene wallScene()
{
    scene::Scene scene;
    scene.materials.resize(1);
    scene.materials[0].double_sided = true;
    const auto add = [&](const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& d) {
        scene::Primitive primitive;
        primitive.positions = {a, b, c, d};
        primitive.indices = {0, 1, 2, 0, 2, 3};
        addMesh(scene, primitive);
    };
    add({-9, 0, -9}, {-9, 0, 9}, {9, 0, 9}, {9, 0, -9});
    scene.nodes.back().casts = false;
    add({0, 0, 0}, {6, 0, 0}, {6, 9, 0}, {0, 9, 0}); // open: each of its edges has one triangle
    scene.lights.resize(1);
    scene::Node node;
    node.light = 0;
    node.transform.rotation = glm::angleAxis(3.1415927F, glm::vec3(0, 1, 0)) *
                              glm::angleAxis(-0.7853982F, glm::vec3(1, 0, 0)); // towards z, downwards
    scene.nodes.push_back(node);
    scene::finishScene(scene);
    return scene;
}

ImageF wallMask(Gpu& gpu, const ShadowOptions& shadow)
{
    const scene::Scene scene = wallScene();
    const scene::State state = scene::evaluate(scene, 0.0);
    RenderOptions options;
    options.width = kSide;
    options.height = kSide;
    options.shadow = shadow;
    std::vector<ShadedLight> lights = lightsOf(scene, state);
    lights[0].caster.angular_diameter_rad = kSunAngle;
    const SceneOnGpu uploaded(gpu, scene, state);
    FrameRenderer renderer(uploaded, options);
    constexpr double kEye_m = 40.0;
    const glm::dvec3 middle(0.0, 0.0, 0.5 * kView_m - 1.0);
    renderer.draw(state,
                  {.position_ws = middle + glm::dvec3(0.0, kEye_m, 1e-3),
                   .target_ws = middle,
                   .fov_y_rad = 2.0 * std::atan(0.5 * kView_m / kEye_m)},
                  lights);
    return renderer.read({.colour = false, .linear = false, .masks = true, .geometry = false}).masks[0];
}

/// Metres of the row at `z_m` whose visibility is between a tenth and nine tenths, on the wall's side of x = 0.
struct Penumbra {
    double width_m = 0.0;
    double middle_m = 0.0; // where visibility is a half
};

Penumbra penumbraAt(const ImageF& mask, double z_m)
{
    constexpr double kPixel_m = kView_m / kSide;
    const auto row = static_cast<std::uint32_t>((z_m + 1.0) / kPixel_m);
    const auto crossing = [&](float value) {
        for (std::uint32_t x = 1; x < kSide; ++x) {
            const float before = mask.values[row * kSide + x - 1];
            const float here = mask.values[row * kSide + x];
            if ((before - value) * (here - value) <= 0.0F && before != here) {
                return (x - 0.5 + (value - before) / (here - before) - 0.5 * kSide) * kPixel_m;
            }
        }
        ADD_FAILURE() << "visibility does not pass " << value << " at " << z_m << " m";
        return 99.0;
    };
    return {std::abs(crossing(0.9F) - crossing(0.1F)), crossing(0.5F)};
}

TEST(SmoothieFins, AreSharpInContactAndGrowWithTheDistance)
{
    Gpu gpu({.gpu = "software", .validate = true});
    const ImageF mask = wallMask(gpu, smooth(Filter::smoothies));
    constexpr double kPixel_m = kView_m / kSide;
    for (const double z : {0.04, 0.1}) {
        EXPECT_LE(penumbraAt(mask, z).width_m, 2.0 * kPixel_m) << z << " m from contact";
    }
    for (const double z : {4.0, 5.0, 6.0}) {                                  // nearer the filter itself is as wide
        const double half_m = z * std::sqrt(2.0) * std::tan(0.5 * kSunAngle); // as far as the light comes down
        const Penumbra found = penumbraAt(mask, z);
        EXPECT_NEAR(found.width_m, 0.8 * half_m, 0.1 * half_m) << z;
        // The umbra is that of a point light: the middle lies outside, where a true one's is on the edge.
        EXPECT_NEAR(std::abs(found.middle_m), 0.5 * half_m, 0.1 * half_m) << z;
    }
    EXPECT_EQ(gpu.messages(), std::vector<std::string>{});
}

TEST(SmoothieFins, AreAsWideInEveryFitAndPartition)
{
    Gpu gpu({.gpu = "software", .validate = true});
    for (const Partition partition : {Partition::single, Partition::cascades, Partition::sdsm}) {
        for (const Fit fit : {Fit::uniform, Fit::lispsm, Fit::tsm}) {
            ShadowOptions shadow = smooth(Filter::smoothies);
            shadow.technique.partition = partition;
            shadow.technique.fit = fit;
            shadow.max_distance_m = 60.0;
            const double z = 5.0;
            const double half_m = z * std::sqrt(2.0) * std::tan(0.5 * kSunAngle);
            const Penumbra found = penumbraAt(wallMask(gpu, shadow), z);
            EXPECT_NEAR(found.width_m, 0.8 * half_m, 0.15 * half_m) << nameOf(partition) << ' ' << nameOf(fit);
            EXPECT_NEAR(std::abs(found.middle_m), 0.5 * half_m, 0.15 * half_m)
                << nameOf(partition) << ' ' << nameOf(fit);
        }
    }
    EXPECT_EQ(gpu.messages(), std::vector<std::string>{});
}

TEST(SmoothieFins, EndAtTheirReach)
{
    Gpu gpu({.gpu = "software", .validate = true});
    ShadowOptions shadow = smooth(Filter::smoothies);
    const double wide_m = penumbraAt(wallMask(gpu, shadow), 6.0).width_m;
    shadow.smoothies.reach_texels = 4;
    const double narrow_m = penumbraAt(wallMask(gpu, shadow), 6.0).width_m;
    EXPECT_LT(narrow_m, 0.5 * wide_m);
    EXPECT_GT(narrow_m, 0.05 * wide_m);
    EXPECT_EQ(gpu.messages(), std::vector<std::string>{});
}

struct Moment {
    double time_s = 0.0;
    ImageF mask;
};

/// Frames of the small scene, whose box moves and whose flag is skinned.
std::vector<Moment> smallMasks(Gpu& gpu, const ShadowOptions& shadow, std::uint32_t light, double near_m = 0.0)
{
    scene::Scene scene = smallScene();
    scene.nodes[kMaskedNode].casts = false; // what is masked has no fins
    RenderOptions options;
    options.width = 192;
    options.height = 128;
    options.shadow = shadow;
    const SceneOnGpu uploaded(gpu, scene, scene::evaluate(scene, 0.0));
    FrameRenderer renderer(uploaded, options);
    std::vector<Moment> moments;
    for (const double time_s : {0.0, 0.1, 0.2, 0.3}) {
        const scene::State state = scene::evaluate(scene, time_s);
        std::vector<ShadedLight> lights = lightsOf(scene, state);
        for (ShadedLight& one : lights) {
            one.caster.angular_diameter_rad = 0.2;
            one.caster.radius_m = 0.4;
            one.caster.near_m = near_m > 0.0 ? near_m : one.caster.near_m;
        }
        renderer.draw(state, smallEye(), lights);
        moments.push_back(
            {time_s, renderer.read({.colour = false, .linear = false, .masks = true, .geometry = false}).masks[light]});
    }
    return moments;
}

TEST(SmoothieFins, OfMapsThatAreKeptAreThoseOfMapsDrawnAnew)
{
    Gpu gpu({.gpu = "software", .validate = true});
    for (const Partition partition : {Partition::single, Partition::cascades}) {
        ShadowOptions shadow = smooth(Filter::smoothies);
        shadow.technique.partition = partition;
        shadow.technique.motion = Motion::snap;
        shadow.keep_still = KeepStill::never;
        const std::vector<Moment> anew = smallMasks(gpu, shadow, 0);
        shadow.keep_still = KeepStill::always;
        const std::vector<Moment> kept = smallMasks(gpu, shadow, 0);
        for (std::size_t i = 0; i < anew.size(); ++i) {
            EXPECT_EQ(differing(kept[i].mask, anew[i].mask, 0.004F), 0U) << anew[i].time_s << " s";
        }
        EXPECT_GT(differing(anew.front().mask, anew.back().mask, 0.1F), 20U) << "nothing moved";
    }
    EXPECT_EQ(gpu.messages(), std::vector<std::string>{});
}

/// Pixels of the right part of the picture in the shadow or penumbra of a card under a spot light. The card rises to
/// the right, from 7.5 m below the light to 4 m.
std::size_t darkUnderCard(Gpu& gpu, Filter filter, double near_m)
{
    scene::Scene scene;
    scene.materials.resize(1);
    scene.materials[0].double_sided = true;
    for (const bool is_ground : {true, false}) {
        scene::Primitive card;
        card.positions = {{-1.0F, 0.5F, -0.7F}, {-1.0F, 0.5F, 0.7F}, {1.0F, 4.0F, 0.7F}, {1.0F, 4.0F, -0.7F}};
        if (is_ground) {
            card.positions = {{-9, 0, -9}, {-9, 0, 9}, {9, 0, 9}, {9, 0, -9}};
        }
        card.indices = {0, 1, 2, 0, 2, 3};
        addMesh(scene, card);
    }
    scene.nodes[1].receives = false;
    scene.lights.push_back({.type = scene::LightType::spot, .intensity = 60.0F, .range_m = 20.0F});
    scene.lights.back().outer_cone_rad = 0.5F;
    scene::Node node;
    node.light = 0;
    node.transform.translation = {0.0F, 8.0F, 0.0F};
    node.transform.rotation = glm::angleAxis(-1.5707963F, glm::vec3(1, 0, 0)); // down
    scene.nodes.push_back(node);
    scene::finishScene(scene);
    const scene::State state = scene::evaluate(scene, 0.0);
    RenderOptions options;
    options.width = 128;
    options.height = 128;
    options.shadow = smooth(filter);
    std::vector<ShadedLight> lights = lightsOf(scene, state);
    lights[0].caster.radius_m = 0.4;
    lights[0].caster.near_m = near_m;
    const SceneOnGpu uploaded(gpu, scene, state);
    FrameRenderer renderer(uploaded, options);
    renderer.draw(state, {.position_ws = {0.0, 6.0, 4.0}, .target_ws = {0.0, 0.0, 0.0}}, lights);
    const ImageF mask = renderer.read({.colour = false, .linear = false, .masks = true, .geometry = false}).masks[0];
    std::size_t dark = 0;
    for (std::uint32_t y = 0; y < options.height; ++y) {
        for (std::uint32_t x = options.width * 5 / 8; x < options.width; ++x) {
            dark += *mask.pixel(x, y) < 0.995F ? 1 : 0;
        }
    }
    return dark;
}

/// An object before a spot light's near plane casts no shadow, and has no fins.
TEST(SmoothieFins, EndAtTheNearPlane)
{
    Gpu gpu({.gpu = "software", .validate = true});
    constexpr double kThroughTheCard = 6.0;
    const std::size_t beside = darkUnderCard(gpu, Filter::pcf, kThroughTheCard);
    EXPECT_EQ(darkUnderCard(gpu, Filter::smoothies, kThroughTheCard), beside);
    const std::size_t whole = darkUnderCard(gpu, Filter::pcf, 1.0);
    EXPECT_GT(whole, beside + 100);
    EXPECT_GT(darkUnderCard(gpu, Filter::smoothies, 1.0), whole + 50);
    EXPECT_EQ(gpu.messages(), std::vector<std::string>{});
}

/// Two ways that share nothing before they are read.
TEST(SmoothieFins, SayWhatEdgesOfTheMapSay)
{
    Gpu gpu({.gpu = "software", .validate = true});
    for (const std::uint32_t light : {0U, 1U}) {
        const std::vector<Moment> fins = smallMasks(gpu, smooth(Filter::smoothies), light);
        const std::vector<Moment> edges = smallMasks(gpu, smooth(Filter::pcf, Soften::smoothies), light);
        const std::vector<Moment> without = smallMasks(gpu, smooth(Filter::pcf), light);
        for (std::size_t i = 0; i < fins.size(); ++i) {
            const std::size_t soft = differing(edges[i].mask, without[i].mask, 0.2F);
            EXPECT_GT(soft, 50U) << light << ' ' << fins[i].time_s;
            EXPECT_LT(differing(fins[i].mask, edges[i].mask, 0.2F), soft / 3) << light << ' ' << fins[i].time_s;
        }
    }
}

} // namespace
} // namespace gnomon::host::test
