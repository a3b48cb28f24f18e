// SPDX-License-Identifier: Apache-2.0
// Bloom moves light and neither makes nor loses any: by its weights, and by what a device draws.
#include "small_scene.h"

#include "scene/state.h"

#define GNOMON_REAL double
#include "host/shaders/bloom_weights.h"

#include <gnomon/error.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

namespace gnomon::host::test {
namespace {

using namespace gnomon::shared::of_double;

TEST(BloomWeights, CutAtTheThresholdWithASmoothKnee)
{
    EXPECT_EQ(bloomExcess(0.4, 1.0, 0.5), 0.0);
    EXPECT_EQ(bloomExcess(0.5, 1.0, 0.5), 0.0);
    EXPECT_NEAR(bloomExcess(1.0, 1.0, 0.5), 0.125, 1e-12); // h / 4
    EXPECT_NEAR(bloomExcess(1.5, 1.0, 0.5), 0.5, 1e-12);
    EXPECT_NEAR(bloomExcess(9.0, 1.0, 0.5), 8.0, 1e-12);
    EXPECT_NEAR(bloomExcess(1.001, 1.0, 0.0), 0.001, 1e-5) << "a knee of 0 is a hard threshold";
    constexpr double kStep = 1e-4;
    double slope = 0.0;
    for (double b = 0.0; b < 3.0; b += kStep) {
        const double next = (bloomExcess(b + kStep, 1.0, 0.5) - bloomExcess(b, 1.0, 0.5)) / kStep;
        EXPECT_GE(next, slope - 1e-9) << b;
        EXPECT_LE(next, slope + 2.0 * kStep) << "no corner at " << b;
        slope = next;
    }
    const glm::dvec3 light = bloomLight({4.0, 2.0, 0.0}, 1.0, 0.0);
    EXPECT_NEAR(light.x, 3.0, 1e-9);
    EXPECT_NEAR(light.y, 1.5, 1e-9) << "the hue stays";
    EXPECT_EQ(bloomLight({0.9, 0.9, 0.9}, 1.0, 0.0), glm::dvec3(0.0));
    constexpr double kMuch = std::numeric_limits<double>::infinity();
    EXPECT_TRUE(std::isfinite(bloomLight({kMuch, 0.0, 1.0}, 1.0, 0.5).x));
}

TEST(BloomWeights, OfAHalvingGiveEveryTexelAQuarter)
{
    // Weights of single texels: each tap is the mean of the four that meet there.
    std::array<std::array<double, 6>, 6> weights{};
    double sum = 0.0;
    for (int y = -2; y <= 2; ++y) {
        for (int x = -2; x <= 2; ++x) {
            if (((x ^ y) & 1) != 0) {
                continue;
            }
            sum += bloomTap(x, y);
            for (int i = 0; i < 4; ++i) {
                weights.at(static_cast<std::size_t>(y + 2 + i / 2)).at(static_cast<std::size_t>(x + 2 + i % 2)) +=
                    bloomTap(x, y) / 4.0;
            }
        }
    }
    EXPECT_NEAR(sum, 1.0, 1e-12);
    EXPECT_NEAR(kBloomCentre + 4.0 * kBloomCorner, 1.0, 1e-12);
    for (std::size_t phase = 0; phase < 4; ++phase) {
        double share = 0.0;
        for (std::size_t y = phase / 2; y < 6; y += 2) {
            for (std::size_t x = phase % 2; x < 6; x += 2) {
                share += weights.at(y).at(x);
            }
        }
        EXPECT_NEAR(share, 0.25, 1e-12) << phase;
    }
}

TEST(BloomWeights, OfATentGiveEveryTexelFour)
{
    double sum = 0.0;
    for (int i = 0; i < 9; ++i) {
        sum += bloomTent(i % 3 - 1, i / 3 - 1);
    }
    EXPECT_NEAR(sum, 1.0, 1e-12);
    // Along one axis: the taps of all finer texels' middles, read bilinearly, on the texel at 0.
    for (const double radius : {0.5, 1.0, 1.7, 3.0}) {
        double share = 0.0;
        for (int fine = -20; fine < 20; ++fine) {
            for (int tap = -1; tap <= 1; ++tap) {
                const double along = bloomTent(tap, 0) * 2.0; // 1/4, 1/2, 1/4
                const double at = (fine + 0.5) * 0.5 - 0.5 + tap * radius;
                share += along * std::max(1.0 - std::abs(at), 0.0);
            }
        }
        EXPECT_NEAR(share, 2.0, 1e-12) << radius;
    }
}

// Nothing but a glowing square of `side` pixels in the dark; `x`, `y`: its first pixel.
constexpr std::uint32_t kSide = 128;
struct Dark {
    Dark(std::uint32_t x, std::uint32_t y, std::uint32_t side, float emitted, const BloomOptions& bloom)
        : gpu({.gpu = "software", .validate = true})
    {
        const auto edge = [](double pixel) {
            return static_cast<float>(pixel / kSide * 2.0 - 1.0);
        };
        const float left = edge(x + 0.01);
        const float right = edge(x + side - 0.01);
        const float top = -edge(y + 0.01);
        const float bottom = -edge(y + side - 0.01);
        scene::Primitive quad;
        quad.positions = {{left, bottom, 0}, {right, bottom, 0}, {right, top, 0}, {left, top, 0}};
        quad.normals.assign(4, glm::vec3(0.0F, 0.0F, 1.0F));
        quad.indices = {0, 1, 2, 0, 2, 3};
        quad.material = 0;
        scene::Material glow;
        glow.base_colour = {0.0F, 0.0F, 0.0F, 1.0F};
        glow.emissive = glm::vec3(emitted);
        scene.materials.push_back(glow);
        scene.meshes.emplace_back().primitives.push_back(quad);
        scene.nodes.emplace_back().mesh = 0;
        scene.environment.sky_zenith = glm::vec3(0.0F);
        scene.environment.sky_horizon = glm::vec3(0.0F);
        scene.environment.ground = glm::vec3(0.0F);
        scene.environment.ambient = 0.0F;
        scene.environment.exposure = 1.0F;
        scene::finishScene(scene);
        state = scene::evaluate(scene, 0.0);
        RenderOptions options;
        options.width = kSide;
        options.height = kSide;
        options.shadows = false;
        options.bloom = bloom;
        const SceneOnGpu uploaded(gpu, scene, state);
        FrameRenderer renderer(uploaded, options);
        Eye eye;
        eye.position_ws = {0.0, 0.0, 1.0};
        eye.target_ws = {0.0, 0.0, 0.0};
        eye.fov_y_rad = std::acos(0.0); // 90 degrees: the square from -1 to 1 fills the picture
        renderer.draw(state, eye, {});
        picture = renderer.read({.colour = true, .linear = true, .glow = true});
        for (const std::string& message : gpu.messages()) {
            ADD_FAILURE() << message;
        }
    }
    // The sum of the light that is added to the picture at an intensity of 1: red, in pixels.
    [[nodiscard]] double sum(std::uint32_t levels) const
    {
        double total = 0.0;
        for (std::size_t i = 0; i < picture.glow.values.size(); i += 3) {
            total += picture.glow.values[i];
        }
        return total * 4.0 / levels;
    }
    scene::Scene scene;
    scene::State state;
    Gpu gpu;
    Picture picture;
};

BloomOptions hardBloom(std::uint32_t levels)
{
    BloomOptions bloom;
    bloom.on = true;
    bloom.threshold = 0.5F;
    bloom.knee = 0.0F;
    bloom.levels = levels;
    return bloom;
}

TEST(Bloom, SpreadsAPixelsLightAndKeepsItsSumAndPlace)
{
    const Dark faint(61, 66, 1, 0.7F, hardBloom(3));
    ASSERT_NEAR(faint.picture.linear.pixel(61, 66)[0], 0.7F, 1e-3F);
    ASSERT_EQ(std::count_if(faint.picture.linear.values.begin(), faint.picture.linear.values.end(),
                            [](float v) { return v > 0.0F; }),
              3);
    EXPECT_NEAR(faint.sum(3), 0.2, 0.2 * 0.025);
    double x = 0.0;
    double y = 0.0;
    double sum = 0.0;
    for (std::uint32_t v = 0; v < kSide / 2; ++v) {
        for (std::uint32_t u = 0; u < kSide / 2; ++u) {
            const double light = *faint.picture.glow.pixel(u, v);
            x += light * (u * 2.0 + 1.0);
            y += light * (v * 2.0 + 1.0);
            sum += light;
        }
    }
    EXPECT_NEAR(x / sum, 61.5, 0.1);
    EXPECT_NEAR(y / sum, 66.5, 0.1);
}

TEST(Bloom, CalmsSparklesAndKeepsWideLight)
{
    const Dark sparkle(61, 66, 1, 100.5F, hardBloom(3));
    EXPECT_LT(sparkle.sum(3), 0.5 * 100.0);
    EXPECT_GT(sparkle.sum(3), 1.0);
    const Dark wide(48, 48, 32, 4.5F, hardBloom(3));
    EXPECT_NEAR(wide.sum(3), 4.0 * 32 * 32, 0.1 * 4.0 * 32 * 32);
    EXPECT_NEAR(*wide.picture.glow.pixel(32, 32) / 3.0F, 4.0F, 0.4F);
}

TEST(Bloom, LeavesWhatIsBelowTheThresholdAlone)
{
    const Dark off(48, 48, 32, 0.45F, BloomOptions{});
    const Dark on(48, 48, 32, 0.45F, hardBloom(6));
    EXPECT_EQ(on.sum(6), 0.0);
    EXPECT_EQ(on.picture.colour.values, off.picture.colour.values);
    EXPECT_TRUE(off.picture.glow.values.empty());
}

struct Result {
    Picture picture;
    bool pass = false;
    bool memory = false;
};
Result drawSmall(Gpu& gpu, std::uint32_t width, std::uint32_t height, AntiAliasing smooth, const BloomOptions& bloom)
{
    const scene::Scene scene = smallScene();
    const scene::State state = scene::evaluate(scene, 0.0);
    RenderOptions options;
    options.width = width;
    options.height = height;
    options.shadows = false;
    options.anti_aliasing = smooth;
    options.bloom = bloom;
    const SceneOnGpu uploaded(gpu, scene, state);
    FrameRenderer renderer(uploaded, options);
    Result result;
    for (const vulkan::PassRecord& pass : renderer.draw(state, smallEye(), lightsOf(scene, state)).passes) {
        result.pass = result.pass || std::string(pass.name) == "bloom";
    }
    for (const vulkan::MemoryUse& use : renderer.memory()) {
        result.memory = result.memory || std::string(use.purpose) == "bloom";
    }
    result.picture = renderer.read({.colour = true, .linear = true});
    return result;
}

TEST(Bloom, GlowsAtEverySizeAndWithEveryAntiAliasing)
{
    Gpu gpu({.gpu = "software", .validate = true});
    for (const auto& [width, height] : {std::pair{16U, 16U}, std::pair{1U, 3U}, std::pair{101U, 67U}}) {
        for (const AntiAliasing smooth : {AntiAliasing::none, AntiAliasing::fxaa, AntiAliasing::ssaa4}) {
            const Result off = drawSmall(gpu, width, height, smooth, BloomOptions{});
            EXPECT_FALSE(off.pass);
            EXPECT_FALSE(off.memory);
            BloomOptions bloom = hardBloom(8);
            bloom.intensity = 1.0F;
            const Result on = drawSmall(gpu, width, height, smooth, bloom);
            EXPECT_TRUE(on.pass);
            EXPECT_TRUE(on.memory);
            EXPECT_EQ(on.picture.linear.values, off.picture.linear.values);
            EXPECT_NE(on.picture.colour.values, off.picture.colour.values) << width << 'x' << height;
            if (smooth != AntiAliasing::fxaa) {
                EXPECT_TRUE(std::equal(on.picture.colour.values.begin(), on.picture.colour.values.end(),
                                       off.picture.colour.values.begin(), std::greater_equal<>{}))
                    << "light is only added";
            }
        }
    }
    EXPECT_TRUE(gpu.messages().empty());
}

TEST(Bloom, WithoutIntensityTakesNothing)
{
    Gpu gpu({.gpu = "software", .validate = true});
    BloomOptions bloom = hardBloom(8);
    bloom.intensity = 0.0F;
    const Result none = drawSmall(gpu, 32, 32, AntiAliasing::none, bloom);
    EXPECT_FALSE(none.pass);
    EXPECT_FALSE(none.memory);
}

TEST(Bloom, RefusesWhatIsOutOfRange)
{
    Gpu gpu({.gpu = "software", .validate = true});
    const auto refused = [&gpu](auto&& change) {
        BloomOptions bloom = hardBloom(5);
        change(bloom);
        EXPECT_THROW((void)drawSmall(gpu, 16, 16, AntiAliasing::none, bloom), Error);
    };
    refused([](BloomOptions& b) { b.threshold = -1.0F; });
    refused([](BloomOptions& b) { b.knee = std::numeric_limits<float>::quiet_NaN(); });
    refused([](BloomOptions& b) { b.intensity = 5.0F; });
    refused([](BloomOptions& b) { b.radius = 0.0F; });
    refused([](BloomOptions& b) { b.levels = 0; });
}

} // namespace
} // namespace gnomon::host::test
