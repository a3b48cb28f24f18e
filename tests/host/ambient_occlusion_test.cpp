// SPDX-License-Identifier: Apache-2.0
// Ambient occlusion against closed forms: its arithmetic with horizons found by marching rays, and what a device draws.
#include "small_scene.h"

#include "scene/state.h"

#define GNOMON_REAL double
#include "host/shaders/ambient_occlusion.h"

#include <gnomon/error.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <string>

namespace gnomon::host::test {
namespace {

using namespace gnomon::shared::of_double;
constexpr double kPi = std::numbers::pi;

/// The highest cosine to `v` of what is blocked, going from `v` towards `along`.
template <typename Blocked>
double marchedHorizon(const glm::dvec3& v, const glm::dvec3& along, const Blocked& blocked)
{
    constexpr int kRays = 4000;
    for (int i = 0; i < kRays; ++i) {
        const double angle = kPi * i / kRays;
        if (blocked(std::cos(angle) * v + std::sin(angle) * along)) {
            return std::cos(angle);
        }
    }
    return -1.0;
}

/// Light of a white sky over that of an open plane, by slices through `v`.
template <typename Blocked>
double skyLight(const glm::dvec3& normal, const glm::dvec3& v, const Blocked& blocked)
{
    const glm::dvec3 side = glm::normalize(glm::cross(v, glm::dvec3(0.3, 0.1, 0.9)));
    const glm::dvec3 other = glm::cross(v, side);
    constexpr int kSlices = 128;
    glm::dvec2 light(0.0);
    for (int i = 0; i < kSlices; ++i) {
        const double turn = kPi * (i + 0.5) / kSlices;
        const glm::dvec3 along = std::cos(turn) * side + std::sin(turn) * other;
        light += sliceLight(glm::dot(normal, along), glm::dot(normal, v),
                            {marchedHorizon(v, along, blocked), marchedHorizon(v, -along, blocked)});
    }
    return light.x / light.y;
}

constexpr glm::dvec3 kUp{0.0, 1.0, 0.0};
const std::array<glm::dvec3, 3> kViews{kUp, glm::normalize(glm::dvec3(0.3, 1.0, 0.2)),
                                       glm::normalize(glm::dvec3(0.5, 0.6, -0.2))};

TEST(AmbientOcclusion, OfAPlaneIsNoneInEverySlice)
{
    for (const glm::dvec3& v : kViews) {
        double whole = 0.0;
        constexpr int kSlices = 64;
        for (int i = 0; i < kSlices; ++i) {
            const glm::dvec3 side = glm::normalize(glm::cross(v, glm::dvec3(1.0, 0.2, 0.0)));
            const double turn = kPi * i / kSlices;
            const glm::dvec3 along = std::cos(turn) * side + std::sin(turn) * glm::cross(v, side);
            const double x = glm::dot(kUp, along);
            const double y = glm::dot(kUp, v);
            const glm::dvec2 light = sliceLight(x, y, {ownHorizon(x, y), ownHorizon(-x, y)});
            EXPECT_NEAR(light.x, light.y, 1e-9);
            whole += light.y / kSlices;
        }
        EXPECT_NEAR(whole, 1.0, 1e-3) << "so dividing by it changes nothing in the limit";
    }
}

TEST(AmbientOcclusion, BesideAnEndlessWallIsHalf)
{
    const auto wall = [](const glm::dvec3& d) {
        return d.y <= 0.0 || d.x < 0.0;
    };
    for (const glm::dvec3& v : kViews) {
        EXPECT_NEAR(skyLight(kUp, v, wall), 0.5, 2e-3);
    }
}

TEST(AmbientOcclusion, OnTheFloorOfABoxIsTheOpeningsViewFactor)
{
    // The light through an opening of 2 x 2 at a height of 1 above the point: four corners of 1 x 1 (J. Howell, "A
    // Catalog of Radiation Heat Transfer Configuration Factors", B-3).
    const double corner = 2.0 / std::sqrt(2.0) * std::atan(1.0 / std::sqrt(2.0)) / (2.0 * kPi);
    const auto box = [](const glm::dvec3& d) {
        const double side = 1.0 / std::max({std::abs(d.x), std::abs(d.z), 1e-12});
        return d.y <= 0.0 || d.y * side < 1.0;
    };
    for (const glm::dvec3& v : kViews) {
        if (!box(v)) { // the eye looks in
            EXPECT_NEAR(skyLight(kUp, v, box), 4.0 * corner, 2e-3);
        }
    }
    EXPECT_NEAR(4.0 * corner, 0.554, 1e-3);
}

TEST(AmbientOcclusion, HorizonsRiseAtOnceAndSinkSlowly)
{
    EXPECT_EQ(raisedHorizon(0.2, 0.7, 0.1), 0.7);
    EXPECT_NEAR(raisedHorizon(0.7, 0.2, 0.1), 0.65, 1e-12);
    EXPECT_EQ(raisedHorizon(0.7, 0.2, 0.0), 0.7);
    EXPECT_EQ(occluderWeight(0.0, 2.0), 1.0);
    EXPECT_NEAR(occluderWeight(kOcclusionWhole * 2.0, 2.0), 1.0, 1e-12);
    EXPECT_EQ(occluderWeight(2.0, 2.0), 0.0);
    EXPECT_EQ(occluderWeight(9.0, 2.0), 0.0);
}

TEST(AmbientOcclusion, SamplesAreWhereTheyRiseTo)
{
    // In the slice itself: the same as the cosine to where it is.
    for (const glm::dvec3& v : kViews) {
        const glm::dvec3 along =
            glm::normalize(glm::cross(glm::normalize(glm::cross(v, glm::dvec3(0.9, 0.1, 0.4))), v));
        const glm::dvec2 normal(glm::dot(kUp, along), glm::dot(kUp, v));
        const double own = ownHorizon(normal.x, normal.y);
        for (const double angle : {0.1, 0.5, 1.0}) {
            const glm::dvec3 to = std::cos(angle) * v + std::sin(angle) * along;
            const double rise = glm::dot(kUp, to) / glm::length(normal);
            ASSERT_GT(rise, 0.0);
            EXPECT_NEAR(risenHorizon(own, rise), std::cos(angle), 1e-9);
        }
        EXPECT_EQ(risenHorizon(own, -0.3), own) << "what lies below hides nothing";
    }
}

TEST(AmbientOcclusion, PatternsOfFourByFourHaveAllDirectionsOnce)
{
    for (const int from : {0, 3, 17}) {
        std::set<double> directions;
        for (int i = 0; i < 16; ++i) {
            const glm::dvec2 pattern = occlusionPattern(from + i % 4, from + i / 4);
            directions.insert(pattern.x);
            EXPECT_GT(pattern.y, 0.0);
            EXPECT_LT(pattern.y, 1.0);
        }
        EXPECT_EQ(directions.size(), 16U);
        EXPECT_EQ(*directions.rbegin(), 15.0 / 16.0);
    }
}

TEST(AmbientOcclusion, BouncesBrightenAndNeverDarken)
{
    for (double albedo = 0.0; albedo <= 1.0; albedo += 0.125) {
        EXPECT_NEAR(bouncedOcclusion(1.0, albedo), 1.0, 1e-3);
        double last = -1.0;
        for (double seen = 0.0; seen <= 1.0; seen += 1.0 / 64.0) {
            const double bounced = bouncedOcclusion(seen, albedo);
            EXPECT_GE(bounced, seen);
            EXPECT_GE(bounced, last);
            last = bounced;
        }
    }
    EXPECT_GT(bouncedOcclusion(0.5, 0.9), bouncedOcclusion(0.5, 0.1) + 0.1);
    EXPECT_NEAR(specularOcclusion(1.0, 0.4, 0.3), 1.0, 1e-12);
    EXPECT_EQ(specularOcclusion(0.0, 0.4, 0.3), 0.0);
    EXPECT_NEAR(specularOcclusion(0.5, 1.0, 1.0), 0.5, 1e-4) << "a rough surface sees as much as it is lit by";
}

constexpr std::uint32_t kWidth = 160;
constexpr std::uint32_t kHeight = 120;
constexpr float kWallX = -2.0F;
constexpr float kWallHeight = 0.3F;

/// A floor at y = 0 with diffuse reflection only, and maybe a wall at x = kWallX; a sky of one colour.
scene::Scene cornerScene(bool with_wall, float albedo)
{
    scene::Scene scene;
    scene::Material chalk;
    chalk.base_colour = {albedo, albedo, albedo, 1.0F};
    chalk.roughness = 1.0F;
    chalk.metallic = 0.0F;
    scene.materials.push_back(chalk);
    const auto add = [&scene](const glm::vec3& corner, const glm::vec3& u, const glm::vec3& v) {
        scene::Primitive quad;
        quad.positions = {corner, corner + u, corner + u + v, corner + v};
        quad.normals.assign(4, glm::normalize(glm::cross(u, v)));
        quad.indices = {0, 1, 2, 0, 2, 3};
        quad.material = 0;
        addMesh(scene, quad);
    };
    add({-50.0F, 0.0F, 50.0F}, {100.0F, 0.0F, 0.0F}, {0.0F, 0.0F, -100.0F});
    if (with_wall) {
        add({kWallX, 0.0F, 50.0F}, {0.0F, 0.0F, -100.0F}, {0.0F, kWallHeight, 0.0F});
    }
    scene.environment.sky_zenith = glm::vec3(1.0F);
    scene.environment.sky_horizon = glm::vec3(1.0F);
    scene.environment.ground = glm::vec3(1.0F);
    scene.environment.ambient = 0.5F;
    scene.environment.exposure = 1.0F;
    scene::finishScene(scene);
    return scene;
}

Eye lookingDown()
{
    Eye eye;
    eye.position_ws = {2.0, 4.0, 0.0};
    eye.target_ws = {-1.6, 0.2, 0.0};
    eye.up_ws = {0.0, 0.0, -1.0};
    eye.fov_y_rad = 0.6;
    return eye;
}

/// Where the ray of lookingDown() through the middle row's pixel meets the floor: x in metres.
double floorAt(std::uint32_t x)
{
    const Eye eye = lookingDown();
    const glm::dvec3 forward = glm::normalize(eye.target_ws - eye.position_ws);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, eye.up_ws));
    const glm::dvec3 up = glm::cross(right, forward);
    const double tan_y = std::tan(0.5 * eye.fov_y_rad);
    const double across = ((x + 0.5) / kWidth * 2.0 - 1.0) * tan_y * kWidth / kHeight;
    const double down = 1.0 / kHeight * tan_y; // the middle of the row below the picture's middle
    const glm::dvec3 ray = forward + across * right - down * up;
    return eye.position_ws.x - ray.x * eye.position_ws.y / ray.y;
}

struct Drawn {
    Picture picture;
    std::set<std::string> passes;
    std::set<std::string> memory;
};

Drawn drawnOf(const scene::Scene& scene, const RenderOptions& options, const Eye& eye,
              const std::vector<ShadedLight>& lights = {})
{
    static Gpu gpu({.gpu = "software", .validate = true});
    const scene::State state = scene::evaluate(scene, 0.0);
    const SceneOnGpu uploaded(gpu, scene, state);
    FrameRenderer renderer(uploaded, options);
    Drawn drawn;
    for (const vulkan::PassRecord& pass : renderer.draw(state, eye, lights).passes) {
        drawn.passes.insert(pass.name);
    }
    for (const vulkan::MemoryUse& use : renderer.memory()) {
        drawn.memory.insert(use.purpose);
    }
    const bool deferred = options.shading == Shading::deferred;
    drawn.picture = renderer.read({.colour = true, .linear = true, .masks = deferred && !lights.empty()});
    EXPECT_EQ(gpu.messages(), std::vector<std::string>{});
    return drawn;
}

RenderOptions optionsWith(bool on, float radius_m = 4.0F)
{
    RenderOptions options;
    options.width = kWidth;
    options.height = kHeight;
    options.shadow.map_size = 256;
    options.ambient_occlusion = {on, radius_m};
    return options;
}

TEST(AmbientOcclusion, LeavesAPlaneAsItIsUpToThePicturesBorder)
{
    const scene::Scene scene = cornerScene(false, 0.5F);
    Eye flat = lookingDown();
    flat.position_ws = {4.0, 0.8, 0.5}; // nearly along it, with the horizon in sight
    flat.up_ws = {0.0, 1.0, 0.0};
    for (const Eye& eye : {lookingDown(), flat}) {
        const ImageF on = drawnOf(scene, optionsWith(true), eye).picture.linear;
        const ImageF off = drawnOf(scene, optionsWith(false), eye).picture.linear;
        for (std::size_t i = 0; i < on.values.size(); ++i) {
            ASSERT_NEAR(on.values[i], off.values[i], 0.01F * off.values[i]) << i;
        }
    }
}

TEST(AmbientOcclusion, BesideALowWallIsWhatItHides)
{
    for (const float albedo : {0.05F, 0.8F}) {
        const scene::Scene scene = cornerScene(true, albedo);
        const ImageF on = drawnOf(scene, optionsWith(true), lookingDown()).picture.linear;
        const ImageF off = drawnOf(scene, optionsWith(false), lookingDown()).picture.linear;
        // An endless wall hides half the sine of the angle that it fills.
        std::vector<double> errors;
        for (std::uint32_t x = 0; x < kWidth; ++x) {
            const double from_wall = floorAt(x) - kWallX;
            if (from_wall < 0.05) { // the wall itself, and what a pixel has of it
                continue;
            }
            const double left = static_cast<double>(on.pixel(x, kHeight / 2)[0]) / off.pixel(x, kHeight / 2)[0];
            const double hidden = 0.5 - 0.5 * from_wall / std::hypot(from_wall, kWallHeight);
            errors.push_back(left - bouncedOcclusion(1.0 - hidden, albedo * 0.96));
        }
        ASSERT_GT(errors.size(), kWidth / 2);
        const auto [least, most] = std::minmax_element(errors.begin(), errors.end());
        EXPECT_GT(*least, -0.08) << albedo;
        EXPECT_LT(*most, 0.08) << albedo;
    }
}

TEST(AmbientOcclusion, ChangesNeitherMasksNorTheLightOfLamps)
{
    scene::Scene scene = smallScene();
    scene.environment.ambient = 0.0F;
    const std::vector<ShadedLight> lights = lightsOf(scene, scene::evaluate(scene, 0.0));
    const Drawn on = drawnOf(scene, optionsWith(true, 1.0F), smallEye(), lights);
    const Drawn off = drawnOf(scene, optionsWith(false, 1.0F), smallEye(), lights);
    EXPECT_EQ(on.picture.linear.values, off.picture.linear.values);
    ASSERT_EQ(on.picture.masks.size(), lights.size());
    for (std::size_t i = 0; i < lights.size(); ++i) {
        EXPECT_EQ(on.picture.masks[i].values, off.picture.masks[i].values);
    }
}

TEST(AmbientOcclusion, IsThereAtEverySizeAndTheSameEachTime)
{
    const scene::Scene scene = smallScene();
    const std::vector<ShadedLight> lights = lightsOf(scene, scene::evaluate(scene, 0.0));
    for (const auto& [width, height] : {std::pair{1U, 3U}, std::pair{101U, 67U}, std::pair{64U, 48U}}) {
        for (const AntiAliasing smooth : {AntiAliasing::none, AntiAliasing::ssaa4}) {
            RenderOptions options = optionsWith(true, 1.0F);
            options.width = width;
            options.height = height;
            options.anti_aliasing = smooth;
            const Drawn on = drawnOf(scene, options, smallEye(), lights);
            EXPECT_TRUE(on.passes.contains("ambient occlusion") && on.passes.contains("occlusion blur"));
            EXPECT_TRUE(on.memory.contains("ambient occlusion"));
            EXPECT_EQ(on.picture.linear.values, drawnOf(scene, options, smallEye(), lights).picture.linear.values);
            options.ambient_occlusion.on = false;
            const Drawn off = drawnOf(scene, options, smallEye(), lights);
            EXPECT_FALSE(off.passes.contains("ambient occlusion"));
            EXPECT_FALSE(off.memory.contains("ambient occlusion"));
            EXPECT_TRUE(width == 1 || on.picture.linear.values != off.picture.linear.values);
        }
    }
}

TEST(AmbientOcclusion, IsOfDeferredShadingAndOfLightFromTheSky)
{
    const scene::Scene scene = smallScene();
    RenderOptions forward = optionsWith(true);
    forward.shading = Shading::forward;
    RenderOptions phong = optionsWith(true);
    phong.reflection = Reflection::phong_2005;
    for (const RenderOptions& options : {forward, phong}) {
        const Drawn drawn = drawnOf(scene, options, smallEye());
        EXPECT_FALSE(drawn.passes.contains("ambient occlusion"));
        EXPECT_FALSE(drawn.memory.contains("ambient occlusion"));
    }
}

TEST(AmbientOcclusion, RefusesRadiiThatAreNone)
{
    const scene::Scene scene = cornerScene(false, 0.5F);
    for (const float radius_m : {-1.0F, 1e7F, std::numeric_limits<float>::quiet_NaN()}) {
        EXPECT_THROW((void)drawnOf(scene, optionsWith(true, radius_m), lookingDown()), Error);
    }
}

} // namespace
} // namespace gnomon::host::test
