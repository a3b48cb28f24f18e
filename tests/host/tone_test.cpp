// SPDX-License-Identifier: Apache-2.0
// The tone curves and dither in double precision, and edges that fxaa smooths on a device.
#include "small_scene.h"

#include "scene/state.h"

#define GNOMON_REAL double
#include "host/shaders/tone_curve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

namespace gnomon::host::test {
namespace {

using namespace gnomon::shared::of_double;

/// The hue of a saturated colour, in sixths of a turn from red.
double hueOf(const glm::dvec3& c)
{
    const double least = std::min({c.x, c.y, c.z});
    const double span = std::max({c.x, c.y, c.z}) - least;
    if (c.x >= c.y && c.x >= c.z) {
        return (c.y - c.z) / span;
    }
    return c.y >= c.z ? 2.0 + (c.z - c.x) / span : 4.0 + (c.x - c.y) / span;
}

TEST(ToneCurve, NeutralKeepsEveryHueAtEveryBrightness)
{
    for (const glm::dvec3& colour : {glm::dvec3(1.0, 0.45, 0.1), glm::dvec3(0.9, 0.2, 0.3), glm::dvec3(0.1, 0.3, 1.0),
                                     glm::dvec3(0.5, 0.8, 0.15), glm::dvec3(1.0, 0.9, 0.8)}) {
        for (const double light : {0.02, 0.2, 0.7, 1.35, 4.0, 30.0}) {
            EXPECT_NEAR(hueOf(neutralTone(colour * light)), hueOf(colour), 1e-9) << light;
        }
    }
    // The other curve's shift of the orange of a fox.
    EXPECT_GT(hueOf(filmicTone(glm::dvec3(1.0, 0.45, 0.1) * 1.35)), hueOf({1.0, 0.45, 0.1}) + 0.15);
}

TEST(ToneCurve, NeutralRisesWithoutAJumpFromBlackToWhite)
{
    EXPECT_EQ(neutralTone(glm::dvec3(0.0)), glm::dvec3(0.0));
    double last = 0.0;
    constexpr double kStep = 1e-3;
    for (double light = kStep; light < 8.0; light += kStep) {
        const double shown = neutralTone(glm::dvec3(light)).x;
        EXPECT_GT(shown, last) << light;
        EXPECT_LT(shown, last + 1.6 * kStep) << light;
        EXPECT_LT(shown, 1.0);
        last = shown;
    }
    EXPECT_GT(last, 0.99);
    const glm::dvec3 glare = neutralTone({400.0, 100.0, 40.0});
    EXPECT_GT(glare.z, 0.95) << "what glares is white";
    EXPECT_LE(glare.x, 1.0);
}

TEST(ToneCurve, BothShowAGreyAlike)
{
    constexpr double kGrey = 0.18 * 1.35; // in full light
    EXPECT_NEAR(neutralTone(glm::dvec3(kGrey)).x, filmicTone(glm::dvec3(kGrey)).x, 0.07);
}

TEST(Dither, IsATriangleAroundTheValueAndLeavesBlackAndWhite)
{
    EXPECT_NEAR(triangular(0.0), -1.0, 1e-12);
    EXPECT_NEAR(triangular(0.5), 0.0, 1e-12);
    EXPECT_NEAR(triangular(0.875), 0.5, 1e-12); // an eighth of the area lies beyond half of one side
    for (const double even : {0.0, 0.3, 0.999}) {
        EXPECT_EQ(dithered(0.0, even), 0.0);
        EXPECT_EQ(dithered(1.0, even), 1.0);
        EXPECT_LE(std::abs(dithered(0.5, even) - 0.5), 1.0 / 255.0);
        EXPECT_GE(dithered(0.5 / 255.0, even), 0.0);
    }
}

TEST(Dither, RoundsToTheValueOnTheAverage)
{
    for (double value = 30.0; value < 31.0; value += 0.0625) {
        double sum = 0.0;
        constexpr int kSide = 64;
        for (int i = 0; i < kSide * kSide; ++i) {
            const double even = gradientNoise(glm::dvec2(i % kSide + 0.5, i / kSide + 0.5));
            EXPECT_GE(even, 0.0);
            EXPECT_LT(even, 1.0);
            sum += std::round(dithered(value / 255.0, even) * 255.0);
        }
        EXPECT_NEAR(sum / (kSide * kSide), value, 0.03);
    }
}

/// A white floor over black, whose far edge is nearly level.
ImageF edgeOf(AntiAliasing smooth)
{
    static Gpu gpu({.gpu = "software", .validate = true});
    scene::Scene scene;
    scene::Material white;
    white.model = scene::ShadingModel::unlit;
    scene.materials.push_back(white);
    scene::Primitive half;
    half.positions = {{-4.0F, -4.0F, 0.0F}, {4.0F, -4.0F, 0.0F}, {4.0F, 0.31F, 0.0F}, {-4.0F, -0.28F, 0.0F}};
    half.normals.assign(4, glm::vec3(0.0F, 0.0F, 1.0F));
    half.indices = {0, 1, 2, 0, 2, 3};
    half.material = 0;
    addMesh(scene, half);
    scene.environment.sky_zenith = scene.environment.sky_horizon = scene.environment.ground = glm::vec3(0.0F);
    scene::finishScene(scene);
    const scene::State state = scene::evaluate(scene, 0.0);
    RenderOptions options;
    options.width = 96;
    options.height = 64;
    options.shadows = false;
    options.anti_aliasing = smooth;
    const SceneOnGpu uploaded(gpu, scene, state);
    FrameRenderer renderer(uploaded, options);
    Eye eye;
    eye.position_ws = {0.0, 0.0, 2.0};
    eye.target_ws = {0.0, 0.0, 0.0};
    renderer.draw(state, eye, {});
    const Image8 colour = renderer.read({.colour = true}).colour;
    EXPECT_EQ(gpu.messages(), std::vector<std::string>{});
    ImageF red(colour.width, colour.height, 1);
    for (std::size_t i = 0; i < red.values.size(); ++i) {
        red.values[i] = static_cast<float>(colour.values[i * 3]) / 255.0F;
    }
    return red;
}

/// Root mean square of how much a column's sum leaves the straight line that the edge is: sums know coverage alone.
double jaggedness(const ImageF& picture)
{
    std::vector<double> heights;
    for (std::uint32_t x = 0; x < picture.width; ++x) {
        double sum = 0.0;
        for (std::uint32_t y = 0; y < picture.height; ++y) {
            sum += *picture.pixel(x, y);
        }
        heights.push_back(sum);
    }
    const double slope = (heights.back() - heights.front()) / (static_cast<double>(heights.size()) - 1.0);
    double squares = 0.0;
    for (std::size_t x = 0; x < heights.size(); ++x) {
        const double off = heights[x] - heights.front() - slope * static_cast<double>(x);
        squares += off * off;
    }
    return std::sqrt(squares / static_cast<double>(heights.size()));
}

TEST(Fxaa, FollowsAnEdgeThatIsNearlyLevel)
{
    const double none = jaggedness(edgeOf(AntiAliasing::none));
    const double smooth = jaggedness(edgeOf(AntiAliasing::fxaa));
    EXPECT_GT(none, 0.2);
    EXPECT_LT(smooth, 0.4 * none);
}

} // namespace
} // namespace gnomon::host::test
