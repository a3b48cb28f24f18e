// SPDX-License-Identifier: Apache-2.0
// Masks that are drawn where blocks settle a pixel, and then where they do not.
#include "fixture.h"
#include "mask_marks.h"
#include "option_steps.h"
#include "planned_scene.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::test {
namespace {

using vulkan::MaskMarks;

constexpr VkExtent2D kScreen{161, 93};

/// A depth as the marks' format keeps it.
int codeOf(const VkViewport& viewport)
{
    EXPECT_EQ(viewport.minDepth, viewport.maxDepth);
    return static_cast<int>(std::lround(static_cast<double>(viewport.minDepth) * 65535.0));
}

TEST(MaskMarks, OfADrawLieBelowThoseBeforeItWithAStepBetween)
{
    int before = 65535; // a layer begins with it
    for (const std::uint32_t i : {0U, 1U, 2U, 3U, 1000U, 1001U, MaskMarks::kMostDraws - 1}) {
        const int mark = codeOf(MaskMarks::viewport(kScreen, i, false));
        const int left = codeOf(MaskMarks::viewport(kScreen, i, true));
        EXPECT_GE(mark, 0);
        EXPECT_EQ(left, mark + 1) << i;
        EXPECT_LT(left, before) << i;
        before = mark;
    }
}

std::vector<std::byte> draw(PlannedScene& scene, std::span<const Light> lights, std::span<const ShadowOptions> options)
{
    Drawing drawing(gpu(), scene.mesh());
    Planner planner(options);
    const Frame frame = scene.frameOf(lights);
    return scene.draw(drawing, planner.plan(frame));
}

// A pixel that faces away is dark, though blocks do not settle it, and frames that converge keep it dark.
TEST(SettledMask, KeepsDarkWhatFacesAwayWhereFramesConverge)
{
    PlannedScene scene(gpu(), kScreen);
    scene.remakeViews(kScreen, true, true);
    const std::vector<Light> lights = sunsAndSpots(2);
    const auto drawn = [&](const char* line) {
        Drawing drawing(gpu(), scene.mesh());
        Planner planner(optionsFrom(line));
        std::vector<std::byte> mask;
        for (int i = 0; i < 2; ++i) {
            const Frame frame = scene.frameOf(lights);
            mask = scene.draw(drawing, planner.plan(frame));
        }
        return mask;
    };
    const std::vector<std::byte> alone = drawn("filter=raymarch map-size=64");
    const std::vector<std::byte> joined = drawn("filter=raymarch soften=converge map-size=64");
    ASSERT_EQ(alone.size(), joined.size());
    std::size_t apart = 0;
    for (std::size_t i = 0; i < alone.size(); ++i) {
        apart += alone[i] == std::byte{0} && joined[i] == std::byte{255} ? 1 : 0;
    }
    EXPECT_EQ(apart, 0U);
    expectSilence(gpu());
}

// Draws of one layer leave pixels at the same places, and none may take those of another for its own.
TEST(SettledMask, GivesEachLightOfALayerWhatItHasAmongItsLike)
{
    const std::array several{optionsFrom("filter=pcf map-size=64"), optionsFrom("filter=raymarch map-size=64"),
                             optionsFrom("filter=pcss map-size=64"),
                             optionsFrom("filter=pcf mask-size=half map-size=64")};
    PlannedScene scene(gpu(), kScreen);
    std::vector<Light> lights = sunsAndSpots(8);
    for (Light& light : lights) {
        light.radius_m = 0.2;
        light.angular_diameter_rad = 0.03;
    }
    for (std::uint32_t i = 0; i < lights.size(); ++i) {
        lights[i].options = i % 4;
    }
    const std::vector<std::byte> mixed = draw(scene, lights, several);
    const std::size_t layer = std::size_t{4} * kScreen.width * kScreen.height;
    ASSERT_EQ(mixed.size(), 2 * layer);
    constexpr std::uint32_t kOfFullSize = 3; // a half mask is spread where all lights of its layer agree
    for (std::uint32_t of = 0; of < kOfFullSize; ++of) {
        std::vector<Light> alike = lights;
        for (Light& light : alike) {
            light.options = 0;
        }
        const std::vector<std::byte> expected = draw(scene, alike, std::span(several).subspan(of, 1));
        std::size_t wrong = 0;
        std::size_t between = 0;
        for (std::size_t i = 0; i < mixed.size(); ++i) {
            if (lights[i / layer * 4 + i % 4].options == of) {
                wrong += mixed[i] != expected[i] ? 1 : 0;
                between += mixed[i] != std::byte{0} && mixed[i] != std::byte{255} ? 1 : 0;
            }
        }
        EXPECT_EQ(wrong, 0U) << of;
        EXPECT_GT(between, 100U) << of << " leaves nothing";
    }
    expectSilence(gpu());
}

} // namespace
} // namespace gnomon::test
