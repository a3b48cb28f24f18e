// SPDX-License-Identifier: Apache-2.0
// The density of maps where it can be computed by hand: a plane seen from straight above.
#include "lab/texel_density.h"

#include "lab/score/traffic.h"

#include <gnomon/planner.h>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace gnomon::lab {
namespace {

constexpr std::uint32_t kSide_px = 32;
constexpr double kFov_rad = 0.6;

/// The plane y = 0 from straight above, every pixel the same square of it.
struct Above {
    explicit Above(double pixel_m)
    {
        const double height = pixel_m * kSide_px / (2.0 * std::tan(kFov_rad / 2.0));
        const host::Eye eye{.position_ws = {0.0, height, 0.0},
                            .target_ws = {0.0, 0.0, 0.0},
                            .up_ws = {0.0, 0.0, -1.0},
                            .fov_y_rad = kFov_rad,
                            .near_m = height / 10.0,
                            .far_m = height * 10.0};
        camera = host::cameraOf(eye, kSide_px, kSide_px, {});
        const glm::dvec4 clip = camera.clip_from_world * glm::dvec4(0.0, 0.0, 0.0, 1.0);
        picture.depth = ImageF(kSide_px, kSide_px, 1, static_cast<float>(clip.z / clip.w));
        picture.normals = ImageF(kSide_px, kSide_px, 3);
        for (std::uint32_t i = 0; i < kSide_px * kSide_px; ++i) {
            picture.normals.values[std::size_t{i} * 3 + 1] = 1.0F;
        }
        all = countAll(kSide_px, kSide_px);
    }
    Camera camera;
    host::Picture picture;
    Counted all;
};

/// A map under a parallel light that falls by `tilt_rad` from the vertical, towards +x. The map is turned by `turn_rad`
/// about the light's axis; its middle is at the origin.
Plan planOf(double tilt_rad, double turn_rad, glm::dvec2 texel_m, std::uint32_t width, std::uint32_t height)
{
    const glm::dvec3 forward(std::sin(tilt_rad), -std::cos(tilt_rad), 0.0);
    const glm::dvec3 along(std::cos(tilt_rad), std::sin(tilt_rad), 0.0);
    const glm::dvec3 across(0.0, 0.0, 1.0);
    const glm::dvec3 x = along * std::cos(turn_rad) + across * std::sin(turn_rad);
    const glm::dvec3 y = across * std::cos(turn_rad) - along * std::sin(turn_rad);
    const glm::dvec3 rows[] = {x * 2.0 / (texel_m.x * width), y * 2.0 / (texel_m.y * height), forward * 1e-3};
    View view;
    view.projection.clip_from_world = glm::dmat4(1.0);
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
            view.projection.clip_from_world[column][row] = rows[row][column];
        }
    }
    view.projection.clip_from_world[3][2] = 0.5;
    view.place.tile = {.width = width, .height = height};
    Plan plan;
    plan.views.push_back(view);
    plan.lights.push_back({.first_view = 0, .view_count = 1});
    return plan;
}

void expectDensity(const Above& above, const Plan& plan, double expected)
{
    const TexelDensity density = texelDensity(above.picture, above.all, above.camera, plan, 0, 1.0);
    const double tolerance = expected * 1e-4; // of depth in single precision
    EXPECT_NEAR(density.p01, expected, tolerance);
    EXPECT_NEAR(density.p50, expected, tolerance);
    EXPECT_NEAR(density.p99, expected, tolerance);
    EXPECT_EQ(density.counted, kSide_px * kSide_px);
    EXPECT_EQ(density.left_out, 0U);
    EXPECT_NEAR(*density.map.pixel(3, 29), expected, tolerance);
}

TEST(TexelDensity, UnderALightFromAboveIsPixelOverTexel)
{
    for (const double pixel_m : {0.02, 0.1, 1.5}) {
        for (const double turn : {0.0, 0.4, 1.1}) {
            SCOPED_TRACE(testing::Message() << pixel_m << " m, turned by " << turn);
            expectDensity(Above(pixel_m), planOf(0.0, turn, {0.05, 0.05}, 2048, 2048), pixel_m / 0.05);
        }
    }
}

TEST(TexelDensity, TakesTheTexelsLongerSide)
{
    const Above above(0.1);
    expectDensity(above, planOf(0.0, 0.0, {0.2, 0.05}, 256, 256), 0.5);
    expectDensity(above, planOf(0.0, 0.7, {0.05, 0.2}, 256, 256), 0.5);
}

TEST(TexelDensity, ASlantedLightStretchesTexels)
{
    // At 60 degrees from the vertical a texel covers twice its width of the ground.
    expectDensity(Above(0.1), planOf(glm::radians(60.0), 0.0, {0.05, 0.05}, 512, 512), 1.0);
}

TEST(TexelDensity, OfFacingSurfacesKnowsNoSlant)
{
    const Above above(0.1);
    for (const double tilt_deg : {0.0, 30.0, 60.0}) {
        const auto densityOf = [&](glm::dvec2 texel_m) {
            const Plan plan = planOf(glm::radians(tilt_deg), 0.3, texel_m, 1024, 1024);
            return texelDensity(above.picture, above.all, above.camera, plan, 0, 1.0).facing;
        };
        const FacingDensity twice = densityOf({0.05, 0.05});
        EXPECT_NEAR(twice.p50, 2.0, 0.05) << "farther from the middle a pixel's rays are longer";
        EXPECT_EQ(twice.one_to_four, 1.0);
        EXPECT_EQ(densityOf({0.2, 0.05}).one_to_four, 0.0) << "the longer side counts";
        EXPECT_EQ(densityOf({0.02, 0.02}).one_to_four, 0.0) << "five are too many";
    }
}

// Below the lamp at angle a from the axis a texel of the disc is 2 / (1 + tan(a/2)^2) radians wide.
TEST(TexelDensity, OfAParaboloidIsThatOfItsPlaces)
{
    constexpr double kHeight_m = 2.0;
    constexpr std::uint32_t kSide = 256;
    const double pixel_m = 0.2;
    const Above above(pixel_m);
    View view;
    view.projection.paraboloid = true;
    view.projection.parallel = false;
    view.serves.sector.w = {0.0, -1.0, 0.0, kHeight_m};
    view.projection.clip_from_world =
        glm::transpose(glm::dmat4({1, 0, 0, 0}, {0, 0, 1, 0}, {0, -1, 0, kHeight_m}, {0, 0, 0, 1.0 / 0.9}));
    view.place.tile = {.width = kSide, .height = kSide};
    Plan plan;
    plan.views.push_back(view);
    plan.lights.push_back({.first_view = 0, .view_count = 1});
    const TexelDensity density = texelDensity(above.picture, above.all, above.camera, plan, 0, 1.0);
    EXPECT_EQ(density.left_out, 0U);
    const double away_m = 15.5 * pixel_m; // along x, the way in which the floor leaves the lamp
    const double angle = std::atan(away_m / kHeight_m);
    const double half = std::cos(0.5 * angle);
    const double texels_per_radian = 0.9 * 0.5 * kSide * 0.5 / (half * half);
    const double radians_per_m = std::cos(angle) * std::cos(angle) / kHeight_m;
    const double expected = texels_per_radian * radians_per_m * pixel_m;
    EXPECT_NEAR(*density.map.pixel(31, 15), expected, 0.02 * expected);
    EXPECT_NEAR(*density.map.pixel(0, 16), expected, 0.02 * expected);
    EXPECT_GT(fitEfficiency(above.picture, above.all, above.camera, plan, 0, 0.5), 0.0);
}

TEST(TexelDensity, LeavesOutWhatDoesNotCountAndWhatNoMapHas)
{
    Above above(0.1);
    for (std::uint32_t x = 0; x < kSide_px; ++x) {
        *above.picture.depth.pixel(x, 0) = 0.0F; // background: not even left out
        *above.all.pixel(x, 1) = 0;
    }
    // A map of half the picture's width: 16 columns of pixels.
    const TexelDensity half = texelDensity(above.picture, above.all, above.camera,
                                           planOf(0.0, 0.0, {0.05, 0.05}, kSide_px, 4 * kSide_px), 0, 0.5);
    EXPECT_EQ(half.counted, 16U * 30U);
    EXPECT_EQ(half.left_out, 32U + 16U * 30U);
    EXPECT_EQ(*half.map.pixel(2, 16), 0.0F);
    EXPECT_GT(*half.map.pixel(16, 16), 0.0F);

    Plan none = planOf(0.0, 0.0, {0.05, 0.05}, 64, 64);
    none.lights[0].outcome.kind = OutcomeKind::no_caster;
    const TexelDensity without = texelDensity(above.picture, above.all, above.camera, none, 0, 0.5);
    EXPECT_EQ(without.counted, 0U);
    EXPECT_EQ(without.left_out, 31U * 32U);
    EXPECT_EQ(without.p50, 0.0);
    EXPECT_EQ(fitEfficiency(above.picture, above.all, above.camera, none, 0, 0.5), 0.0);
}

double efficiencyOf(const Above& above, const Plan& plan, double reach_texels)
{
    return fitEfficiency(above.picture, above.all, above.camera, plan, 0, reach_texels);
}

TEST(FitEfficiency, IsTheShareOfTexelsWithinReachOfSomePixel)
{
    // 32 x 32 pixels of 4 m on texels of 1 m.
    const Above sparse(4.0);
    const Plan plan = planOf(0.0, 0.0, {1.0, 1.0}, 256, 256);
    const double texels = 256.0 * 256.0;
    Plan shifted = plan; // away from texel borders, where rounding would decide
    shifted.views[0].projection.clip_from_world[3] += glm::dvec4(0.3 / 128.0, 0.3 / 128.0, 0.0, 0.0);
    EXPECT_DOUBLE_EQ(efficiencyOf(sparse, shifted, 0.5), 1024.0 / texels);        // the texel itself
    EXPECT_DOUBLE_EQ(efficiencyOf(sparse, shifted, 1.0), 1024.0 * 4.0 / texels);  // 2 x 2
    EXPECT_DOUBLE_EQ(efficiencyOf(sparse, shifted, 2.0), 1024.0 * 16.0 / texels); // 4 x 4: all of 128 x 128
    EXPECT_DOUBLE_EQ(efficiencyOf(sparse, shifted, 3.0), 130.0 * 130.0 / texels); // they overlap
    EXPECT_DOUBLE_EQ(efficiencyOf(sparse, shifted, 40.0), 204.0 * 204.0 / texels);
}

TEST(FitEfficiency, CountsATexelOnceAndStaysInTheTile)
{
    const Above dense(0.05); // 20 pixels to a texel; all of them within 0.8 texels of the map's middle
    const Plan plan = planOf(0.0, 0.0, {1.0, 1.0}, 64, 64);
    EXPECT_DOUBLE_EQ(efficiencyOf(dense, plan, 0.5), 4.0 / 4096.0);
    EXPECT_DOUBLE_EQ(efficiencyOf(dense, plan, 31.0), 1.0);
    EXPECT_EQ(efficiencyOf(dense, plan, 1000.0), 0.0); // the tile has no place for such a filter
    Above none(0.05);
    none.all = Counted(kSide_px, kSide_px, 1);
    EXPECT_EQ(efficiencyOf(none, plan, 0.5), 0.0);
}

TEST(FitEfficiency, WhatTheMaskDoesNotTakeFromAMapIsNotInIt)
{
    // A pixel to a texel and a tile as large as the picture: the outer pixels are half a texel from the tile's edge.
    Above above(1.0);
    Plan plan = planOf(0.0, 0.0, {1.0, 1.0}, kSide_px, kSide_px);
    const auto countedWith = [&](double reach_texels) {
        return texelDensity(above.picture, above.all, above.camera, plan, 0, reach_texels).counted;
    };
    EXPECT_EQ(countedWith(0.5), kSide_px * kSide_px);
    EXPECT_EQ(countedWith(0.9), kSide_px * kSide_px);
    EXPECT_EQ(countedWith(1.1), (kSide_px - 2) * (kSide_px - 2)); // 3 x 3 texels would have one outside
    EXPECT_EQ(countedWith(2.1), (kSide_px - 4) * (kSide_px - 4));
    EXPECT_EQ(countedWith(17.0), 0U);
    // Those that are left reach every texel.
    const TexelUse use = texelUse({above.camera, above.picture.depth, above.picture.normals}, above.all, plan, 0, 1.1);
    EXPECT_EQ(use.held, 1024U);
    EXPECT_EQ(use.read, 1024U);
    // A second map takes over where the first one ends.
    plan.views.push_back(planOf(0.0, 0.0, {2.0, 2.0}, kSide_px, kSide_px).views[0]);
    plan.lights[0].view_count = 2;
    const TexelDensity both = texelDensity(above.picture, above.all, above.camera, plan, 0, 1.1);
    EXPECT_EQ(both.counted, kSide_px * kSide_px);
    EXPECT_NEAR(*both.map.pixel(1, 1), 1.0, 1e-4);
    EXPECT_NEAR(*both.map.pixel(0, 1), 0.5, 1e-4);
}

/// A sun between two positions, whose maps have one texel and two to a pixel.
TEST(FitEfficiency, OfTwoPositionsTakesThoseThatAreRead)
{
    const Above above(1.0);
    const Sight seen{above.camera, above.picture.depth, above.picture.normals};
    Plan plan = planOf(0.0, 0.0, {1.0, 1.0}, 64, 64);
    plan.views.push_back(planOf(0.0, 0.0, {0.5, 0.5}, 128, 128).views[0]);
    for (View& view : plan.views) { // off the texels' edges
        view.projection.clip_from_world[3] +=
            glm::dvec4(0.3 / view.place.tile.width, 0.3 / view.place.tile.width, 0.0, 0.0);
    }
    plan.views[0].serves.sun = SunPosition::earlier;
    plan.views[1].serves.sun = SunPosition::later;
    plan.lights[0].view_count = 2;
    SunSteps& steps = plan.lights[0].steps;
    steps.stepping = true;
    steps.paired = true;
    constexpr std::uint64_t kPixels = kSide_px * kSide_px;
    const auto read = [&] {
        return texelUse(seen, above.all, plan, 0, 0.5).read;
    };
    const auto density = [&] {
        return texelDensity(seen, above.all, plan, 0, 0.5).p50;
    };
    steps.share = 0.3;
    EXPECT_EQ(read(), 2 * kPixels);
    EXPECT_EQ(texelUse(seen, above.all, plan, 0, 0.5).held, 64U * 64U + 128U * 128U);
    EXPECT_NEAR(density(), 1.0, 1e-4);
    steps.share = 0.7;
    EXPECT_NEAR(density(), 2.0, 1e-4);
    steps.share = 0.0;
    EXPECT_EQ(read(), kPixels);
    steps.band = 0.25; // in the middle of the picture
    steps.edge = 0.625;
    steps.share = 0.5;
    EXPECT_EQ(read(), kPixels + kPixels / 4);
    steps.band = 0.0;
    steps.alternate = true;
    steps.read = SunPosition::later;
    EXPECT_EQ(read(), kPixels);
    EXPECT_NEAR(density(), 2.0, 1e-4);
    steps.read = SunPosition::earlier;
    EXPECT_NEAR(density(), 1.0, 1e-4);
}

TEST(LeastBytes, AreWhatIsWrittenAndReadOnce)
{
    const Above above(4.0); // of 4 m a pixel, on texels of 1 m: no texel is read twice by 2 x 2
    const Sight seen{above.camera, above.picture.depth, above.picture.normals};
    Plan plan = planOf(0.0, 0.0, {1.0, 1.0}, 256, 256);
    plan.views[0].projection.clip_from_world[3] += glm::dvec4(0.3 / 128.0, 0.3 / 128.0, 0.0, 0.0);
    plan.mask_layers = 1;
    std::vector<Light> lights(1); // straight down
    const std::uint64_t pixels = kSide_px * kSide_px;
    const std::uint64_t drawn = 256 * 256;
    TrafficOptions options{.format = MapFormat::d32f, .reach_texels = 0.5};
    EXPECT_EQ(leastBytes(seen, lights, plan, options), 4 * (drawn + pixels) + pixels * (4 + 4 + 4 + 1));
    options.reads_object_ids = false;
    EXPECT_EQ(leastBytes(seen, lights, plan, options), 4 * (drawn + pixels) + pixels * (4 + 4 + 1));
    options.reach_texels = 1.0;
    EXPECT_EQ(leastBytes(seen, lights, plan, options), 4 * (drawn + 4 * pixels) + pixels * 9);
    options.format = MapFormat::d16;
    EXPECT_EQ(leastBytes(seen, lights, plan, options), 2 * (drawn + 4 * pixels) + pixels * 9);
    options.samples = 4;
    EXPECT_EQ(leastBytes(seen, lights, plan, options), 2 * (drawn + 4 * pixels) + 4 * pixels * 9);
    options.samples = 1;
    // A map that still holds is read and not written.
    plan.views[0].contents.redraw = false;
    EXPECT_EQ(leastBytes(seen, lights, plan, options), 2 * (drawn + 4 * pixels) + pixels * 9);
    options.redraws_all = false;
    EXPECT_EQ(leastBytes(seen, lights, plan, options), 2 * 4 * pixels + pixels * 9);
    // A map that is restored and drawn over in part counts by that part, and its kept layer if that is drawn too.
    plan.views[0].contents.redraw = true;
    plan.views[0].contents.kept_layer = 0;
    plan.views[0].contents.dirty = {0, 0, 4, 5};
    EXPECT_EQ(leastBytes(seen, lights, plan, options), 2 * (20 + 4 * pixels) + pixels * 9);
    plan.views[0].contents.redraw_kept = true;
    EXPECT_EQ(leastBytes(seen, lights, plan, options), 2 * (20 + drawn + 4 * pixels) + pixels * 9);
    plan.views[0].contents.kept_layer = kNoIndex;
    plan.views[0].contents.redraw = false;
    // Pixels that face away from the light read nothing, and neither do those of a light without a map; the mask is
    // written.
    lights[0].direction_ws = {0.0, 1.0, 0.0};
    EXPECT_EQ(leastBytes(seen, lights, plan, options), pixels * 9);
    lights[0].direction_ws = {0.0, -1.0, 0.0};
    plan.lights[0].outcome.kind = OutcomeKind::no_caster;
    EXPECT_EQ(leastBytes(seen, lights, plan, options), pixels * 9);
    // Five lights are two layers of four bytes.
    lights.resize(5);
    plan.lights.resize(5, plan.lights[0]);
    plan.mask_layers = 2;
    EXPECT_EQ(leastBytes(seen, lights, plan, options), pixels * 16);
    EXPECT_EQ(leastBytes(seen, {}, Plan(), options), 0U); // without shadows
}

TEST(LeastBytes, OfAFilterableMapAreThoseOfItsLayersAndLevels)
{
    const Above above(4.0);
    const Sight seen{above.camera, above.picture.depth, above.picture.normals};
    Plan plan = planOf(0.0, 0.0, {1.0, 1.0}, 256, 256);
    plan.views[0].projection.clip_from_world[3] += glm::dvec4(0.3 / 128.0, 0.3 / 128.0, 0.0, 0.0);
    plan.mask_layers = 1;
    const std::vector<Light> lights(1);
    const std::uint64_t pixels = kSide_px * kSide_px;
    TrafficOptions options{.format = MapFormat::rgba16, .reach_texels = 0.5, .image_layers = 2};
    EXPECT_EQ(leastBytes(seen, lights, plan, options), 8 * (2 * 256 * 256 + pixels) + pixels * 13);
    options.mip_levels = 3;
    const std::uint64_t levels = 256 * 256 + 128 * 128 + 64 * 64;
    EXPECT_EQ(leastBytes(seen, lights, plan, options), 8 * (2 * levels + pixels) + pixels * 13);
    // A tile whose edge lies within a texel of level 2 has no such level.
    plan.views[0].place.tile.height = 254;
    options.mip_levels = 9;
    const std::uint64_t two = 256 * 254 + 128 * 127;
    const std::uint64_t with_two = leastBytes(seen, lights, plan, options);
    options.mip_levels = 1;
    EXPECT_EQ(with_two - leastBytes(seen, lights, plan, options), 8 * 2 * (two - 256 * 254));
}

TEST(FacingPixels, KnowTheBackgroundOfOrdinaryDepth)
{
    Above above(0.1);
    // z from 0 at the near plane to 1 at the far one: what was drawn at z is now at w - z.
    above.camera.reversed_z = false;
    for (int column = 0; column < 4; ++column) {
        above.camera.clip_from_world[column][2] =
            above.camera.clip_from_world[column][3] - above.camera.clip_from_world[column][2];
    }
    for (float& depth : above.picture.depth.values) {
        depth = 1.0F - depth;
    }
    *above.picture.depth.pixel(5, 5) = 1.0F;
    Light lamp;
    lamp.type = LightType::spot;
    lamp.position_ws = {0.0, 0.1, 0.0};
    const Counted lit = facingPixels(above.picture, above.camera, lamp);
    EXPECT_EQ(*lit.pixel(16, 20), 1);
    EXPECT_EQ(*lit.pixel(5, 5), 0); // background
    EXPECT_EQ(*lit.pixel(0, 0), 0); // 2.19 m away: the points are where they were
    EXPECT_EQ(*lit.pixel(0, 16), 1);
}

TEST(FacingPixels, AreThoseWhoseSurfaceFacesTheLight)
{
    Above above(0.1);
    Light sun;
    sun.direction_ws = glm::normalize(glm::dvec3(1.0, -0.06, 0.0)); // N·L is 0.06
    EXPECT_EQ(facingPixels(above.picture, above.camera, sun).values, above.all.values);
    sun.direction_ws = glm::normalize(glm::dvec3(1.0, -0.04, 0.0));
    EXPECT_EQ(facingPixels(above.picture, above.camera, sun).values, Counted(kSide_px, kSide_px, 1).values);

    Light lamp;
    lamp.type = LightType::spot;
    lamp.position_ws = {0.0, 0.1, 0.0}; // faced within 2 m, where the height is 0.05 of the distance
    *above.picture.depth.pixel(16, 16) = 0.0F;
    const Counted lit = facingPixels(above.picture, above.camera, lamp);
    EXPECT_EQ(*lit.pixel(16, 16), 0); // background
    EXPECT_EQ(*lit.pixel(16, 20), 1);
    EXPECT_EQ(*lit.pixel(0, 0), 0); // 2.19 m away
    EXPECT_EQ(*lit.pixel(0, 16), 1);
}

} // namespace
} // namespace gnomon::lab
