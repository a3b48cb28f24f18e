// SPDX-License-Identifier: Apache-2.0
// How wide penumbrae are on the picture, of the filters that know how large the light is: beside a half plane's closed
// form, and of one width whatever the fit, partition and size of the map.
#include "host/frame_renderer.h"
#include "scene/state.h"
#include "small_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::host::test {
namespace {

constexpr std::uint32_t kWidth = 256;
constexpr std::uint32_t kHeight = 192;
constexpr double kFov = 0.5;
constexpr double kPitch = 0.6; // the camera looks that far below the horizon, along the edge
constexpr double kSunAngle = 0.07;

void addLevel(scene::Scene& scene, glm::vec3 from, glm::vec3 to)
{
    scene::Primitive primitive;
    primitive.positions = {from, {from.x, from.y, to.z}, to, {to.x, from.y, from.z}};
    primitive.indices = {0, 1, 2, 0, 2, 3};
    addMesh(scene, std::move(primitive));
}

/// A ground under a half plane at height `h` that ends at x = 0, a sun overhead and a lamp at 3 h.
scene::Scene halfPlane(float h)
{
    scene::Scene scene;
    scene.materials.resize(1);
    scene.materials[0].double_sided = true;
    addLevel(scene, {-4 * h, 0, -4 * h}, {4 * h, 0, 4 * h});
    addLevel(scene, {0, h, -4 * h}, {4 * h, h, 4 * h});
    scene.lights.resize(2);
    scene.lights[1].type = scene::LightType::spot;
    scene.lights[1].outer_cone_rad = 0.8F;
    scene.lights[1].range_m = 20.0F * h;
    for (std::uint32_t i = 0; i < 2; ++i) {
        scene::Node node;
        node.light = i;
        node.transform.translation = {0.0F, 3.0F * h, -1.0F * h};
        node.transform.rotation = glm::angleAxis(-1.5707964F, glm::vec3(1, 0, 0)); // -z becomes down
        scene.nodes.push_back(node);
    }
    finishScene(scene);
    return scene;
}

/// Where the visibility of a half plane is a tenth: so far from the edge, in half widths of the penumbra.
double tenthOfADisc()
{
    const auto lit = [](double t) {
        return (std::acos(t) - t * std::sqrt(1.0 - t * t)) / std::numbers::pi;
    };
    double low = 0.0;
    double high = 1.0;
    for (int i = 0; i < 50; ++i) {
        const double middle = 0.5 * (low + high);
        (lit(middle) > 0.1 ? low : high) = middle;
    }
    return low;
}

/// Where a profile over places crosses a value, between the first place that is beyond it and the one before.
double crossing(const std::vector<double>& profile, double value)
{
    std::size_t i = 1;
    while (i + 1 < profile.size() && profile[i] > value) {
        ++i;
    }
    return static_cast<double>(i) - (value - profile[i]) / (profile[i - 1] - profile[i]);
}

/// From 90 to 10 %, in half widths of the penumbra, over rows of the picture. `half_m`: half its width.
double widthOver(const ImageF& mask, std::uint32_t first_row, std::uint32_t last_row, double eye_m, double half_m)
{
    constexpr int kPlaces = 41; // from -1.5 to 1.5
    std::vector<double> sum(kPlaces, 0.0);
    std::vector<double> count(kPlaces, 0.0);
    for (std::uint32_t row = first_row; row < last_row; ++row) {
        const double up = (0.5 - (row + 0.5) / kHeight) * 2.0 * std::tan(0.5 * kFov);
        const double along = eye_m / (std::sin(kPitch) - up * std::cos(kPitch)); // of the camera's depth
        const double pixel_m = along * 2.0 * std::tan(0.5 * kFov) / kHeight;
        for (std::uint32_t column = 0; column < kWidth; ++column) {
            const double t = (column + 0.5 - 0.5 * kWidth) * pixel_m / half_m;
            const auto place = static_cast<long>(std::floor((t + 1.5) / 3.0 * kPlaces));
            if (place >= 0 && place < kPlaces) {
                sum[place] += mask.values[std::size_t{row} * kWidth + column];
                count[place] += 1.0;
            }
        }
    }
    std::vector<double> profile;
    for (int i = 0; i < kPlaces; ++i) {
        profile.push_back(sum[i] / std::max(count[i], 1.0));
    }
    return (crossing(profile, 0.1) - crossing(profile, 0.9)) * 3.0 / kPlaces;
}

struct Variant {
    Partition partition = Partition::single;
    Fit fit = Fit::uniform;
    std::uint32_t map_size = 256;
};

struct Widths {
    std::array<double, 2> near; // of sun and lamp, in the near half of the picture
    std::array<double, 2> far;
};

Widths widthsOf(Gpu& gpu, double h, Filter filter, const Variant& variant)
{
    const scene::Scene scene = halfPlane(static_cast<float>(h));
    const scene::State state = scene::evaluate(scene, 0.0);
    RenderOptions options;
    options.width = kWidth;
    options.height = kHeight;
    options.shadow = ShadowOptions{.technique = kPlainTechnique};
    options.shadow.technique.filter = filter;
    options.shadow.technique.partition = variant.partition;
    options.shadow.technique.fit = variant.fit;
    options.shadow.map_size = variant.map_size;
    options.shadow.moments.blur = BlurKind::none; // of filters with moments
    options.shadow.moments.penumbra = MomentPenumbra::light;
    options.shadow.max_distance_m = 3.0 * h;
    options.shadow.fade = 0.0;
    std::vector<ShadedLight> lights = lightsOf(scene, state);
    lights[0].caster.angular_diameter_rad = kSunAngle;
    lights[1].caster.radius_m = 0.07 * h;
    const double lamp_half_m = h * std::tan(std::asin(lights[1].caster.radius_m / (2.0 * h)));
    const std::array<double, 2> half_m{h * std::tan(0.5 * kSunAngle), lamp_half_m};
    const double eye_m = 0.5 * h;
    const SceneOnGpu uploaded(gpu, scene, state);
    FrameRenderer renderer(uploaded, options);
    const glm::dvec3 eye{0.0, eye_m, 0.0};
    renderer.draw(state,
                  {.position_ws = eye,
                   .target_ws = eye + h * glm::dvec3(0.0, -std::sin(kPitch), -std::cos(kPitch)),
                   .fov_y_rad = kFov},
                  lights);
    const Picture picture = renderer.read({.colour = false, .linear = false, .masks = true, .geometry = false});
    Widths widths{};
    for (std::size_t i = 0; i < 2; ++i) {
        widths.far[i] = widthOver(picture.masks[i], 0, kHeight / 2, eye_m, half_m[i]);
        widths.near[i] = widthOver(picture.masks[i], kHeight / 2, kHeight, eye_m, half_m[i]);
    }
    return widths;
}

const std::vector<Variant> kVariants{
    {},
    {.map_size = 512},
    {.map_size = 1024},
    {.fit = Fit::lispsm},
    {.fit = Fit::tsm},
    {.partition = Partition::cascades},
    {.partition = Partition::cascades, .map_size = 512},
    {.partition = Partition::sdsm},
    {.partition = Partition::sdsm, .fit = Fit::lispsm_simple},
};

struct Expected {
    Filter filter = Filter::hard;
    double off = 0.0;   // from the closed form, as a share of it
    double apart = 0.0; // the widest from the narrowest, as a ratio
};

class PenumbraWidth : public testing::TestWithParam<Expected> {};

TEST_P(PenumbraWidth, IsTheClosedFormsInEveryFitPartitionAndSize)
{
    Gpu gpu({.gpu = "software", .validate = true});
    const double expected = 2.0 * tenthOfADisc(); // half widths
    for (const double h : {1.0, 5.0, 20.0}) {
        std::array<std::vector<double>, 2> found; // of sun and lamp
        for (const Variant& variant : kVariants) {
            const Widths widths = widthsOf(gpu, h, GetParam().filter, variant);
            for (std::size_t light = 0; light < 2; ++light) {
                for (const double width : {widths.near[light], widths.far[light]}) {
                    found[light].push_back(width / expected);

                    EXPECT_NEAR(found[light].back(), 1.0, GetParam().off)
                        << nameOf(variant.partition) << ' ' << nameOf(variant.fit) << ' ' << variant.map_size
                        << " light " << light;
                }
            }
        }
        for (const std::vector<double>& widths : found) {
            const auto [least, most] = std::ranges::minmax(widths);
            EXPECT_LE(most / least, GetParam().apart) << h << " m";
        }
    }
    EXPECT_EQ(gpu.messages(), std::vector<std::string>{});
}

// Sixteen reads of moments do not reach the light's rim.
INSTANTIATE_TEST_SUITE_P(Filters, PenumbraWidth,
                         testing::Values(Expected{Filter::pcss, 0.05, 1.02}, Expected{Filter::raymarch, 0.05, 1.02},
                                         Expected{Filter::vsm, 0.06, 1.03}, Expected{Filter::msm, 0.06, 1.03}),
                         [](const auto& one) { return std::string(nameOf(one.param.filter)); });

} // namespace
} // namespace gnomon::host::test
