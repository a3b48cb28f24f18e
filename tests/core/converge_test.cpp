// SPDX-License-Identifier: Apache-2.0
// The moves of soften=converge from frame to frame, and the plan's account of them.
#include "worlds.h"

#include <gnomon/converge.h>
#include <gnomon/planner.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace gnomon {
namespace {

/// The part of the unit disc on one side of a line at distance t from its middle.
double cutDisc(double t)
{
    return 1.0 - (std::acos(t) - t * std::sqrt(1.0 - t * t)) / std::numbers::pi;
}

/// Error of a run's mean, over edges of all directions and places: `seen` projects a sample onto a disc.
template <class Seen>
double errorOfEdges(std::uint64_t first, std::uint64_t count, const Seen& seen)
{
    double sum = 0.0;
    int edges = 0;
    for (int turn = 0; turn < 24; ++turn) {
        const glm::dvec2 across(std::cos(turn * std::numbers::pi / 12.0), std::sin(turn * std::numbers::pi / 12.0));
        for (double t = -0.9; t < 0.95; t += 0.1, ++edges) {
            std::uint64_t inside = 0;
            for (std::uint64_t i = first; i < first + count; ++i) {
                inside += glm::dot(seen(convergeSample(i)), across) < t ? 1 : 0;
            }
            const double off = static_cast<double>(inside) / static_cast<double>(count) - cutDisc(t);
            sum += off * off;
        }
    }
    return std::sqrt(sum / edges);
}

TEST(ConvergeSample, firstIsTheMiddleOfAll)
{
    const ConvergeSample first = convergeSample(0);
    EXPECT_EQ(first.light, glm::dvec3(0.0));
    EXPECT_EQ(first.grid_texels, glm::dvec2(0.0));
    EXPECT_EQ(first.pixel_px, glm::dvec2(0.0));
}

TEST(ConvergeSample, staysInItsRanges)
{
    for (std::uint64_t i = 0; i < 5000; ++i) {
        const ConvergeSample sample = convergeSample(i * 977);
        EXPECT_LE(glm::length(sample.light), 1.0 + 1e-12);
        for (int axis = 0; axis < 2; ++axis) {
            EXPECT_LE(std::abs(sample.grid_texels[axis]), kMostGridMove_texels);
            EXPECT_LE(std::abs(sample.pixel_px[axis]), 0.5);
        }
    }
}

TEST(ConvergeSample, anyRunCoversTheLightAsSeenFromAnySide)
{
    const auto along_axis = [](const ConvergeSample& sample) {
        return glm::dvec2(sample.light);
    };
    const auto from_side = [](const ConvergeSample& sample) {
        return glm::dvec2(sample.light.z, 0.6 * sample.light.x + 0.8 * sample.light.y);
    };
    EXPECT_LT(errorOfEdges(0, 16, along_axis), 0.05);
    EXPECT_LT(errorOfEdges(0, 32, along_axis), 0.035);
    for (std::uint64_t first = 3; first < 400; first += 41) {
        EXPECT_LT(errorOfEdges(first, 16, along_axis), 0.08) << first;
        EXPECT_LT(errorOfEdges(first, 32, along_axis), 0.05) << first;
        EXPECT_LT(errorOfEdges(first, 256, from_side), 0.02) << first;
    }
}

TEST(ConvergeSample, gridAndPixelAreIndependentOfTheLight)
{
    constexpr int kFrames = 4096;
    glm::dvec2 grid(0.0);
    glm::dvec2 pixel(0.0);
    double together = 0.0;
    for (int i = 0; i < kFrames; ++i) {
        const ConvergeSample sample = convergeSample(static_cast<std::uint64_t>(i));
        grid += sample.grid_texels / double(kFrames);
        pixel += sample.pixel_px / double(kFrames);
        for (int axis = 0; axis < 2; ++axis) {
            together = std::max(together, std::abs(sample.grid_texels[axis] * sample.light[axis]));
        }
    }
    EXPECT_LT(glm::length(grid), 1e-3);
    EXPECT_LT(glm::length(pixel), 1e-3);
    EXPECT_GT(together, 0.4) << "each comes with each";
}

ShadowOptions converging()
{
    ShadowOptions options{.technique = kPlainTechnique};
    options.technique.soften = Soften::converge;
    options.map_size = 256;
    return options;
}

struct Yard {
    ObjectSet set;
    ObjectId ground = set.add(test::boxAt({0, -0.5, 0}, {40, 0.5, 40}), {true, true, false});
    ObjectId tower = set.add(test::boxAt({2, 3, 1}, {0.5, 3, 0.5}), {true, true, false});
    std::vector<Light> lights{test::sun(glm::normalize(glm::dvec3(0.4, -1.0, 0.3)))};
    Frame frame;

    Yard()
    {
        frame.lights = lights;
        frame.objects = &set;
        frame.camera = test::perspectiveCamera({10, 6, 12}, {0, 0, 0}, 0.8);
    }
};

TEST(ConvergingPlan, beginsWithThePlanThatIsNotSoftened)
{
    Yard yard;
    Planner planner(converging());
    ShadowOptions plain = converging();
    plain.technique.soften = Soften::none;
    Planner other(plain);
    const Plan first = planner.plan(yard.frame);
    const Plan expected = other.plan(yard.frame);
    ASSERT_EQ(first.views.size(), 1U);
    EXPECT_TRUE(first.cut);
    EXPECT_EQ(first.views[0].projection.clip_from_world, expected.views[0].projection.clip_from_world);
    EXPECT_FALSE(planner.plan(yard.frame).cut);
    EXPECT_NE(planner.plan(yard.frame).views[0].projection.clip_from_world, first.views[0].projection.clip_from_world);
    yard.frame.cut = true;
    const Plan& again = planner.plan(yard.frame);
    EXPECT_TRUE(again.cut);
    EXPECT_EQ(again.number, 4U);
    EXPECT_EQ(again.views[0].projection.clip_from_world, first.views[0].projection.clip_from_world);
}

TEST(ConvergingPlan, shinesFromTheLightsOwnDiscAndIsDrawnInEachFrame)
{
    Yard yard;
    yard.lights[0].angular_diameter_rad = 0.1;
    Planner planner(converging());
    double widest = 0.0;
    for (int i = 0; i < 40; ++i) {
        const Plan& plan = planner.plan(yard.frame);
        ASSERT_TRUE(plan.lights[0].sample.joined);
        EXPECT_TRUE(plan.views[0].contents.redraw);
        const glm::dvec3 from = plan.lights[0].sample.direction_ws;
        EXPECT_NEAR(glm::length(from), 1.0, 1e-9);
        widest = std::max(widest, std::acos(std::min(glm::dot(from, yard.lights[0].direction_ws), 1.0)));
    }
    EXPECT_LE(widest, 0.05 + 1e-6);
    EXPECT_GT(widest, 0.045);
}

TEST(ConvergingPlan, aLampsSamplesLieInItsSphere)
{
    Yard yard;
    Light lamp;
    lamp.type = LightType::spot;
    lamp.position_ws = {3, 9, 2};
    lamp.direction_ws = glm::normalize(glm::dvec3(-0.2, -1.0, 0.0));
    lamp.radius_m = 0.4;
    yard.lights = {lamp};
    yard.frame.lights = yard.lights;
    Planner planner(converging());
    double farthest = 0.0;
    for (int i = 0; i < 40; ++i) {
        const LightSample& sample = planner.plan(yard.frame).lights[0].sample;
        ASSERT_TRUE(sample.joined);
        EXPECT_EQ(sample.direction_ws, lamp.direction_ws);
        farthest = std::max(farthest, glm::distance(sample.position_ws, lamp.position_ws));
    }
    EXPECT_LE(farthest, 0.4 + 1e-9);
    EXPECT_GT(farthest, 0.3);
}

TEST(ConvergingPlan, tellsWhereSomethingMoved)
{
    Yard yard;
    Planner planner(converging());
    EXPECT_TRUE(planner.plan(yard.frame).moved_ws.empty());
    EXPECT_TRUE(planner.plan(yard.frame).moved_ws.empty()) << "nothing moved";
    const Aabb before = yard.set.bounds(yard.tower);
    yard.set.update(yard.tower, test::boxAt({2.2, 3, 1}, {0.5, 3, 0.5}));
    {
        const Plan& plan = planner.plan(yard.frame);
        ASSERT_EQ(plan.moved_ws.size(), 1U) << "a short way is one box";
        EXPECT_TRUE(plan.moved_ws[0].contains(before));
        EXPECT_TRUE(plan.moved_ws[0].contains(yard.set.bounds(yard.tower)));
    }
    const Aabb there = yard.set.bounds(yard.tower);
    yard.set.update(yard.tower, test::boxAt({-15, 3, 1}, {0.5, 3, 0.5}));
    EXPECT_EQ(planner.plan(yard.frame).moved_ws.size(), 2U) << "where it was, and where it is";
    yard.set.touch(yard.tower);
    EXPECT_EQ(planner.plan(yard.frame).moved_ws.size(), 1U);
    yard.set.remove(yard.tower);
    {
        const Plan& plan = planner.plan(yard.frame);
        ASSERT_EQ(plan.moved_ws.size(), 1U);
        EXPECT_FALSE(plan.moved_ws[0].contains(there));
    }
    for (int i = 0; i < 100; ++i) {
        yard.set.add(test::boxAt({i % 10 - 5, 1, i / 10 - 5}, {0.1, 1, 0.1}), {true, true, false});
    }
    const Plan& plan = planner.plan(yard.frame);
    EXPECT_EQ(plan.moved_ws.size(), kMostMoved);
    for (std::uint32_t i = 1; i < yard.set.size(); ++i) {
        EXPECT_TRUE(std::ranges::any_of(plan.moved_ws, [&](const Aabb& box) {
            return box.contains(yard.set.bounds(i));
        })) << i;
    }
}

TEST(ConvergingPlan, anotherObjectSetIsACut)
{
    Yard yard;
    Yard other;
    Planner planner(converging());
    (void)planner.plan(yard.frame);
    EXPECT_TRUE(planner.plan(other.frame).cut);
    EXPECT_FALSE(planner.plan(other.frame).cut);
}

TEST(ConvergingOptions, refuseWhatHoldsMapsStill)
{
    ShadowOptions options = converging();
    options.technique.motion = Motion::snap;
    EXPECT_NE(resolve(options).refusal.find("needs motion free"), std::string::npos);
    options = converging();
    options.keep_still = KeepStill::always;
    EXPECT_NE(resolve(options).refusal.find("keep-still always"), std::string::npos);
}

TEST(ConvergingOptions, haveRoomForTheKernelWhereverTheGridIs)
{
    ShadowOptions options = converging();
    options.pcf.kernel = PcfKernel::gaussian_7x7;
    const ResolvedOptions resolved = resolvedOrThrow(options);
    EXPECT_GE(resolved.border_texels(), resolved.reach_texels() + kMostGridMove_texels);
    options.technique.soften = Soften::none;
    EXPECT_LT(resolvedOrThrow(options).border_texels(), resolved.border_texels());
}

} // namespace
} // namespace gnomon
