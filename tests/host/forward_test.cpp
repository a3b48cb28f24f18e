// SPDX-License-Identifier: Apache-2.0
// Surfaces that are shaded as they are drawn, by the maps alone, against the same picture shaded from a G-buffer and a
// mask.
#include "host/frame_renderer.h"
#include "scene/state.h"
#include "small_scene.h"
#include "worlds/worlds.h"

#include <gnomon/error.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::host::test {
namespace {

struct Case {
    const char* name;
    Filter filter = Filter::pcf;
    Partition partition = Partition::single;
    Fit fit = Fit::uniform;
    Translucent translucent = Translucent::grey;
    Soften soften = Soften::none;
    bool sun_alone = false; // few views, which shaders look for otherwise
};

Case ofSun(const char* name, Filter filter, Partition partition = Partition::single, Fit fit = Fit::uniform)
{
    return {name, filter, partition, fit, Translucent::grey, Soften::none, true};
}

void PrintTo(const Case& one, std::ostream* out)
{
    *out << one.name;
}

/// A scene whose glowing material has an emissive texture and no other.
scene::Scene sceneWithAGlowingTexture()
{
    scene::Scene scene = smallScene();
    std::uint32_t texture = scene::kNone;
    for (const scene::Material& material : scene.materials) {
        texture = material.base_colour_texture.texture != scene::kNone ? material.base_colour_texture.texture : texture;
    }
    for (scene::Material& material : scene.materials) {
        if (material.emissive != glm::vec3(0.0F)) {
            material.emissive_texture.texture = texture;
        }
    }
    return scene;
}

class Forward : public testing::Test {
protected:
    Forward()
    {
        options_.width = 256;
        options_.height = 144;
        options_.shadow.map_size = 512;
        options_.shadow.technique = {.partition = Partition::single, .fit = Fit::uniform, .filter = Filter::pcf};
    }
    void TearDown() override { EXPECT_EQ(gpu_.messages(), std::vector<std::string>{}); }

    Picture pictureOf(Shading shading, const std::vector<ImageF>* masks_instead = nullptr)
    {
        RenderOptions options = options_;
        options.shading = shading;
        FrameRenderer renderer(on_gpu_, options);
        renderer.draw(state_, smallEye(), lights_, masks_instead);
        return renderer.read({.colour = true, .linear = options.keeps_light});
    }

    scene::Scene scene_ = sceneWithAGlowingTexture();
    scene::State state_ = scene::evaluate(scene_, 0.0);
    std::vector<ShadedLight> lights_ = lightsOf(scene_, state_);
    Gpu gpu_{{.gpu = "software", .validate = true}};
    SceneOnGpu on_gpu_{gpu_, scene_, state_};
    RenderOptions options_;
};

class ForwardOf : public Forward, public testing::WithParamInterface<Case> {};

TEST_P(ForwardOf, IsAsShadedFromAGBuffer)
{
    options_.shadow.technique.filter = GetParam().filter;
    options_.shadow.technique.partition = GetParam().partition;
    options_.shadow.technique.fit = GetParam().fit;
    options_.shadow.technique.soften = GetParam().soften;
    options_.shadow.translucent = GetParam().translucent;
    if (GetParam().sun_alone) {
        lights_.resize(1);
        ASSERT_EQ(lights_[0].caster.type, LightType::directional);
    }
    const Picture deferred = pictureOf(Shading::deferred);
    const Picture forward = pictureOf(Shading::forward);
    options_.shadows = false;
    const Picture lit = pictureOf(Shading::forward);
    // The G-buffer rounds colours, normals and the mask; edges of shadows may fall to the other side of a pixel.
    EXPECT_LT(differing(forward.linear, deferred.linear, 0.03F), deferred.linear.values.size() / 300);
    EXPECT_GT(differing(forward.linear, lit.linear, 0.03F), deferred.linear.values.size() / 100)
        << "no shadow to be seen";
}

INSTANTIATE_TEST_SUITE_P(
    Techniques, ForwardOf,
    testing::Values(
        Case{"hard", Filter::hard}, Case{"pcf"}, Case{"pcf_lispsm", Filter::pcf, Partition::single, Fit::lispsm},
        Case{"pcf_cascades", Filter::pcf, Partition::cascades}, Case{"pcf_sdsm", Filter::pcf, Partition::sdsm},
        Case{"vsm", Filter::vsm}, Case{"id", Filter::id}, Case{"raymarch", Filter::raymarch},
        Case{"colour", Filter::pcf, Partition::single, Fit::uniform, Translucent::colour},
        Case{"smoothies", Filter::pcf, Partition::single, Fit::uniform, Translucent::grey, Soften::smoothies},
        ofSun("sun_hard", Filter::hard), ofSun("sun_pcf", Filter::pcf),
        ofSun("sun_pcf_lispsm", Filter::pcf, Partition::single, Fit::lispsm),
        ofSun("sun_pcf_cascades", Filter::pcf, Partition::cascades), ofSun("sun_pcss", Filter::pcss),
        ofSun("sun_raymarch", Filter::raymarch),
        ofSun("sun_raymarch_lispsm", Filter::raymarch, Partition::single, Fit::lispsm), ofSun("sun_vsm", Filter::vsm),
        ofSun("sun_lvsm", Filter::lvsm), ofSun("sun_esm", Filter::esm), ofSun("sun_evsm", Filter::evsm),
        ofSun("sun_msm", Filter::msm), ofSun("sun_id", Filter::id), ofSun("sun_depth_id", Filter::depth_id)),
    [](const auto& one) { return std::string(one.param.name); });

// A slice in which nothing casts has no map, so what lies in it has no view. It was taken for dark where a caster
// covers the first texel of the maps.
TEST(ForwardOfRing, IsAsDeferredWhereACascadeHasNoMap)
{
    const scene::Scene ring = worlds::load("ring", 1);
    const scene::State state = scene::evaluate(ring, 0.0);
    Gpu gpu({.gpu = "software", .validate = true});
    const SceneOnGpu on_gpu(gpu, ring, state);
    RenderOptions options;
    options.width = 160;
    options.height = 90;
    options.shadow.map_size = 64;
    options.shadow.technique = {
        .partition = Partition::cascades, .fit = Fit::uniform, .filter = Filter::hard, .motion = Motion::free};
    options.shadow.cascades = {.count = 6, .lambda = 0.1, .blend = 0.0};
    Eye eye;
    eye.position_ws = {0.04, 55.64, 3.14};
    eye.target_ws = {0.09, 59.99, 1.16};
    eye.up_ws = {0.005, -1.0, 0.0};
    eye.fov_y_rad = glm::radians(14.0);
    ShadedLight sun;
    sun.caster.direction_ws = glm::normalize(glm::dvec3(-0.007, 1.5, -0.5));
    setBrightness(sun);
    std::array<Picture, 2> pictures;
    for (const Shading shading : {Shading::deferred, Shading::forward}) {
        options.shading = shading;
        FrameRenderer renderer(on_gpu, options);
        renderer.draw(state, eye, {sun});
        EXPECT_LT(renderer.plan().views.size(), 6U) << "else the test is about nothing";
        pictures[shading == Shading::forward ? 1 : 0] = renderer.read({.colour = true, .linear = false});
    }
    const auto& deferred = pictures[0].colour.values;
    std::size_t far = 0;
    for (std::size_t i = 0; i < deferred.size(); ++i) {
        far += std::abs(int{deferred[i]} - int{pictures[1].colour.values[i]}) > 24 ? 1 : 0;
    }
    EXPECT_LT(far, deferred.size() / 100);
    EXPECT_EQ(gpu.messages(), std::vector<std::string>{});
}

TEST_F(Forward, HasNoMasksAndNoGeometry)
{
    options_.shading = Shading::forward;
    FrameRenderer renderer(on_gpu_, options_);
    renderer.draw(state_, smallEye(), lights_);
    EXPECT_THROW((void)renderer.read({.masks = true}), Error);
    EXPECT_THROW((void)renderer.read({.geometry = true}), Error);
    EXPECT_NO_THROW((void)renderer.read({.linear = true}));
}

TEST_F(Forward, TakesNoMemoryForAGBuffer)
{
    const auto bytes = [&](const SceneOnGpu& on_gpu, Shading shading, bool shadows) {
        RenderOptions options = options_;
        options.shading = shading;
        options.shadows = shadows;
        FrameRenderer renderer(on_gpu, options);
        renderer.draw(state_, smallEye(), lights_);
        std::uint64_t sum = 0;
        for (const vulkan::MemoryUse& use : renderer.memory()) {
            sum += std::string_view(use.purpose) == "host pictures" ? use.bytes : 0;
        }
        return sum;
    };
    const std::uint64_t pixels = std::uint64_t{options_.width} * options_.height;
    const std::uint64_t forward = bytes(on_gpu_, Shading::forward, true);
    EXPECT_GE(forward, pixels * (4 + 8 + 4)); // depth, light, picture
    EXPECT_LT(forward, pixels * (4 + 8 + 4 + 4));
    const std::uint64_t lit = bytes(on_gpu_, Shading::deferred, false);
    EXPECT_GE(lit, forward + pixels * (16 + 4)); // surfaces, normals
    // Smooth surfaces, and which objects receive: one does not.
    EXPECT_GE(bytes(on_gpu_, Shading::deferred, true), lit + pixels * (8 + 4));
    for (scene::Node& node : scene_.nodes) {
        node.receives = true;
    }
    state_ = scene::evaluate(scene_, 0.0);
    const SceneOnGpu all_receive(gpu_, scene_, state_);
    EXPECT_LT(bytes(all_receive, Shading::deferred, true), lit + pixels * (8 + 4));
}

TEST_F(Forward, ShadesMasksOfSomeoneElseAllTheSame)
{
    const std::vector<ImageF> dark(lights_.size(), ImageF(options_.width, options_.height, 1, 0.0F));
    const Picture forward = pictureOf(Shading::forward, &dark);
    EXPECT_EQ(forward.linear.values, pictureOf(Shading::deferred, &dark).linear.values);
    EXPECT_NE(forward.linear.values, pictureOf(Shading::forward).linear.values);
}

TEST_F(Forward, IsRefusedToWhatWorksOnTheMask)
{
    options_.shading = Shading::forward;
    const auto refused = [&](auto&& change) {
        RenderOptions options = options_;
        change(options);
        EXPECT_FALSE(refusalOfForward(options).empty());
        EXPECT_THROW(FrameRenderer(on_gpu_, options), Error);
        options.shading = Shading::deferred;
        EXPECT_NO_THROW(FrameRenderer(on_gpu_, options));
    };
    refused([](RenderOptions& o) { o.shadow.technique.soften = Soften::blur; });
    refused([](RenderOptions& o) { o.shadow.technique.soften = Soften::converge; });
    refused([](RenderOptions& o) { o.shadow.technique.motion = Motion::step_alternate; });
    refused([](RenderOptions& o) { o.shadow.mask_size = MaskSize::half; });
    refused([](RenderOptions& o) { o.compact_mask.channels = 4; });
    refused([](RenderOptions& o) { o.shadow.technique.filter = Filter::volumes; });
    FrameRenderer renderer(on_gpu_, options_);
    ShadowOptions blurred = options_.shadow;
    blurred.technique.soften = Soften::blur;
    EXPECT_THROW(renderer.setShadows(blurred), Error);
    renderer.draw(state_, smallEye(), lights_); // as before
}

// Where nothing blends and nothing emits, what shades may write the finished picture.
TEST(TonedAtOnce, IsThePictureThatThePassWouldMake)
{
    Gpu gpu({.gpu = "software", .validate = true});
    const scene::Scene scene = worlds::load("planes", 1);
    const scene::State state = scene::evaluate(scene, 0.0);
    const SceneOnGpu on_gpu(gpu, scene, state);
    for (const Shading shading : {Shading::deferred, Shading::forward}) {
        for (const AntiAliasing smooth : {AntiAliasing::none, AntiAliasing::fxaa}) {
            RenderOptions options;
            options.width = 160;
            options.height = 90;
            options.shading = shading;
            options.anti_aliasing = smooth;
            options.shadow.map_size = 256;
            std::array<Picture, 2> pictures;
            for (const bool at_once : {false, true}) {
                options.keeps_light = !at_once;
                FrameRenderer renderer(on_gpu, options);
                renderer.draw(state, {.position_ws = {3.0, 8.0, 9.0}, .target_ws = {0, 0, 0}}, lightsOf(scene, state));
                pictures[at_once ? 1 : 0] = renderer.read({.colour = true});
                EXPECT_EQ(at_once, !std::ranges::any_of(renderer.finish().passes, [](const vulkan::PassRecord& pass) {
                              return std::string_view(pass.name) == "tone";
                          }));
                if (at_once) {
                    EXPECT_THROW((void)renderer.read({.linear = true}), Error);
                }
            }
            std::size_t beyond = 0;
            for (std::size_t i = 0; i < pictures[0].colour.values.size(); ++i) {
                beyond += std::abs(int{pictures[0].colour.values[i]} - int{pictures[1].colour.values[i]}) > 1 ? 1 : 0;
            }
            // Half floats round the light; what smooths edges may then find another one.
            EXPECT_LE(beyond, smooth == AntiAliasing::none ? 0 : pictures[0].colour.values.size() / 500);
            EXPECT_GT(*std::ranges::max_element(pictures[1].colour.values), 100);
        }
    }
    EXPECT_EQ(gpu.messages(), std::vector<std::string>{});
}

} // namespace
} // namespace gnomon::host::test
