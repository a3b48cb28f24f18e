// SPDX-License-Identifier: Apache-2.0
// Masks that are means over frames, on a device under the validation layer: where they begin, and when they begin anew.
#include "fixture.h"
#include "planned_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace gnomon::test {
namespace {

constexpr VkExtent2D kScreen{96, 60};

ShadowOptions optionsOf(Soften soften, Partition partition = Partition::single, Filter filter = Filter::hard)
{
    ShadowOptions options{.technique = kPlainTechnique};
    options.technique.filter = filter;
    options.technique.soften = soften;
    options.technique.partition = partition;
    options.map_size = 128;
    options.cascades.blend = 0.0; // one frame's mask is 0 or 1 everywhere
    return options;
}

/// A renderer with its planner, of the one scene.
struct Watcher {
    Watcher(PlannedScene& scene_in, const ShadowOptions& options)
        : scene(scene_in), drawing(gpu(), scene_in.mesh()), planner(options)
    {
    }
    std::vector<std::byte> draw(const Frame& frame) { return scene.draw(drawing, planner.plan(frame)); }
    std::vector<std::byte> draw(std::span<const Light> lights) { return draw(scene.frameOf(lights)); }

    PlannedScene& scene;
    Drawing drawing;
    Planner planner;
};

std::size_t countBetween(const std::vector<std::byte>& mask)
{
    return static_cast<std::size_t>(
        std::ranges::count_if(mask, [](std::byte b) { return b != std::byte{0} && b != std::byte{255}; }));
}

class Converging : public testing::TestWithParam<Partition> {
protected:
    void TearDown() override { expectSilence(gpu()); }

    /// Shown without softening, of lights without a size.
    std::vector<std::byte> plain(std::span<const Light> lit)
    {
        std::vector<Light> points(lit.begin(), lit.end());
        for (Light& light : points) {
            light.angular_diameter_rad = 0.0;
            light.radius_m = 0.0;
        }
        return Watcher(scene, optionsOf(Soften::none, GetParam())).draw(points);
    }

    PlannedScene scene{gpu(), kScreen};
    Watcher watcher{scene, optionsOf(Soften::converge, GetParam())};
    std::vector<Light> lights = [] {
        std::vector<Light> made = sunsAndSpots(2);
        made[0].angular_diameter_rad = 0.15;
        made[1].radius_m = 0.3;
        return made;
    }();
};

TEST_P(Converging, beginsUnsoftenedAndGrowsSoft)
{
    for (const std::size_t count : {1U, 2U}) {
        Watcher fresh(scene, optionsOf(Soften::converge, GetParam()));
        const std::span some(lights.data(), count);
        const auto first = fresh.draw(some);
        EXPECT_EQ(first, plain(some)) << count << " lights";
        EXPECT_EQ(countBetween(first), 0U);
        auto mask = first;
        for (int frame = 1; frame < 8; ++frame) {
            mask = fresh.draw(some);
        }
        EXPECT_GT(countBetween(mask), mask.size() / 50);
    }
}

// With a filter whose frames all have equal weight.
TEST_P(Converging, isTheMeanOfItsFrames)
{
    const std::span sun(lights.data(), 1);
    Watcher alone(scene, optionsOf(Soften::converge, GetParam(), Filter::vsm));
    Drawing other(gpu(), scene.mesh());
    std::vector<double> sum;
    for (int frame = 0; frame < 12; ++frame) {
        const Frame now = scene.frameOf(sun);
        const Plan& plan = alone.planner.plan(now);
        const auto mean = scene.draw(alone.drawing, plan);
        Plan apart = plan; // of a renderer that knows of no frame before
        apart.cut = true;
        apart.number = 100U + 2U * static_cast<std::uint64_t>(frame);
        const auto one = scene.draw(other, apart);
        sum.resize(one.size());
        double worst = 0.0;
        for (std::size_t i = 0; i < one.size(); ++i) {
            sum[i] += std::to_integer<int>(one[i]);
            worst = std::max(worst, std::abs(sum[i] / (frame + 1) - std::to_integer<int>(mean[i])));
        }
        // 255 / 2048 of each frame's rounding; eight bits of the mask; eight bits of the frames that are summed here.
        EXPECT_LE(worst, 0.5 + 0.5 + 0.5);
    }
}

TEST_P(Converging, beginsAnewAfterACutAFrameNotDrawnAndAnotherSize)
{
    const auto expected = plain(lights);
    const auto warm = [&] {
        for (int frame = 0; frame < 4; ++frame) {
            (void)watcher.draw(lights);
        }
        return watcher.draw(lights);
    };
    EXPECT_NE(warm(), expected);
    Frame cut = scene.frameOf(lights);
    cut.cut = true;
    EXPECT_EQ(watcher.draw(cut), expected);
    (void)warm();
    (void)watcher.planner.plan(scene.frameOf(lights)); // which nobody draws
    EXPECT_EQ(countBetween(watcher.draw(lights)), 0U);
    (void)warm();
    scene.remakeViews({64, 40}, false, true);
    EXPECT_EQ(countBetween(watcher.draw(lights)), 0U);
}

TEST_P(Converging, keepsEachLightApart)
{
    for (int frame = 0; frame < 6; ++frame) {
        (void)watcher.draw(lights);
    }
    const auto channel = [](const std::vector<std::byte>& mask, std::size_t light) {
        std::vector<std::byte> one;
        for (std::size_t i = light; i < mask.size(); i += 4) {
            one.push_back(mask[i]);
        }
        return one;
    };
    std::vector<Light> turned = lights;
    turned[0].direction_ws = glm::normalize(glm::dvec3(-0.4, -1.0, 0.4)); // by more than it is wide
    const auto mask = watcher.draw(turned);
    EXPECT_EQ(countBetween(channel(mask, 0)), 0U) << "the sun jumped";
    EXPECT_GT(countBetween(channel(mask, 1)), 20U) << "the spot stayed";
    std::vector<Light> swapped{turned[1], turned[0], turned[0]};
    swapped[2].key = 7;
    const auto after = watcher.draw(swapped);
    for (const std::size_t light : {0U, 1U, 2U}) {
        EXPECT_EQ(countBetween(channel(after, light)), 0U) << light << ": another light had its place";
    }
    (void)watcher.draw(std::vector<Light>{});
    EXPECT_EQ(countBetween(watcher.draw(std::span(lights.data(), 1))), 0U);
}

/// Layer and channel of a mask's bytes.
std::vector<std::byte> channelOf(const std::vector<std::byte>& mask, const LightPlan& light)
{
    constexpr std::size_t kPixels = std::size_t{kScreen.width} * kScreen.height;
    std::vector<std::byte> one;
    for (std::size_t i = 0; i < kPixels; ++i) {
        one.push_back(mask[(light.mask_layer * kPixels + i) * 4 + light.mask_channel]);
    }
    return one;
}

// When another light's colours go, a light moves to a channel where frames before had something else.
TEST_P(Converging, beginsAnewWhereALightIsElsewhereInTheMask)
{
    const ShadowOptions grey = optionsOf(Soften::converge, GetParam());
    ShadowOptions coloured = grey;
    coloured.translucent = Translucent::colour;
    Planner planner(std::array{grey, coloured});
    Drawing drawing(gpu(), scene.mesh());
    std::vector<Light> three = sunsAndSpots(3);
    for (Light& light : three) {
        light.angular_diameter_rad = 0.15;
        light.radius_m = 0.3;
        light.options = 1;
    }
    three[2].options = 0;
    std::vector<std::byte> mask;
    for (int frame = 0; frame < 8; ++frame) {
        const Frame now = scene.frameOf(three);
        mask = scene.draw(drawing, planner.plan(now));
    }
    three[0].options = 0;
    const Frame now = scene.frameOf(three);
    const Plan& plan = planner.plan(now);
    ASSERT_EQ(plan.lights[2].mask_layer, 0U);
    mask = scene.draw(drawing, plan);
    EXPECT_EQ(countBetween(channelOf(mask, plan.lights[2])), 0U) << "it was in layer 2";
    EXPECT_GT(countBetween(channelOf(mask, plan.lights[1])), 20U) << "this one stayed in layer 1";
}

TEST_P(Converging, aCameraThatMovesFindsItsSurfacesAgain)
{
    for (int frame = 0; frame < 6; ++frame) {
        (void)watcher.draw(lights);
    }
    scene.remakeViews(kScreen, true, false);
    const auto mask = watcher.draw(lights);
    EXPECT_GT(countBetween(mask), mask.size() / 100);
    const auto expected = plain(lights);
    std::size_t far_off = 0;
    for (std::size_t i = 0; i < mask.size(); ++i) {
        far_off += std::abs(std::to_integer<int>(mask[i]) - std::to_integer<int>(expected[i])) > 200 ? 1 : 0;
    }
    EXPECT_LT(far_off, mask.size() / 50);
}

INSTANTIATE_TEST_SUITE_P(Partitions, Converging,
                         testing::Values(Partition::single, Partition::cascades, Partition::sdsm),
                         [](const auto& one) { return std::string(nameOf(one.param)); });

} // namespace
} // namespace gnomon::test
