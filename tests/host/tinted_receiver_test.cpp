// SPDX-License-Identifier: Apache-2.0
// Panes of glass in the light behind other panes: what arrives at them has the colour that arrives at an opaque
// surface.
#include "host/frame_renderer.h"
#include "panes_scene.h"
#include "scene/state.h"
#include "small_scene.h"

#include <glm/ext/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::host::test {
namespace {

constexpr std::uint32_t kWidth = 64;
constexpr std::uint32_t kHeight = 48;
constexpr float kReceiver_m = 1.0F;
constexpr float kGlass_m = 3.4F;
constexpr float kFree_m = -0.2F;             // x of a point beside the glass
constexpr float kUnder_m = 0.6F;             // and of one behind it
const glm::vec3 kGreen{0.16F, 0.64F, 0.36F}; // whose square roots a G-buffer of 8 bits holds exactly
/// Between glass and receiver.
const Eye kBetween{.position_ws = {0.0, 3.2, 0.01}, .target_ws = {0, 0, 0}};

enum : std::uint32_t { kSun, kSpot };

struct Wish {
    std::vector<Pane> glass{{kGlass_m}};
    bool opaque = false;    // a level surface of 8 m, of the pane's colour
    bool pane = true;       // in the very same place
    glm::vec4 colour{1.0F}; // of the pane
    bool pane_casts = true;
    bool blocker = false; // a strip of shadow beside the glass
};

scene::Material matte(const glm::vec4& colour)
{
    scene::Material material;
    material.base_colour = colour;
    material.metallic = 0.0F;
    material.double_sided = true;
    return material;
}

scene::Scene sceneOf(const Wish& wish)
{
    scene::Scene scene = panes(wish.glass);
    scene.nodes.erase(scene.nodes.begin()); // the ground
    scene.materials[0] = matte(glm::vec4(glm::vec3(wish.colour), 1.0F));
    if (wish.opaque) {
        addLevel(scene, -4.0F, 4.0F, kReceiver_m, 0);
    }
    if (wish.pane) {
        scene.materials.push_back(matte(wish.colour));
        scene.materials.back().alpha_mode = scene::AlphaMode::blend;
        scene.materials.back().stained = true;
        addLevel(scene, -4.0F, 4.0F, kReceiver_m, static_cast<std::uint32_t>(scene.materials.size() - 1));
        scene.nodes.back().casts = wish.pane_casts;
    }
    if (wish.blocker) {
        addLevel(scene, -0.8F, -0.4F, 3.5F, 0);
    }
    scene.lights[kSun].intensity = 3.0F;
    scene.lights[kSpot].intensity = 300.0F;
    finishScene(scene);
    return scene;
}

/// One scene and one renderer of it.
class Stage {
public:
    Stage(Gpu& gpu, const Wish& wish, const ShadowOptions* shadow)
        : scene_(sceneOf(wish)), state_(stateOf(scene_)), uploaded_(gpu, scene_, state_),
          renderer_(uploaded_, optionsOf(shadow)), lights_(lightsOf(scene_, state_))
    {
    }
    Stage(Gpu& gpu, const Wish& wish, ShadowOptions shadow, Translucent translucent)
        : Stage(gpu, wish, &(shadow.translucent = translucent, shadow))
    {
    }
    /// Light that arrives at the eye from these lights, and from the sky.
    ImageF drawn(const std::vector<std::uint32_t>& lights)
    {
        std::vector<ShadedLight> some;
        for (const std::uint32_t light : lights) {
            some.push_back(lights_[light]);
        }
        renderer_.submit(state_, kBetween, some, nullptr);
        times_ = renderer_.finish();
        return renderer_.read({.colour = false, .linear = true}).linear;
    }
    /// Were maps of tints drawn in the last frame?
    [[nodiscard]] bool tinted() const
    {
        return std::ranges::any_of(times_.passes, [](const vulkan::PassRecord& pass) {
            return std::string_view(pass.name) == "maps of tints";
        });
    }
    /// The first pane of the glass, to its place or out of the light.
    void moveGlass(bool away)
    {
        scene::Object& glass = state_.objects.front();
        const glm::vec3 step(away ? 60.0F : -60.0F, 0.0F, 0.0F);
        glass.world_from_object = glm::translate(glass.world_from_object, step);
        glass.bounds_ws = {glass.bounds_ws.min + step, glass.bounds_ws.max + step};
    }
    [[nodiscard]] Camera camera() const { return cameraOf(kBetween, kWidth, kHeight, state_.bounds_ws); }

private:
    static scene::State stateOf(const scene::Scene& scene)
    {
        scene::State state = scene::evaluate(scene, 0.0);
        state.objects.front().dynamic = true;
        return state;
    }
    static RenderOptions optionsOf(const ShadowOptions* shadow)
    {
        RenderOptions options;
        options.width = kWidth;
        options.height = kHeight;
        options.shadows = shadow != nullptr;
        options.shadow = shadow != nullptr ? *shadow : options.shadow;
        return options;
    }

    scene::Scene scene_;
    scene::State state_;
    SceneOnGpu uploaded_;
    FrameRenderer renderer_;
    std::vector<ShadedLight> lights_;
    FrameTimes times_;
};

/// The share of each colour of a light that arrives at points of a pane, from pictures of the pane without shadows and
/// without light.
class Probe {
public:
    Probe(Gpu& gpu, const Wish& wish)
        : free_(gpu, wish, nullptr), lit_{free_.drawn({kSun}), free_.drawn({kSpot})}, dark_(free_.drawn({}))
    {
    }
    void expect(const ImageF& picture, std::uint32_t light, float x, const glm::vec3& wanted) const
    {
        const glm::dvec4 clip = free_.camera().clip_from_world * glm::dvec4(x, kReceiver_m, 0.0, 1.0);
        const auto column = static_cast<std::uint32_t>((clip.x / clip.w * 0.5 + 0.5) * kWidth);
        const auto row = static_cast<std::uint32_t>((clip.y / clip.w * 0.5 + 0.5) * kHeight);
        for (int c = 0; c < 3; ++c) {
            const float dark = dark_.pixel(column, row)[c];
            const float lit = lit_[light].pixel(column, row)[c] - dark;
            ASSERT_GT(lit, 0.0F);
            EXPECT_NEAR((picture.pixel(column, row)[c] - dark) / lit, wanted[c], 0.01F) << x << " m, colour " << c;
        }
    }

private:
    Stage free_;
    std::array<ImageF, 2> lit_;
    ImageF dark_;
};

class TintedReceiver : public testing::Test {
protected:
    void TearDown() override { EXPECT_EQ(gpu_.messages(), std::vector<std::string>{}); }

    /// `under` behind the glass, for sun and spot light, and all of the light beside it.
    void expectBehind(const Wish& wish, const ShadowOptions& shadow, Translucent translucent, const glm::vec3& under)
    {
        const Probe probe(gpu_, wish);
        Stage stage(gpu_, wish, shadow, translucent);
        for (const std::uint32_t light : {kSun, kSpot}) {
            SCOPED_TRACE(std::string(nameOf(shadow.technique.filter)) + ", light " + std::to_string(light));
            const ImageF picture = stage.drawn({light});
            probe.expect(picture, light, kUnder_m, under);
            probe.expect(picture, light, kFree_m, glm::vec3(1.0F));
        }
    }

    Gpu gpu_{{.gpu = "software", .validate = true}};
};

std::vector<ShadowOptions> someTechniques()
{
    return {plainWith(Filter::pcf), plainWith(Filter::raymarch), plainWith(Filter::esm),
            plainWith(Filter::pcf, Partition::cascades), plainWith(Filter::pcf, Partition::sdsm)};
}

// The same function of the same point of the same maps, except for the rounding of a mask of 8 bits, and of a point
// that the mask takes from the depth buffer.
TEST_F(TintedReceiver, HasTheLightOfAnOpaqueSurfaceInItsPlace)
{
    for (const Translucent translucent : {Translucent::colour, Translucent::grey}) {
        for (const ShadowOptions& shadow : someTechniques()) {
            Stage opaque(gpu_, {.opaque = true, .pane = false, .blocker = true}, shadow, translucent);
            Stage both(gpu_, {.opaque = true, .blocker = true}, shadow, translucent);
            for (const std::uint32_t light : {kSun, kSpot}) {
                // An exponential of the depth magnifies what a point is rounded by.
                const float share = shadow.technique.filter == Filter::esm ? 0.02F : 0.005F;
                EXPECT_EQ(differing(both.drawn({light}), opaque.drawn({light}), share), 0U)
                    << nameOf(shadow.technique.filter) << ", light " << light;
            }
        }
    }
    // A pane without tints is seen to differ.
    Stage opaque(gpu_, {.opaque = true, .pane = false}, plainWith(Filter::pcf), Translucent::colour);
    Stage untinted(gpu_, {.opaque = true}, plainWith(Filter::pcf), Translucent::none);
    EXPECT_GT(differing(untinted.drawn({kSun}), opaque.drawn({kSun}), 0.005F), 1000U);
}

TEST_F(TintedReceiver, HasTheColourOfTheGlassBeforeItOrItsLuminanceOrNothing)
{
    for (const ShadowOptions& shadow : plainWithAll()) {
        expectBehind({}, shadow, Translucent::colour, through());
    }
    expectBehind({}, plainWith(Filter::pcf), Translucent::grey, glm::vec3(luminance(through())));
    expectBehind({}, plainWith(Filter::pcf), Translucent::none, glm::vec3(1.0F));
}

// Its own colour is in the map as well.
TEST_F(TintedReceiver, IsNotTintedByItself)
{
    for (const float alpha : {1.0F, 0.25F}) {
        for (const Filter filter : {Filter::pcf, Filter::esm}) {
            Wish wish{.colour = glm::vec4(kGreen, alpha)};
            expectBehind(wish, plainWith(filter), Translucent::colour, through());
            expectBehind(wish, plainWith(filter), Translucent::grey, glm::vec3(luminance(through())));
            wish.pane_casts = false;
            expectBehind(wish, plainWith(filter), Translucent::colour, through());
        }
    }
    // As an opaque surface of its colour.
    Stage opaque(gpu_, {.opaque = true, .pane = false, .colour = glm::vec4(kGreen, 1.0F)}, plainWith(Filter::pcf),
                 Translucent::colour);
    Stage pane(gpu_, {.colour = glm::vec4(kGreen, 1.0F)}, plainWith(Filter::pcf), Translucent::colour);
    for (const std::uint32_t light : {kSun, kSpot}) {
        EXPECT_EQ(differing(pane.drawn({light}), opaque.drawn({light}), 0.005F), 0U) << light;
    }
}

TEST_F(TintedReceiver, HasTheProductOfThePanesBeforeIt)
{
    const Pane red{3.8F, {1.0F, 0.5F, 0.25F}};
    const Wish wish{.glass = {Pane{kGlass_m}, red}, .colour = glm::vec4(kGreen, 0.5F)};
    expectBehind(wish, plainWith(Filter::pcf), Translucent::colour, through() * through(red.colour));
}

TEST_F(TintedReceiver, StaysRightWhileGlassComesAndGoes)
{
    const Wish wish{.pane_casts = false, .blocker = true}; // so that without the glass there are no tints
    Stage stage(gpu_, wish, plainWith(Filter::pcf), Translucent::colour);
    struct Step {
        bool away;
        std::vector<std::uint32_t> lights; // a light more needs larger images
    };
    const std::vector<Step> steps{{false, {kSun}},        {true, {kSun}},         {true, {kSun, kSpot}},
                                  {false, {kSun, kSpot}}, {true, {kSun, kSpot}},  {true, {kSpot}},
                                  {false, {kSpot}},       {false, {kSun, kSpot}}, {false, {kSun, kSpot}},
                                  {true, {kSun}},         {false, {kSun}}};
    bool away = false;
    for (std::size_t i = 0; i < steps.size(); ++i) {
        if (steps[i].away != away) {
            away = steps[i].away;
            stage.moveGlass(away);
        }
        const ImageF picture = stage.drawn(steps[i].lights);
        const bool repeats = i > 0 && steps[i].away == steps[i - 1].away && steps[i].lights == steps[i - 1].lights;
        EXPECT_EQ(stage.tinted(), !away && !repeats) << "step " << i;
        Stage fresh(gpu_, wish, plainWith(Filter::pcf), Translucent::colour);
        if (away) {
            fresh.moveGlass(true);
        }
        EXPECT_EQ(differing(picture, fresh.drawn(steps[i].lights), 0.001F), 0U) << "step " << i;
    }
}

} // namespace
} // namespace gnomon::host::test
