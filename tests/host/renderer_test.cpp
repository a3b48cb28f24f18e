// SPDX-License-Identifier: Apache-2.0
// The renderer on a real device (the software one), with validation listening.
#include "allocation_count.h"
#include "small_scene.h"

#include "scene/state.h"
#include "worlds/worlds.h"

#include <gnomon/error.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <numeric>
#include <set>
#include <string>

namespace gnomon::host::test {
namespace {

constexpr std::uint32_t kWidth = 160;
constexpr std::uint32_t kHeight = 90;

RenderOptions smallOptions()
{
    RenderOptions options;
    options.width = kWidth;
    options.height = kHeight;
    options.shadow.map_size = 256;
    return options;
}

// A scene, its device with validation, and a renderer; the messages must be none at the end.
struct Stage {
    explicit Stage(scene::Scene the_scene, const RenderOptions& options = smallOptions(), bool validate = true)
        : scene(std::move(the_scene)), state(scene::evaluate(scene, 0.0)),
          gpu({.gpu = "software", .validate = validate}), uploaded(std::in_place, gpu, scene, state),
          renderer(std::in_place, *uploaded, options), lights(lightsOf(scene, state))
    {
    }
    ~Stage()
    {
        renderer.reset();
        uploaded.reset();
        for (const std::string& message : gpu.messages()) {
            ADD_FAILURE() << message;
        }
    }
    Picture drawAndRead(const std::vector<ImageF>* instead = nullptr)
    {
        renderer->draw(state, eye, lights, instead);
        return renderer->read({.colour = true, .linear = true, .masks = true, .geometry = true});
    }

    scene::Scene scene;
    scene::State state;
    Gpu gpu;
    std::optional<SceneOnGpu> uploaded;
    std::optional<FrameRenderer> renderer;
    std::vector<ShadedLight> lights;
    Eye eye = smallEye();
};

std::uint32_t idOf(const scene::State& state, std::uint32_t node)
{
    for (std::uint32_t i = 0; i < state.objects.size(); ++i) {
        if (state.objects[i].node == node) {
            return i + 1;
        }
    }
    return 0;
}

std::size_t countOf(const Picture& picture, std::uint32_t id)
{
    return static_cast<std::size_t>(std::count(picture.object_ids.values.begin(), picture.object_ids.values.end(), id));
}

double meanOf(const Image8& image)
{
    return std::accumulate(image.values.begin(), image.values.end(), 0.0) / static_cast<double>(image.values.size());
}

TEST(Renderer, DrawsEverythingWithoutNaNAndReadsMasksBack)
{
    Stage stage(smallScene());
    const Picture picture = stage.drawAndRead();
    EXPECT_TRUE(std::all_of(picture.linear.values.begin(), picture.linear.values.end(),
                            [](float v) { return std::isfinite(v) && v >= 0.0F; }));
    const auto [low, high] = std::minmax_element(picture.colour.values.begin(), picture.colour.values.end());
    EXPECT_GT(*high, *low + 60);
    ASSERT_EQ(picture.masks.size(), 2U);
    for (const ImageF& mask : picture.masks) {
        EXPECT_TRUE(
            std::all_of(mask.values.begin(), mask.values.end(), [](float v) { return v >= 0.0F && v <= 1.0F; }));
    }
    EXPECT_GT(std::count(picture.masks[0].values.begin(), picture.masks[0].values.end(), 0.0F), 50);
    EXPECT_GT(std::count(picture.masks[0].values.begin(), picture.masks[0].values.end(), 1.0F), 500);
    for (const std::uint32_t node : {kGroundNode, kMoverNode, kMaskedNode, kGlowNode, kFlagNode, kShyNode}) {
        EXPECT_GT(countOf(picture, idOf(stage.state, node)), 10U) << "node " << node;
    }
    EXPECT_EQ(countOf(picture, idOf(stage.state, kGlassNode)), 0U) << "blended surfaces are not in the G-buffer";
}

TEST(Renderer, GivesDepthAndNormalsOfTheGround)
{
    Stage stage(smallScene());
    const Picture picture = stage.drawAndRead();
    const std::uint32_t ground = idOf(stage.state, kGroundNode);
    const glm::dmat4 world_from_clip =
        glm::inverse(cameraOf(stage.eye, kWidth, kHeight, stage.state.bounds_ws).clip_from_world);
    for (std::uint32_t y = 0; y < kHeight; ++y) {
        for (std::uint32_t x = 0; x < kWidth; ++x) {
            if (*picture.object_ids.pixel(x, y) == ground) {
                EXPECT_NEAR(picture.normals.pixel(x, y)[1], 1.0F, 2e-3F) << x << ',' << y;
                const glm::dvec4 p =
                    world_from_clip * glm::dvec4((x + 0.5) * 2.0 / kWidth - 1.0, (y + 0.5) * 2.0 / kHeight - 1.0,
                                                 *picture.depth.pixel(x, y), 1.0);
                EXPECT_NEAR(p.y / p.w, 0.0, 2e-3) << x << ',' << y;
            } else if (*picture.object_ids.pixel(x, y) == 0) {
                EXPECT_EQ(*picture.depth.pixel(x, y), 0.0F);
            }
        }
    }
}

TEST(Renderer, KeepsShadowOffWhatDoesNotReceive)
{
    Stage stage(smallScene());
    const Picture picture = stage.drawAndRead();
    const std::uint32_t shy = idOf(stage.state, kShyNode);
    std::size_t seen = 0;
    for (std::size_t i = 0; i < picture.object_ids.values.size(); ++i) {
        if (picture.object_ids.values[i] == shy) {
            ++seen;
            EXPECT_EQ(picture.masks[0].values[i], 1.0F);
        }
    }
    EXPECT_GT(seen, 10U);
}

TEST(Renderer, FollowsWhatMovesAndDeforms)
{
    RenderOptions options = smallOptions();
    options.shadow.map_size = 512; // and one plain map, for auto remembers
    options.shadow.technique.partition = Partition::single;
    options.shadow.technique.fit = Fit::uniform;
    Stage stage(smallScene(), options);
    const Picture before = stage.drawAndRead();
    scene::advance(stage.scene, 1.5, stage.state);
    const Picture after = stage.drawAndRead();
    for (const std::uint32_t node : {kMoverNode, kFlagNode}) {
        const std::uint32_t id = idOf(stage.state, node);
        std::size_t changed = 0;
        for (std::size_t i = 0; i < before.object_ids.values.size(); ++i) {
            changed += (before.object_ids.values[i] == id) != (after.object_ids.values[i] == id) ? 1 : 0;
        }
        EXPECT_GT(changed, 20U) << "node " << node;
    }
    EXPECT_NE(before.masks[0].values, after.masks[0].values);
    // And back: with nothing to choose a frame depends on the state alone.
    scene::advance(stage.scene, 0.0, stage.state);
    EXPECT_EQ(stage.drawAndRead().colour.values, before.colour.values);
}

TEST(Renderer, RedrawsNoMapWhenNothingMoved)
{
    Stage stage(smallScene());
    const Picture first = stage.drawAndRead();
    ASSERT_FALSE(stage.renderer->plan().views.empty());
    EXPECT_TRUE(stage.renderer->plan().views.front().contents.redraw);
    const Picture second = stage.drawAndRead();
    for (const View& view : stage.renderer->plan().views) {
        EXPECT_FALSE(view.contents.redraw);
    }
    EXPECT_EQ(first.colour.values, second.colour.values);
}

TEST(Renderer, RedrawsEveryMapWhenAskedTo)
{
    RenderOptions options = smallOptions();
    options.reuse_maps = false;
    Stage stage(smallScene(), options);
    for (int i = 0; i < 2; ++i) {
        stage.renderer->draw(stage.state, stage.eye, stage.lights);
        for (const View& view : stage.renderer->plan().views) {
            EXPECT_TRUE(view.contents.redraw);
        }
    }
}

TEST(Renderer, AllocatesNothingInASteadyFrame)
{
    const std::uint64_t none = gnomon::test::heapAllocations();
    ::operator delete(::operator new(64)); // called by name, it cannot be optimised away
    ASSERT_EQ(gnomon::test::heapAllocations(), none + 1) << "the counter does not count";
    using enum Filter;
    for (const auto& [filter, soften] :
         {std::pair{pcf, Soften::none}, std::pair{pcf, Soften::blur}, std::pair{pcf, Soften::smoothies},
          std::pair{smoothies, Soften::none}, std::pair{id, Soften::none}, std::pair{depth_id, Soften::none},
          std::pair{volumes, Soften::blur}}) {
        RenderOptions options = smallOptions();
        options.shadow.technique.filter = filter;
        options.shadow.technique.soften = soften;
        options.shadow.volumes.open = OpenCasters::skip;
        Stage stage(smallScene(), options, false);
        for (int i = 0; i < 4; ++i) {
            scene::advance(stage.scene, 0.1 * i, stage.state);
            stage.renderer->draw(stage.state, stage.eye, stage.lights);
        }
        for (int i = 0; i < 3; ++i) {
            scene::advance(stage.scene, 0.05 + 0.1 * i, stage.state);
            const std::uint64_t before = gnomon::test::heapAllocations();
            stage.renderer->draw(stage.state, stage.eye, stage.lights);
            EXPECT_EQ(gnomon::test::heapAllocations(), before) << nameOf(filter) << "+" << nameOf(soften);
        }
        EXPECT_GT(stage.renderer->plan().casters.size(), 0U) << nameOf(filter);
    }
}

TEST(Renderer, UsesOtherMasksWhenGiven)
{
    Stage stage(smallScene());
    const Picture own = stage.drawAndRead();
    std::vector<ImageF> dark(2, ImageF(kWidth, kHeight, 1, 0.0F));
    *dark[1].pixel(5, 7) = 0.6F;
    const Picture other = stage.drawAndRead(&dark);
    EXPECT_LT(meanOf(other.colour), meanOf(own.colour) - 5.0);
    ASSERT_EQ(other.masks.size(), 2U);
    EXPECT_NEAR(*other.masks[1].pixel(5, 7), 0.6F, 0.5F / 255.0F);
    EXPECT_EQ(*other.masks[0].pixel(5, 7), 0.0F);
    // The masks that the library made give the same picture again, to the last bit of 8.
    EXPECT_EQ(stage.drawAndRead(&own.masks).colour.values, own.colour.values);
    dark.pop_back();
    EXPECT_THROW(stage.renderer->draw(stage.state, stage.eye, stage.lights, &dark), Error);
}

TEST(Renderer, DrawsTheBaselineWithoutShadows)
{
    RenderOptions options = smallOptions();
    options.shadows = false;
    Stage stage(smallScene(), options);
    const Picture picture = stage.drawAndRead();
    EXPECT_TRUE(stage.renderer->plan().views.empty());
    for (const ImageF& mask : picture.masks) {
        EXPECT_TRUE(std::all_of(mask.values.begin(), mask.values.end(), [](float v) { return v == 1.0F; }));
    }
    Stage shadowed(smallScene());
    EXPECT_LT(meanOf(shadowed.drawAndRead().colour), meanOf(picture.colour));
}

TEST(Renderer, SmoothsEdgesWithoutChangingThePicture)
{
    RenderOptions options = smallOptions();
    Stage plain(smallScene(), options);
    const Picture rough = plain.drawAndRead();
    for (const AntiAliasing smooth : {AntiAliasing::fxaa, AntiAliasing::ssaa4}) {
        options.anti_aliasing = smooth;
        Stage stage(smallScene(), options);
        const Picture picture = stage.drawAndRead();
        ASSERT_EQ(picture.colour.values.size(), rough.colour.values.size());
        EXPECT_NE(picture.colour.values, rough.colour.values);
        EXPECT_NEAR(meanOf(picture.colour), meanOf(rough.colour), 2.0);
        EXPECT_EQ(picture.masks.front().values.size(), rough.masks.front().values.size());
    }
}

TEST(Renderer, DrawsWithoutLightsAndWithLightsThatHaveNoMap)
{
    Stage stage(smallScene());
    const std::vector<ShadedLight> lights = stage.lights;
    const double lit = meanOf(stage.drawAndRead().colour);
    stage.lights.clear();
    const Picture dark = stage.drawAndRead();
    EXPECT_TRUE(dark.masks.empty());
    EXPECT_LT(meanOf(dark.colour), lit);
    // Six lights need two layers of masks; a point light and one that casts nothing have no map.
    for (std::uint32_t i = 0; i < 6; ++i) {
        stage.lights.push_back(lights[i % 2]);
        stage.lights.back().caster.key = i;
    }
    stage.lights[4].caster.type = LightType::point;
    stage.lights[5].caster.casts_shadow = false;
    const Picture many = stage.drawAndRead();
    ASSERT_EQ(many.masks.size(), 6U);
    EXPECT_EQ(many.masks[0].values, many.masks[2].values);
    EXPECT_TRUE(
        std::all_of(many.masks[5].values.begin(), many.masks[5].values.end(), [](float v) { return v == 1.0F; }));
    stage.lights = lights;
    stage.lights.resize(kMaxLights + 1, lights[0]);
    EXPECT_THROW(stage.renderer->draw(stage.state, stage.eye, stage.lights), Error);
}

TEST(Renderer, AccountsForItsMemory)
{
    Stage stage(smallScene());
    stage.drawAndRead();
    std::set<std::string> purposes;
    VkDeviceSize pictures = 0;
    VkDeviceSize sum = 0;
    for (const vulkan::MemoryUse& use : stage.renderer->memory()) {
        EXPECT_GT(use.bytes, 0U) << use.purpose;
        purposes.insert(use.purpose);
        sum += use.bytes;
        pictures += std::string(use.purpose) == "host pictures" ? use.bytes : 0;
    }
    // Depth, the G-buffer's 24 bytes, light and picture.
    EXPECT_GE(pictures, VkDeviceSize{kWidth} * kHeight * (4 + 24 + 8 + 4));
    EXPECT_LE(pictures, VkDeviceSize{kWidth} * kHeight * (4 + 24 + 8 + 4) * 2);
    EXPECT_GE(sum, pictures + VkDeviceSize{256} * 256 * 4 * 2);
    EXPECT_TRUE(purposes.contains("scene positions"));
    EXPECT_FALSE(purposes.contains("staging")) << "the staging buffer is given back after the upload";
}

TEST(Renderer, DrawsAViewThatSeesNothing)
{
    for (const bool shadows : {true, false}) {
        RenderOptions options = smallOptions();
        options.shadows = shadows;
        Stage stage(smallScene(), options);
        stage.eye = {.position_ws = {0.0, 50.0, 0.0}, .target_ws = {100.0, 90.0, 0.0}};
        const Picture picture = stage.drawAndRead();
        EXPECT_EQ(*std::max_element(picture.object_ids.values.begin(), picture.object_ids.values.end()), 0U);
        for (const ImageF& mask : picture.masks) {
            EXPECT_EQ(*std::min_element(mask.values.begin(), mask.values.end()), 1.0F);
        }
    }
}

TEST(Renderer, RefusesSizesThatNoDeviceHas)
{
    const scene::Scene scene = smallScene();
    const scene::State state = scene::evaluate(scene, 0.0);
    Gpu gpu({.gpu = "software"});
    const SceneOnGpu uploaded(gpu, scene, state);
    RenderOptions options = smallOptions();
    options.width = 0;
    EXPECT_THROW(FrameRenderer(uploaded, options), Error);
    options.width = 1U << 20;
    EXPECT_THROW(FrameRenderer(uploaded, options), Error);
}

TEST(Renderer, DrawsABoxAndItsShadowOnPlanes)
{
    scene::Scene scene = worlds::load("planes", 1);
    const scene::NamedView view = scene.views.front();
    Stage stage(std::move(scene));
    stage.eye.position_ws = view.eye;
    stage.eye.target_ws = view.target;
    stage.eye.fov_y_rad = view.fov_y_rad;
    const Picture picture = stage.drawAndRead();
    for (const ImageF& mask : picture.masks) {
        const auto dark = std::count_if(mask.values.begin(), mask.values.end(), [](float v) { return v < 0.5F; });
        EXPECT_GT(dark, kWidth * kHeight / 200);
        EXPECT_LT(dark, kWidth * kHeight / 2);
    }
}

} // namespace
} // namespace gnomon::host::test
