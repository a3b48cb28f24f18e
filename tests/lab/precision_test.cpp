// SPDX-License-Identifier: Apache-2.0
// The smallest step in height that a filter still shadows without acne, by the range of depths that its map must span.
//
// A plate hangs a step above a plane, both across the sun's rays at the far end of the map's range, where a float's
// numbers lie farthest apart. The map must also span a small receiver close to the camera, which is the range above the
// plane. Plate and receiver face down: maps hold them, the camera looks through their backs.
#include "stage.h"

#include "scene/state.h"

#include <glm/gtc/quaternion.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <utility>

namespace gnomon::lab::test {
namespace {

constexpr float kPlaneHalf_m = 2.0F;
constexpr float kPlateHalf_m = 1.25F;
constexpr float kChipHalf_m = 0.1F;
constexpr float kBlur_m = 0.3F; // what borders of shadows take at most
constexpr std::uint32_t kSide_px = 64;

void addSquare(scene::Scene& scene, const char* name, float half, bool faces_up)
{
    scene::Primitive primitive;
    const float s = faces_up ? 1.0F : -1.0F;
    primitive.positions = {{-half, 0, s * half}, {half, 0, s * half}, {half, 0, -s * half}, {-half, 0, -s * half}};
    primitive.normals.assign(4, {0.0F, s, 0.0F});
    primitive.indices = {0, 1, 2, 0, 2, 3};
    scene.meshes.emplace_back().name = name;
    scene.meshes.back().primitives.push_back(std::move(primitive));
    scene::Node node;
    node.name = name;
    node.mesh = static_cast<std::uint32_t>(scene.meshes.size() - 1);
    node.dynamic = true;
    scene.nodes.push_back(std::move(node));
}

scene::Scene makeStep()
{
    scene::Scene scene;
    addSquare(scene, "plane", kPlaneHalf_m, true);
    addSquare(scene, "plate", kPlateHalf_m, false);
    scene.nodes.back().receives = false;
    addSquare(scene, "chip", kChipHalf_m, false);
    scene.lights.emplace_back().name = "sun";
    scene::Node sun;
    sun.name = "sun";
    sun.light = 0;
    sun.transform.rotation = glm::quat(glm::vec3(0.0F, 0.0F, -1.0F), glm::vec3(0.0F, -1.0F, 0.0F));
    scene.nodes.push_back(sun);
    scene::finishScene(scene);
    return scene;
}

struct Combination {
    const char* name;
    Filter filter;
    MapFormat format;
    bool remap = false;
    bool rounding_is_most = true;
};

class Bench {
public:
    explicit Bench(const Combination& combination, std::uint32_t map_size = 128)
        : scene_(makeStep()), gpu_({.gpu = "software", .validate = true}),
          uploaded_(gpu_, scene_, scene::evaluate(scene_, 0.0)),
          options_(filterOptions(combination.filter, combination.format, map_size))
    {
        options_.width = kSide_px;
        options_.height = kSide_px;
        options_.shadow.moments.remap = combination.remap;
        renderer_ = std::make_unique<host::FrameRenderer>(uploaded_, options_);
    }
    ~Bench()
    {
        for (const std::string& message : gpu_.messages()) {
            ADD_FAILURE() << message;
        }
    }
    Bench(const Bench&) = delete;
    Bench& operator=(const Bench&) = delete;

    /// Dark in the middle under the plate and lit beside it?
    [[nodiscard]] bool shadows(float range_m, float step_m)
    {
        scene_.nodes[1].transform.translation.y = step_m;
        scene_.nodes[2].transform.translation.y = range_m;
        const scene::State state = scene::evaluate(scene_, 0.0);
        const double height_m = 1.1 * double{range_m};
        const host::Eye eye{.position_ws = {0.0, height_m, 0.0},
                            .target_ws = {0.0, 0.0, 0.0},
                            .up_ws = {0.0, 0.0, -1.0},
                            .fov_y_rad = 2.0 * std::atan(double{kPlaneHalf_m} / height_m),
                            .near_m = 0.05 * height_m};
        renderer_->draw(state, eye, host::lightsOf(scene_, state));
        const View& view = renderer_->plan().views.at(0);
        EXPECT_GT(view.projection.metric.far_m - view.projection.metric.near_m, 0.99 * double{range_m});
        EXPECT_LT(view.projection.metric.far_m - view.projection.metric.near_m, 1.2 * double{range_m});
        return isStep(renderer_->read({.colour = false, .masks = true}).masks.at(0));
    }

    /// Metres, within a twentieth; infinite where not even a quarter of the range is shadowed.
    [[nodiscard]] double smallestStep_m(float range_m)
    {
        double good = 0.25 * double{range_m};
        if (!shadows(range_m, static_cast<float>(good))) {
            return INFINITY;
        }
        double bad = 0.5 * good;
        while (bad > 1e-9 * double{range_m} && shadows(range_m, static_cast<float>(bad))) {
            good = bad;
            bad *= 0.5;
        }
        while (good / bad > 1.05) {
            const double middle = std::sqrt(good * bad);
            (shadows(range_m, static_cast<float>(middle)) ? good : bad) = middle;
        }
        return good;
    }

private:
    static bool isStep(const ImageF& mask)
    {
        constexpr double kPixel_m = 2.0 * kPlaneHalf_m / kSide_px;
        float darkest_lit = 1.0F;
        float brightest_dark = 0.0F;
        for (std::uint32_t y = 0; y < kSide_px; ++y) {
            for (std::uint32_t x = 0; x < kSide_px; ++x) {
                const double away = std::max(std::abs(x + 0.5 - 0.5 * kSide_px), std::abs(y + 0.5 - 0.5 * kSide_px));
                const float value = *mask.pixel(x, y);
                if (away * kPixel_m < kChipHalf_m + kBlur_m) {
                    continue;
                }
                if (away * kPixel_m < kPlateHalf_m - kBlur_m) {
                    brightest_dark = std::max(brightest_dark, value);
                } else if (away * kPixel_m > kPlateHalf_m + kBlur_m && away * kPixel_m < kPlaneHalf_m - 0.1) {
                    darkest_lit = std::min(darkest_lit, value);
                }
            }
        }
        return brightest_dark < 0.5F && darkest_lit > 0.95F;
    }

    scene::Scene scene_;
    host::Gpu gpu_;
    host::SceneOnGpu uploaded_;
    host::RenderOptions options_;
    std::unique_ptr<host::FrameRenderer> renderer_;
};

/// Smallest steps over 100 m and 10 km; prints a row.
std::pair<double, double> stepsOf(const Combination& combination)
{
    Bench bench(combination);
    const double near_m = bench.smallestStep_m(100.0F);
    const double far_m = bench.smallestStep_m(10000.0F);
    std::printf("%-24s %12.3g m %12.3g m %10.1f\n", combination.name, near_m, far_m, far_m / near_m);
    return {near_m, far_m};
}

class Precision : public testing::TestWithParam<Combination> {};

TEST_P(Precision, OfHeightsIsLostByAHundredOverAHundredfoldRange)
{
    const auto [near_m, far_m] = stepsOf(GetParam());
    ASSERT_TRUE(std::isfinite(near_m));
    ASSERT_TRUE(std::isfinite(far_m));
    // Rounding is a share of the range. A quarter for the search, which ends within a twentieth, and for the half texel
    // of depth that is taken off whatever the range.
    EXPECT_LT(far_m / near_m, 125.0);
    if (GetParam().rounding_is_most) {
        // A layer's bound by the mean of its depths alone (Markov) keeps shadows that rounding would lose.
        EXPECT_GT(far_m / near_m, GetParam().filter == Filter::lvsm ? 60.0 : 75.0);
        return;
    }
    // A format that rounds so little loses less than a hundred, because the rest of the step is in proportion to a
    // texel: with texels half as large it is half as long.
    const double by_range_m = (far_m - near_m) / 99.0; // the part of the nearer step due to rounding
    const double by_texel_m = near_m - by_range_m;
    EXPECT_GT(by_texel_m, 0.0);
    EXPECT_NEAR(Bench(GetParam(), 256).smallestStep_m(100.0F), 0.5 * by_texel_m + by_range_m, 0.1 * near_m);
}

constexpr std::array kCombinations{
    Combination{"hard d16", Filter::hard, MapFormat::d16, false, false},
    Combination{"hard d32f", Filter::hard, MapFormat::d32f, false, false},
    Combination{"vsm rg16", Filter::vsm, MapFormat::rg16},
    Combination{"vsm rg16f", Filter::vsm, MapFormat::rg16f},
    Combination{"vsm rg32f", Filter::vsm, MapFormat::rg32f},
    Combination{"vsm rg32f, -1 to 1", Filter::vsm, MapFormat::rg32f, true},
    Combination{"lvsm rgba16", Filter::lvsm, MapFormat::rgba16},
    Combination{"lvsm rgba16f", Filter::lvsm, MapFormat::rgba16f},
    Combination{"lvsm rgba32f", Filter::lvsm, MapFormat::rgba32f},
    Combination{"esm r32f", Filter::esm, MapFormat::r32f},
    Combination{"esm r16f", Filter::esm, MapFormat::r16f},
    Combination{"evsm rgba32f", Filter::evsm, MapFormat::rgba32f, false, false},
    Combination{"evsm rgba16f", Filter::evsm, MapFormat::rgba16f},
    Combination{"evsm rg32f", Filter::evsm, MapFormat::rg32f, false, false},
    Combination{"msm rgba16", Filter::msm, MapFormat::rgba16},
    Combination{"msm rgba32f", Filter::msm, MapFormat::rgba32f, false, false},
};

INSTANTIATE_TEST_SUITE_P(Formats, Precision, testing::ValuesIn(kCombinations), [](const auto& row) {
    std::string name = row.param.name;
    name.erase(std::remove_if(name.begin(), name.end(),
                              [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; }),
               name.end());
    return name;
});

} // namespace
} // namespace gnomon::lab::test
