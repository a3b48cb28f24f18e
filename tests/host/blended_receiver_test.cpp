// SPDX-License-Identifier: Apache-2.0
// Shadows on panes of glass. Panes here have an alpha of 1, so that a pixel holds their light and no other.
#include "host/frame_renderer.h"
#include "scene/state.h"
#include "small_scene.h"

#include <gtest/gtest.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::host::test {
namespace {

constexpr std::uint32_t kWidth = 96;
constexpr std::uint32_t kHeight = 72;
constexpr float kHeight_m = 1.0F; // of the panes
const Eye kAbove{.position_ws = {0.6, 8.0, 0.01}, .target_ws = {0.6, 0.0, 0.0}};

enum : std::uint32_t { kSun, kSpot };

scene::Primitive level(float side_m, std::uint32_t material)
{
    const float h = 0.5F * side_m;
    scene::Primitive primitive;
    primitive.positions = {{-h, 0, -h}, {-h, 0, h}, {h, 0, h}, {h, 0, -h}};
    primitive.indices = {0, 1, 2, 0, 2, 3};
    primitive.material = material;
    return primitive;
}

/// The node of what was added.
std::uint32_t add(scene::Scene& scene, scene::Primitive primitive, glm::vec3 at)
{
    addMesh(scene, std::move(primitive));
    scene.nodes.back().transform.translation = at;
    return static_cast<std::uint32_t>(scene.nodes.size() - 1);
}

/// From (-6, 6, 0), along (1, -1, 0).
void addLight(scene::Scene& scene, scene::LightType type, float intensity)
{
    scene::Light light;
    light.type = type;
    light.intensity = intensity;
    light.outer_cone_rad = 0.7F;
    scene::Node node;
    node.light = static_cast<std::uint32_t>(scene.lights.size());
    node.transform.translation = {-6.0F, 6.0F, 0.0F};
    node.transform.rotation =
        glm::angleAxis(-0.7853982F, glm::vec3(0, 0, 1)) * glm::angleAxis(-1.5707964F, glm::vec3(0, 1, 0));
    scene.lights.push_back(light);
    scene.nodes.push_back(node);
}

struct Wish {
    bool opaque = false; // a level surface of 8 m
    bool pane = true;    // in the very same place
    bool lid = true;     // of 2 m around (-3, 3, 0); its shadow on them is around (-1, 1, 0)
    bool receives = true;
};

scene::Scene sceneOf(const Wish& wish)
{
    scene::Scene scene;
    scene.materials.resize(2);
    for (scene::Material& material : scene.materials) {
        material.base_colour = glm::vec4(1.0F); // which a G-buffer of 8 bits holds exactly
        material.metallic = 0.0F;
        material.roughness = 1.0F;
        material.double_sided = true;
    }
    scene.materials[1].alpha_mode = scene::AlphaMode::blend;
    if (wish.lid) {
        add(scene, level(2.0F, 0), {-3.0F, 3.0F, 0.0F});
    }
    if (wish.opaque) {
        add(scene, level(8.0F, 0), {0.0F, kHeight_m, 0.0F});
    }
    if (wish.pane) {
        scene.nodes[add(scene, level(8.0F, 1), {0.0F, kHeight_m, 0.0F})].receives = wish.receives;
    }
    addLight(scene, scene::LightType::directional, 3.0F);
    addLight(scene, scene::LightType::spot, 100.0F);
    finishScene(scene);
    return scene;
}

ShadowOptions plainWith(Filter filter, Partition partition = Partition::single)
{
    ShadowOptions shadow{.technique = kPlainTechnique};
    shadow.technique.filter = filter;
    shadow.technique.partition = partition;
    shadow.map_size = 256;
    return shadow;
}

/// One scene and one renderer of it.
class Stage {
public:
    Stage(Gpu& gpu, const Wish& wish, const std::optional<ShadowOptions>& shadow)
        : scene_(sceneOf(wish)), state_(scene::evaluate(scene_, 0.0)), uploaded_(gpu, scene_, state_),
          renderer_(uploaded_, optionsOf(shadow)), lights_(lightsOf(scene_, state_))
    {
    }
    /// Light that arrives at the eye from sun or spot light, and from the sky.
    ImageF drawn(std::uint32_t light, const Eye& eye = kAbove, const std::vector<ImageF>* masks_instead = nullptr)
    {
        renderer_.draw(state_, eye, {lights_[light]}, masks_instead);
        return renderer_.read({.colour = false, .linear = true}).linear;
    }
    /// The last moment once more, with its maps.
    ImageF drawnAgain(std::uint32_t light, const Eye& eye)
    {
        renderer_.drawAgain(state_, eye, {lights_[light]});
        return renderer_.read({.colour = false, .linear = true}).linear;
    }
    ImageF skyAlone(const Eye& eye = kAbove)
    {
        renderer_.draw(state_, eye, {});
        return renderer_.read({.colour = false, .linear = true}).linear;
    }
    FrameRenderer& renderer() { return renderer_; }
    [[nodiscard]] Camera camera(const Eye& eye) const { return cameraOf(eye, kWidth, kHeight, state_.bounds_ws); }

private:
    static RenderOptions optionsOf(const std::optional<ShadowOptions>& shadow)
    {
        RenderOptions options;
        options.width = kWidth;
        options.height = kHeight;
        options.shadows = shadow.has_value();
        options.shadow = shadow.value_or(options.shadow);
        return options;
    }

    scene::Scene scene_;
    scene::State state_;
    SceneOnGpu uploaded_;
    FrameRenderer renderer_;
    std::vector<ShadedLight> lights_;
};

class BlendedReceiver : public testing::Test {
protected:
    void TearDown() override { EXPECT_EQ(gpu_.messages(), std::vector<std::string>{}); }

    Gpu gpu_{{.gpu = "software", .validate = true}};
};

// The same function of the same point of the same maps, except for the rounding of a mask of 8 bits, and of a point
// that the mask takes from the depth buffer.
TEST_F(BlendedReceiver, HasTheShadowOfAnOpaqueSurfaceInItsPlace)
{
    std::vector<ShadowOptions> all;
    for (const Filter filter : {Filter::hard, Filter::pcf, Filter::pcss, Filter::raymarch, Filter::vsm, Filter::lvsm,
                                Filter::esm, Filter::evsm, Filter::msm}) {
        all.push_back(plainWith(filter));
    }
    for (const Filter filter : {Filter::pcf, Filter::evsm}) {
        all.push_back(plainWith(filter, Partition::cascades));
        all.push_back(plainWith(filter, Partition::sdsm));
    }
    for (std::size_t i = 0; i < all.size(); ++i) {
        Stage opaque(gpu_, {.opaque = true, .pane = false}, all[i]);
        Stage both(gpu_, {.opaque = true}, all[i]);
        for (const std::uint32_t light : {kSun, kSpot}) {
            // An exponential of the depth magnifies what a point is rounded by.
            const float share = all[i].technique.filter == Filter::esm ? 0.02F : 0.005F;
            EXPECT_EQ(differing(both.drawn(light), opaque.drawn(light), share), 0U) << i << " " << light;
        }
    }
    // A pane without shadow is seen to differ.
    Stage opaque(gpu_, {.opaque = true, .pane = false}, all.front());
    Stage unshadowed(gpu_, {.opaque = true, .receives = false}, all.front());
    EXPECT_GT(differing(unshadowed.drawn(kSun), opaque.drawn(kSun), 0.005F), 100U);
}

/// Visibility of a light at points of a pane, by what the pane is without shadows and without light.
class Probe {
public:
    explicit Probe(Gpu& gpu, const Wish& wish = {}, const Eye& eye = kAbove)
        : free_(gpu, wish, std::nullopt), eye_(eye), lit_{free_.drawn(kSun, eye), free_.drawn(kSpot, eye)},
          dark_(free_.skyAlone(eye))
    {
    }
    [[nodiscard]] float at(const ImageF& picture, std::uint32_t light, float x) const
    {
        const glm::dvec4 clip = free_.camera(eye_).clip_from_world * glm::dvec4(x, kHeight_m, 0.0, 1.0);
        const auto column = static_cast<std::uint32_t>((clip.x / clip.w * 0.5 + 0.5) * kWidth);
        const auto row = static_cast<std::uint32_t>((clip.y / clip.w * 0.5 + 0.5) * kHeight);
        const float dark = *dark_.pixel(column, row);
        return (*picture.pixel(column, row) - dark) / (*lit_[light].pixel(column, row) - dark);
    }
    /// It is dark in the lid's shadow and lit to both sides of that.
    void expectShadow(const ImageF& picture, std::uint32_t light) const
    {
        EXPECT_NEAR(at(picture, light, -1.0F), 0.0F, 0.01F);
        EXPECT_NEAR(at(picture, light, -2.9F), 1.0F, 0.01F);
        EXPECT_NEAR(at(picture, light, 1.5F), 1.0F, 0.01F);
    }
    void expectLit(const ImageF& picture, std::uint32_t light) const
    {
        for (const float x : {-2.9F, -1.0F, 1.5F}) {
            EXPECT_EQ(at(picture, light, x), 1.0F) << x;
        }
    }
    [[nodiscard]] const ImageF& lit(std::uint32_t light) const { return lit_[light]; }

private:
    Stage free_;
    Eye eye_;
    std::array<ImageF, 2> lit_;
    ImageF dark_;
};

TEST_F(BlendedReceiver, TakesNoShadowFromItselfOrWhereItReceivesNone)
{
    for (const Wish& wish : {Wish{.lid = false}, Wish{.receives = false}}) {
        const Probe probe(gpu_, wish);
        for (const Filter filter : {Filter::hard, Filter::evsm}) {
            Stage stage(gpu_, wish, plainWith(filter));
            for (const std::uint32_t light : {kSun, kSpot}) {
                EXPECT_EQ(differing(stage.drawn(light), probe.lit(light), 0.002F), 0U) << nameOf(filter);
            }
        }
    }
}

TEST_F(BlendedReceiver, HasItsShadowFromMapsThatAreKept)
{
    const Eye aside{.position_ws = {0.6, 7.5, 0.5}, .target_ws = {0.6, 0.0, 0.0}};
    const Probe probe(gpu_, {}, aside);
    Stage stage(gpu_, {}, plainWith(Filter::pcf));
    for (const std::uint32_t light : {kSun, kSpot}) {
        for (int i = 0; i < 3; ++i) { // of which the later ones draw no map
            (void)stage.drawn(light);
        }
        probe.expectShadow(stage.drawnAgain(light, aside), light);
    }
}

TEST_F(BlendedReceiver, HasItsShadowWhileFramesAreJoinedAndSunsStep)
{
    const Probe probe(gpu_);
    ShadowOptions converging = plainWith(Filter::raymarch);
    converging.technique.soften = Soften::converge;
    ShadowOptions alternating = plainWith(Filter::pcf);
    alternating.technique.motion = Motion::step_alternate;
    for (const ShadowOptions& shadow : {converging, alternating}) {
        Stage stage(gpu_, {}, shadow);
        for (int i = 0; i < 3; ++i) {
            probe.expectShadow(stage.drawn(kSun), kSun);
        }
    }
}

TEST_F(BlendedReceiver, FollowsATechniqueThatChanges)
{
    const Probe probe(gpu_);
    Stage stage(gpu_, {}, plainWith(Filter::pcf));
    probe.expectShadow(stage.drawn(kSun), kSun);
    for (const Filter filter : {Filter::evsm, Filter::raymarch}) {
        stage.renderer().setShadows(plainWith(filter));
        probe.expectShadow(stage.drawn(kSun), kSun);
        stage.renderer().setShadows(std::nullopt);
        EXPECT_TRUE(stage.drawn(kSun).values == probe.lit(kSun).values);
    }
}

TEST_F(BlendedReceiver, HasNoShadowWithMasksOfSomeoneElses)
{
    Stage stage(gpu_, {}, plainWith(Filter::pcf));
    ImageF dark(kWidth, kHeight, 1);
    const std::vector<ImageF> masks{dark};
    Probe(gpu_).expectLit(stage.drawn(kSun, kAbove, &masks), kSun);
}

} // namespace
} // namespace gnomon::host::test
