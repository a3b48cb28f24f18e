// SPDX-License-Identifier: Apache-2.0
// Masks in colour: red, green and blue of what panes of glass leave of a light, beside the luminance that grey masks
// are.
#include "host/frame_renderer.h"
#include "host/present.h"
#include "panes_scene.h"
#include "scene/state.h"
#include "small_scene.h"
#include "texels.h"

#include <glm/gtc/type_precision.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace gnomon::host::test {
namespace {

constexpr std::uint32_t kWidth = 64;
constexpr std::uint32_t kHeight = 48;
constexpr float kStep = 1.5F / 255.0F; // of a mask of 8 bits, with what 16 bits of a tint round away
const glm::vec3 kRed{1.0F, 0.1F, 0.0F};
const glm::vec3 kBlue{0.1F, 0.2F, 1.0F};

/// The mask of one light: of a grey one the same number four times.
using Mask = std::vector<glm::u8vec4>;

glm::vec4 at(const Mask& mask, std::uint32_t x)
{
    return glm::vec4(mask[kHeight / 2 * kWidth + x]) / 255.0F;
}
glm::vec4 besidePane(const Mask& mask)
{
    return at(mask, 20);
}
glm::vec4 underPane(const Mask& mask)
{
    return at(mask, 48);
}

/// Copies a frame's masks, light by light.
class CopiedMasks : public Present {
public:
    explicit CopiedMasks(const Gpu& gpu) : copies_(gpu) {}

    void record(VkCommandBuffer commands, const FinishedFrame& frame) override
    {
        lights_ = frame.plan->lights;
        bytes_ = formOf(frame.masks.format).bytes;
        copies_.begin(TexelCopies::bytesOf(frame.masks) * frame.masks.layers);
        layers_.clear();
        for (std::uint32_t layer = 0; layer < frame.masks.layers; ++layer) {
            layers_.push_back(static_cast<const std::uint8_t*>(copies_.add(commands, frame.masks, layer)));
        }
        TexelCopies::end(commands);
    }
    [[nodiscard]] std::vector<Mask> masks() const
    {
        std::vector<Mask> all;
        for (const LightPlan& light : lights_) {
            Mask& mask = all.emplace_back();
            const std::uint8_t* texel = layers_[light.mask_layer];
            for (std::size_t i = 0; i < std::size_t{kWidth} * kHeight; ++i, texel += bytes_) {
                mask.push_back(light.mask_coloured ? glm::u8vec4(texel[0], texel[1], texel[2], texel[3])
                                                   : glm::u8vec4(texel[light.mask_channel]));
            }
        }
        return all;
    }
    [[nodiscard]] const std::vector<LightPlan>& lights() const { return lights_; }

private:
    TexelCopies copies_;
    std::vector<const std::uint8_t*> layers_;
    std::uint32_t bytes_ = 4;
    std::vector<LightPlan> lights_;
};

/// Draws one scene, in colour or grey.
class Watcher {
public:
    Watcher(Gpu& gpu, const scene::Scene& scene, ShadowOptions shadow, Translucent translucent)
        : state_(scene::evaluate(scene, 0.0)), uploaded_(gpu, scene, state_),
          renderer_(uploaded_, optionsOf(shadow, translucent)), copied_(gpu), lights_(lightsOf(scene, state_))
    {
    }
    /// One frame more. The sun is turned by this angle.
    std::vector<Mask> draw(double sun_rad = 0.0)
    {
        lights_[0].caster.direction_ws = {std::sin(sun_rad), -std::cos(sun_rad), 0.0};
        renderer_.submit(state_, panesEye(), lights_, &copied_);
        renderer_.finish();
        return copied_.masks();
    }
    [[nodiscard]] const LightPlan& sun() const { return copied_.lights()[0]; }
    [[nodiscard]] std::vector<ShadedLight>& lights() { return lights_; }

private:
    static RenderOptions optionsOf(ShadowOptions shadow, Translucent translucent)
    {
        RenderOptions options;
        options.width = kWidth;
        options.height = kHeight;
        options.shadow = shadow;
        options.shadow.translucent = translucent;
        return options;
    }

    scene::State state_;
    SceneOnGpu uploaded_;
    FrameRenderer renderer_;
    CopiedMasks copied_;
    std::vector<ShadedLight> lights_;
};

/// With something that blocks all light, too.
scene::Scene panesAndBlocker(const std::vector<Pane>& glass)
{
    scene::Scene scene = panes(glass);
    addLevel(scene, -3.5F, -1.8F, 1.5F, 0);
    finishScene(scene);
    return scene;
}

/// In colour a pixel's luminance is what grey has, to the bit, and its colours have that luminance. `steps`: how many
/// times each was rounded to 8 bits.
void expectColoursOf(const std::vector<Mask>& grey, const std::vector<Mask>& coloured, float steps,
                     const std::string& what)
{
    ASSERT_EQ(grey.size(), coloured.size());
    for (std::size_t light = 0; light < grey.size(); ++light) {
        std::size_t other = 0;
        float worst = 0.0F;
        for (std::size_t i = 0; i < grey[light].size(); ++i) {
            const glm::u8vec4 texel = coloured[light][i];
            other += texel.a != grey[light][i].a ? 1 : 0;
            const glm::vec4 c(texel);
            worst = std::max(worst, std::abs(luminance({c.r, c.g, c.b}) - c.a));
        }
        EXPECT_EQ(other, 0U) << what << ", light " << light;
        EXPECT_LE(worst, 1.01F * steps) << what << ", light " << light;
    }
}

void expectColour(const glm::vec4& texel, const glm::vec3& wanted, const std::string& what, float step = kStep)
{
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(texel[c], wanted[c], step) << what << ", colour " << c;
    }
    EXPECT_NEAR(texel.a, luminance(wanted), step) << what;
}

class ColouredMask : public ::testing::Test {
protected:
    void TearDown() override { EXPECT_EQ(gpu_.messages(), std::vector<std::string>{}); }

    Gpu gpu_{GpuOptions{.gpu = "software", .validate = true}};
};

TEST_F(ColouredMask, HasTheColourOfAPaneWithEveryFilterAndPartition)
{
    const scene::Scene scene = panesAndBlocker({Pane{2.0F, kRed}});
    for (const ShadowOptions& shadow : plainWithAll()) {
        const std::string what(nameOf(shadow.technique.filter));
        const auto coloured = Watcher(gpu_, scene, shadow, Translucent::colour).draw();
        expectColoursOf(Watcher(gpu_, scene, shadow, Translucent::grey).draw(), coloured, 1.0F, what);
        for (const Mask& mask : coloured) {
            expectColour(underPane(mask), through(kRed), what);
            expectColour(besidePane(mask), glm::vec3(1.0F), what);
        }
    }
}

TEST_F(ColouredMask, HasTheProductOfPanes)
{
    const scene::Scene scene = panes({Pane{2.0F, kRed}, Pane{1.0F, kBlue}});
    for (const Mask& mask : Watcher(gpu_, scene, plainWith(Filter::pcf), Translucent::colour).draw()) {
        expectColour(underPane(mask), through(kRed) * through(kBlue), "both");
    }
}

TEST_F(ColouredMask, IsWhiteBeforeAPane)
{
    const scene::Scene scene = panes({Pane{-1.0F, kRed}});
    for (const Mask& mask : Watcher(gpu_, scene, plainWith(Filter::pcf), Translucent::colour).draw()) {
        expectColour(underPane(mask), glm::vec3(1.0F), "before");
    }
}

TEST_F(ColouredMask, OfOneLightAloneHasItsColour)
{
    const scene::Scene scene = panes({Pane{2.0F, kRed}});
    Watcher watcher(gpu_, scene, plainWith(Filter::pcf), Translucent::colour);
    watcher.lights().pop_back();
    const auto masks = watcher.draw();
    ASSERT_EQ(masks.size(), 1U);
    expectColour(underPane(masks[0]), through(kRed), "alone");
    expectColour(besidePane(masks[0]), glm::vec3(1.0F), "alone");
}

/// How many texels are neither free, nor under the pane, nor dark.
std::size_t redEdge(const Mask& mask)
{
    return static_cast<std::size_t>(std::ranges::count_if(mask, [](const glm::u8vec4& texel) {
        const float green = static_cast<float>(texel.g) / 255.0F;
        return texel.r > 250 && green > through(kRed).g + 0.1F && green < 0.9F;
    }));
}

TEST_F(ColouredMask, ConvergesInEveryColour)
{
    const scene::Scene scene = panesAndBlocker({Pane{2.0F, kRed}});
    ShadowOptions shadow = plainWith(Filter::hard);
    shadow.technique.soften = Soften::converge;
    Watcher grey(gpu_, scene, shadow, Translucent::grey);
    Watcher coloured(gpu_, scene, shadow, Translucent::colour);
    std::size_t edge_at_first = 0;
    for (Watcher* one : {&grey, &coloured}) {
        one->lights()[0].caster.angular_diameter_rad = 0.3;
        one->lights()[1].caster.radius_m = 0.5;
    }
    for (int frame = 0; frame < 12; ++frame) {
        const auto masks = coloured.draw();
        expectColoursOf(grey.draw(), masks, 2.0F, "frame " + std::to_string(frame));
        for (const Mask& mask : masks) { // what packSeen() makes of a half float rounds by up to 1/256
            expectColour(underPane(mask), through(kRed), "frame " + std::to_string(frame), kStep + 1.0F / 256.0F);
        }
        edge_at_first = frame == 0 ? redEdge(masks[0]) : edge_at_first;
        if (frame == 11) {
            EXPECT_GT(redEdge(masks[0]), 2 * edge_at_first + kHeight) << "the pane's edge is soft";
        }
    }
}

TEST_F(ColouredMask, JoinsTheTurnsOfASteppingSunInEveryColour)
{
    const scene::Scene scene = panesAndBlocker({Pane{2.0F, kRed}});
    ShadowOptions shadow = plainWith(Filter::pcf);
    shadow.technique.motion = Motion::step_alternate;
    Watcher grey(gpu_, scene, shadow, Translucent::grey);
    Watcher coloured(gpu_, scene, shadow, Translucent::colour);
    int turns = 0;
    for (int frame = 0; frame < 12; ++frame) {
        const double sun_rad = 0.002 * frame;
        const auto masks = coloured.draw(sun_rad);
        expectColoursOf(grey.draw(sun_rad), masks, 2.0F, "frame " + std::to_string(frame));
        expectColour(underPane(masks[0]), through(kRed), "frame " + std::to_string(frame));
        turns += coloured.sun().steps.paired && coloured.sun().steps.alternate ? 1 : 0;
    }
    EXPECT_GT(turns, 6) << "else this is about nothing";
}

/// The picture's light in its middle, which is under the pane, seen from beneath it.
glm::vec3 shadedUnderPane(FrameRenderer& renderer, const scene::Scene& scene, const std::vector<ImageF>* masks_instead)
{
    const scene::State state = scene::evaluate(scene, 0.0);
    const Eye eye{.position_ws = {-2.0, 1.0, 0.01}, .target_ws = {2.0, 0.0, 0.0}};
    renderer.draw(state, eye, {lightsOf(scene, state).front()}, masks_instead);
    const Picture picture = renderer.read({.colour = false, .linear = true});
    const float* const light = picture.linear.pixel(kWidth / 2, kHeight / 2);
    return {light[0], light[1], light[2]};
}

TEST_F(ColouredMask, ColoursWhatTheHostShades)
{
    const scene::Scene scene = panes({Pane{2.0F, kRed}});
    RenderOptions options;
    options.width = kWidth;
    options.height = kHeight;
    options.shadow = plainWith(Filter::pcf);
    options.shadow.translucent = Translucent::colour;
    const SceneOnGpu uploaded(gpu_, scene, scene::evaluate(scene, 0.0));
    FrameRenderer renderer(uploaded, options);
    const std::vector<ImageF> dark(1, ImageF(kWidth, kHeight, 1, 0.0F));
    const std::vector<ImageF> lit(1, ImageF(kWidth, kHeight, 1, 1.0F));
    const glm::vec3 ambient = shadedUnderPane(renderer, scene, &dark);
    const glm::vec3 all = shadedUnderPane(renderer, scene, &lit) - ambient;
    const glm::vec3 arrived = (shadedUnderPane(renderer, scene, nullptr) - ambient) / all;
    for (int c = 0; c < 3; ++c) {
        EXPECT_GT(all[c], 0.1F) << "else this says nothing";
        EXPECT_NEAR(arrived[c], through(kRed)[c], 2.0F * kStep) << "colour " << c;
    }
}

} // namespace
} // namespace gnomon::host::test
