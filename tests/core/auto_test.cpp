// SPDX-License-Identifier: Apache-2.0
// Partition and fit `auto`: what is predicted is what a map has, the best is taken, and it does not flicker.
#include "fit_stage.h"

#include "auto/sight.h"
#include "auto/warp_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace gnomon {
namespace {

using test::FitStage;
using test::Stage;

constexpr std::uint32_t kSide = 2048;
constexpr double kBorder_texels = 4.0;

Frame frameOf(const Stage& stage)
{
    Frame frame;
    frame.camera = stage.camera;
    frame.lights = std::span(&stage.light, 1);
    frame.objects = &stage.set;
    return frame;
}

ShadowOptions automatic(Quality quality = Quality::balanced)
{
    ShadowOptions options{.technique = kPlainTechnique};
    options.technique.partition = Partition::automatic;
    options.technique.fit = Fit::automatic;
    options.quality = quality;
    return options;
}

/// Ground seen from 1.7 m above it, or more.
Stage meadow(double height_m, double pitch_rad)
{
    Stage stage = test::levelGround();
    stage.light = test::sun({0.4, -1, 0.3});
    const glm::dvec3 eye(0, height_m, 0);
    stage.camera = test::perspectiveCamera(eye, eye + glm::dvec3(0, -std::sin(pitch_rad), -std::cos(pitch_rad)),
                                           glm::radians(60.0), 1.6, 0.1, 200.0);
    return stage;
}

/// A row of pixels y below the horizon sees level ground at z = f h / y, f being the picture's focal length in pixels.
TEST(AutoSight, StepsOfPixelsOnLevelGroundAreThoseOfTheClosedForm)
{
    const Stage stage = meadow(1.7, 0.0);
    const FitStage fit(stage);
    Frame frame = frameOf(stage);
    frame.size_px = {1280, 800};
    Sight sight;
    sight.look(frame, fit.view, fit.seen);
    const double focal_px = 400.0 / std::tan(glm::radians(30.0));
    int on_ground = 0;
    for (const SightPoint& point : sight.points()) {
        if (std::abs(point.p_ws.y) > 1e-6)
            continue; // the box on the ground
        ++on_ground;
        const double row = focal_px * 1.7 / point.depth_m;
        EXPECT_NEAR(glm::length(point.right_ws), point.depth_m / focal_px, 1e-6 * point.depth_m);
        const double below_m = focal_px * 1.7 / (row + 0.5);
        EXPECT_NEAR(point.down_ws.z, (point.depth_m - below_m) / 0.5, 1e-6 * point.depth_m); // it looks along -z
        EXPECT_NEAR(point.pixel_m, std::sqrt(glm::length(point.right_ws) * glm::length(point.down_ws)), 1e-12);
    }
    EXPECT_EQ(on_ground, Sight::kColumns * Sight::kRows / 2) << "the lower half of the picture is ground";
}

/// The Jacobian that candidates are ranked by, against differences of the matrix that a map would be drawn by.
TEST(AutoPrediction, IsTheJacobianOfTheMapsOwnMatrix)
{
    for (const Light& light : {test::sun({0.4, -1, 0.3}), test::spot({3, 30, -20}, {0.1, -1, 0.2}, 1.0)}) {
        Stage stage = meadow(1.7, 0.2);
        stage.light = light;
        const FitStage fit(stage);
        ASSERT_TRUE(fit.found);
        Sight sight;
        sight.look(frameOf(stage), fit.view, fit.seen);
        std::vector<LitPoint> lit;
        lightPoints(fit.space, sight.points(), {}, {}, lit);
        ASSERT_GT(lit.size(), 20U);
        for (const double strength : {1.0, 3.0, 15.0}) {
            const Warp warp = warpOfStrength(fit.input(), slopeOfBody(fit.input()), strength);
            EXPECT_EQ(warp.warped(), strength > 1.0);
            const MapFrame frame = gnomon::frameOf(rectOf(warp, fit.region.outline()), 0.01, kSide, kBorder_texels);
            View view;
            view.projection.clip_from_world = clipFromWorld(fit.space, warp, frame, 1.0, 500.0);
            std::size_t next = 0;
            for (const SightPoint& point : sight.points()) {
                std::vector<LitPoint> one;
                lightPoints(fit.space, std::span(&point, 1), {}, {}, one);
                if (one.empty())
                    continue;
                const glm::dmat2 told = texelFromPixel(lit[next++], warp, frame);
                const glm::dmat2 steps = test::mapSteps(view, point.p_ws, point.right_ws, point.down_ws);
                for (int pixel = 0; pixel < 2; ++pixel) {
                    const double length = glm::length(steps[pixel]) * kSide * 0.5;
                    EXPECT_NEAR(std::abs(told[pixel].x), std::abs(steps[pixel].x) * kSide * 0.5, 1e-4 * length);
                    EXPECT_NEAR(std::abs(told[pixel].y), std::abs(steps[pixel].y) * kSide * 0.5, 1e-4 * length);
                }
            }
        }
    }
}

/// Tries all strengths by hand: none errs noticeably less than the one that is found.
TEST(AutoPrediction, TheStrengthFoundIsTheBestOne)
{
    for (const double height_m : {1.7, 6.0, 30.0}) {
        const Stage stage = meadow(height_m, 0.15);
        const FitStage fit(stage);
        Sight sight;
        sight.look(frameOf(stage), fit.view, fit.seen);
        std::vector<LitPoint> lit;
        lightPoints(fit.space, sight.points(), {}, {}, lit);
        const FitInput input = fit.input();
        const WarpTrial trial{input, slopeOfBody(input),         fit.region.rect(), 0.01, kSide, kBorder_texels, lit,
                              {},    300.0 * sight.meanPixel_m()};
        const double found = trial.errorAt(nextStrength(trial, 0.0)).mean();
        double best = 1.0;
        double worst = 0.0;
        for (double strength = 1.0; strength < 200.0; strength *= 1.02) {
            best = std::min(best, trial.errorAt(strength).mean());
            worst = std::max(worst, trial.errorAt(strength).mean());
        }
        EXPECT_LE(found, 1.001 * best / 0.97) << height_m;
        EXPECT_GT(worst, 1.5 * best) << "or any strength would have done";
        EXPECT_LT(found, trial.errorAt(20.0).mean() * 1.001) << "the bound of the other fits";
    }
}

TEST(AutoChoice, SaysWhatItTookAndWhy)
{
    const Stage stage = meadow(1.7, 0.0);
    Planner planner(automatic());
    const Plan& plan = planner.plan(frameOf(stage));
    const AutoChoice& choice = plan.lights[0].choice;
    EXPECT_TRUE(choice.made);
    EXPECT_EQ(plan.lights[0].outcome.kind, OutcomeKind::ok);
    EXPECT_FALSE(choice.reason.empty());
    EXPECT_GT(choice.texels_per_pixel, 0.0);
    EXPECT_GT(choice.error, 0.0);
    EXPECT_GT(choice.other_error, 0.0);
    EXPECT_GT(plan.views[0].fit.strength, 2.0);
    EXPECT_NE(toJson(plan).find("\"auto\": {"), std::string::npos);
    // Nobody asked: nothing is said.
    EXPECT_EQ(toJson(Planner(ShadowOptions{.technique = kPlainTechnique, .map_size = kSide}).plan(frameOf(stage)))
                  .find("\"auto\": {"),
              std::string::npos);
}

/// Whatever was chosen, the light's maps have as many texels as one map of map_size at most.
TEST(AutoChoice, SpendsTheMemoryOfOneMapByEveryQuality)
{
    constexpr std::uint64_t kMost = 64U << 18U; // texels of 4 bytes in 64 MiB
    for (const Quality quality : {Quality::fast, Quality::balanced, Quality::best})
        for (const double pitch : {0.0, 0.3, 1.2}) {
            const Stage stage = meadow(1.7, pitch);
            Planner planner(automatic(quality));
            const Plan& plan = planner.plan(frameOf(stage));
            std::uint64_t texels = 0;
            for (const View& view : plan.views) {
                texels += std::uint64_t{view.place.tile.width} * view.place.tile.height;
                EXPECT_EQ(view.projection.gpu_cascade != kNoIndex, quality == Quality::best);
            }
            EXPECT_LE(texels, kMost);
            EXPECT_GE(plan.views.size(), 1U);
            if (quality != Quality::balanced) {
                EXPECT_EQ(plan.views.size(), 1U);
            }
        }
    // Nobody can hold still what the GPU fits anew in each frame.
    ShadowOptions steady = automatic(Quality::best);
    steady.technique.motion = Motion::snap;
    const Stage stage = meadow(1.7, 0.0);
    Planner planner(steady);
    const Plan& plan = planner.plan(frameOf(stage));
    EXPECT_EQ(plan.lights[0].outcome.kind, OutcomeKind::ok);
    for (const View& view : plan.views)
        EXPECT_EQ(view.projection.gpu_cascade, kNoIndex);
}

/// With map-size auto the texels of all partitions are counted, those that were asked for by name too.
TEST(AutoChoice, SpendsNoMoreThanItsTexels)
{
    for (const std::uint32_t texels : {1024U, 65536U, 1000000U, 4194304U, 5000000U})
        for (const Partition partition :
             {Partition::automatic, Partition::single, Partition::cascades, Partition::sdsm})
            for (const Motion motion : {Motion::free, Motion::snap}) {
                if (partition == Partition::sdsm && motion == Motion::snap)
                    continue; // refused
                ShadowOptions options = automatic();
                options.technique.partition = partition;
                options.technique.motion = motion;
                options.max_texels = texels;
                const Stage stage = meadow(1.7, 0.1);
                Planner planner(options);
                const Plan& plan = planner.plan(frameOf(stage));
                ASSERT_FALSE(plan.views.empty());
                std::uint64_t spent = 0;
                for (const View& view : plan.views)
                    spent += std::uint64_t{view.place.tile.width} * view.place.tile.height;
                EXPECT_LE(spent, texels);
                EXPECT_GE(spent, texels * 4 / 10) << "or it would be left lying";
            }
}

TEST(AutoSize, IsHalvedToAnEighthOfAPixelAndKeptToASixth)
{
    EXPECT_EQ(halvingsFor(0.2, std::nullopt), 0U);
    EXPECT_EQ(halvingsFor(0.07, std::nullopt), 0U);
    EXPECT_EQ(halvingsFor(0.06, std::nullopt), 1U);
    EXPECT_EQ(halvingsFor(0.06, 0), 1U);
    EXPECT_EQ(halvingsFor(0.08, 1), 1U) << "0.16 of a pixel";
    EXPECT_EQ(halvingsFor(0.09, 1), 0U) << "0.18";
    EXPECT_EQ(halvingsFor(0.001, std::nullopt), 3U);
    EXPECT_EQ(halvingsFor(std::numeric_limits<double>::infinity(), 2), 0U) << "light along a wall";
}

TEST(AutoSize, IsTheLeastProductOfRmseAndTime)
{
    const BySize shares{1.0, 4.0, 16.0, 64.0}; // each halving doubles rmse
    EXPECT_EQ(halvingsByTime(shares, {1.9, 1.0, 1.0, 1.0}, std::nullopt), 0U) << "less than twice the time";
    EXPECT_EQ(halvingsByTime(shares, {8.4, 4.1, 1.9, 1.0}, std::nullopt), 2U);
    EXPECT_EQ(halvingsByTime(shares, {2.1, 1.0, 1.0, 1.0}, 0), 0U) << "kept: a twentieth is no reason to draw anew";
    EXPECT_EQ(halvingsByTime(shares, {2.3, 1.0, 1.0, 1.0}, 0), 1U);
    EXPECT_EQ(halvingsByTime({1.0, 1.0, 1.0, 1.0}, {4.0, 3.0, 2.0, 1.0}, std::nullopt), 3U) << "all are fine enough";
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(halvingsByTime(shares, {nan, nan, nan, nan}, std::nullopt), 0U) << "a host's rates are no numbers";
}

TEST(AutoSize, FollowsTheRatesOfTheDeviceAndTheMemoryThatThereIs)
{
    Stage stage = meadow(1.7, 0.3);
    ShadowOptions options = automatic();
    options.technique.partition = Partition::single;
    const auto planned = [&](const DeviceRates& rates) {
        Frame frame = frameOf(stage);
        frame.rates = rates;
        Planner planner(options);
        return planner.plan(frame);
    };
    const auto sideBy = [&](const DeviceRates& rates) {
        return planned(rates).views.at(0).place.tile.width;
    };
    DeviceRates free = ratesOf(RateSource::gpu);
    free.texel_ns = 0.0;
    DeviceRates dear = free;
    dear.texel_ns = 1e6;
    EXPECT_EQ(sideBy(free), 4096U);
    EXPECT_EQ(sideBy(dear), 512U);
    const AutoChoice choice = planned(ratesOf(RateSource::software)).lights[0].choice;
    EXPECT_EQ(choice.rates, RateSource::software);
    EXPECT_GT(choice.time_ms, 0.0);
    options.quality = Quality::best;
    options.technique.motion = Motion::free;
    EXPECT_EQ(sideBy(dear), 4096U) << "best leaves time out";
    options.quality = Quality::balanced;
    options.sun_memory_mib = 4.0;
    options.lamp_memory_mib = 4.0;
    EXPECT_EQ(sideBy(free), 1024U);
    options.max_texels = 2048 * 2048;
    EXPECT_EQ(sideBy(dear), 2048U) << "texels that were asked for are spent";
}

/// A lamp over the ground, so far off that its light covers few pixels.
Stage lampAt(double distance_m)
{
    Stage stage = test::levelGround();
    stage.light = test::spot({0, 6, 0}, {0.0, -1, 0.0}, 1.0);
    stage.camera = test::perspectiveCamera({0, 0.7 * distance_m, distance_m}, {0, 0, 0}, glm::radians(45.0), 16.0 / 9,
                                           0.1, 1000.0);
    return stage;
}

TEST(AutoSize, OfALampFarOffIsSmallAndDoesNotFlicker)
{
    ShadowOptions options{.technique = kPlainTechnique};
    const auto sideAt = [&](Planner& planner, const Stage& stage) {
        Frame frame = frameOf(stage);
        const Plan& plan = planner.plan(frame);
        EXPECT_EQ(plan.views.size(), 1U);
        EXPECT_EQ(plan.views.at(0).place.tile.width, kSide >> plan.lights[0].choice.halvings);
        return plan.views.at(0).place.tile.width;
    };
    const auto freshSideAt = [&](double distance_m) {
        Planner planner(options);
        return sideAt(planner, lampAt(distance_m));
    };
    EXPECT_EQ(freshSideAt(8.0), kSide) << "16 MiB";
    EXPECT_LT(freshSideAt(120.0), kSide);
    Planner told(options);
    EXPECT_LT(sideAt(told, lampAt(120.0)), kSide);
    Stage own = lampAt(120.0);
    own.light.map_size = kSide;
    EXPECT_EQ(sideAt(told, own), kSide) << "a light's own side is no choice";
    ShadowOptions given = options;
    given.map_size = kSide;
    Planner fixed(given);
    EXPECT_EQ(sideAt(fixed, lampAt(250.0)), kSide);
    Planner kept(options);
    std::uint32_t last = 0;
    int changes = 0;
    for (int frame = 0; frame < 400; ++frame) {
        test::Random random(static_cast<std::uint64_t>(frame));
        const std::uint32_t side = sideAt(kept, lampAt((8.0 + 0.8 * frame) * random.uniform(0.98, 1.02)));
        changes += side != last ? 1 : 0;
        last = side;
    }
    EXPECT_LT(last, kSide) << "also where no ray meets its light any more";
    EXPECT_LE(changes, 8);
}

TEST(AutoChoice, AFrameThatComesAgainDrawsNothing)
{
    const Stage stage = meadow(1.7, 0.1);
    Planner planner(automatic());
    (void)planner.plan(frameOf(stage));
    for (int again = 0; again < 3; ++again)
        for (const View& view : planner.plan(frameOf(stage)).views)
            EXPECT_FALSE(view.contents.redraw);
}

struct Watched {
    int switches = 0;     // of the partition
    double most_step = 0; // of the logarithm of a warp's strength, while the partition stayed
};

/// Over `frames` frames; a fresh planner in each one shows what would be chosen without any memory.
Watched watch(int frames, bool remembers, const std::function<Stage(int)>& stageAt)
{
    Watched watched;
    Planner kept(automatic());
    Partition last = Partition::automatic;
    double last_strength = 0.0;
    for (int i = 0; i < frames; ++i) {
        const Stage stage = stageAt(i);
        Planner fresh(automatic());
        const Plan& plan = (remembers ? kept : fresh).plan(frameOf(stage));
        const double strength = plan.views[0].fit.strength;
        if (i > 0 && plan.lights[0].choice.partition != last)
            ++watched.switches;
        else if (i > 0 && strength > 1.0 && last_strength > 1.0)
            watched.most_step = std::max(watched.most_step, std::abs(std::log(strength / last_strength)));
        last = plan.lights[0].choice.partition;
        last_strength = strength;
    }
    return watched;
}

/// From high above down to eye height and up again, with a hand that shakes.
Stage shaken(int frame)
{
    test::Random random(static_cast<std::uint64_t>(frame));
    const double t = std::abs(frame - 300) / 300.0;
    return meadow(1.7 * std::pow(60.0, t) * random.uniform(0.97, 1.03), 0.02 + 0.8 * t + random.uniform(-0.02, 0.02));
}

TEST(AutoChoice, AShakenCameraDoesNotMakeItFlicker)
{
    const Watched kept = watch(600, true, shaken);
    const Watched forgetful = watch(600, false, shaken);
    RecordProperty("switches", kept.switches);
    RecordProperty("switches without memory", forgetful.switches);
    EXPECT_LE(kept.switches, 4);
    EXPECT_LE(kept.most_step, 0.03);
    EXPECT_GT(forgetful.most_step, 4.0 * kept.most_step) << "or there was nothing to hold still";
}

TEST(AutoChoice, AfterACutItIsAsGoodAsAnewAtOnce)
{
    const Stage above = meadow(100.0, 1.3);
    const Stage below = meadow(1.7, 0.0);
    Planner planner(automatic(Quality::fast));
    (void)planner.plan(frameOf(above));
    const double after = planner.plan(frameOf(below)).lights[0].choice.error;
    const double anew = Planner(automatic(Quality::fast)).plan(frameOf(below)).lights[0].choice.error;
    EXPECT_LE(after, 1.5 * anew);
}

/// A light that comes back is a new one; others keep theirs.
TEST(AutoChoice, LightsAreRememberedByTheirKeys)
{
    Stage stage = meadow(1.7, 0.1);
    std::vector<Light> lights{test::sun({0.4, -1, 0.3}), test::sun({-0.5, -1, 0.1})};
    lights[0].key = 7;
    lights[1].key = 3;
    Frame frame = frameOf(stage);
    frame.lights = lights;
    Planner planner(automatic());
    const Plan first = planner.plan(frame);
    std::swap(lights[0], lights[1]);
    const Plan& second = planner.plan(frame);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(second.lights[i].choice.error, first.lights[1 - i].choice.error);
        EXPECT_FALSE(second.views[second.lights[i].first_view].contents.redraw);
    }
}

} // namespace
} // namespace gnomon
