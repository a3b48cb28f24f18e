// SPDX-License-Identifier: Apache-2.0
// Moving objects leave nothing behind in a mask that is a mean over frames, and averaged pixels are found again.
#include "host/frame_renderer.h"
#include "small_scene.h"

#include "scene/state.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace gnomon::host::test {
namespace {

constexpr std::uint32_t kWidth = 320;
constexpr std::uint32_t kHeight = 200;

RenderOptions optionsOf(Soften soften)
{
    RenderOptions options;
    options.width = kWidth;
    options.height = kHeight;
    options.shadow.map_size = 512;
    options.shadow.technique.filter = Filter::hard;
    options.shadow.technique.soften = soften;
    return options;
}

/// Whether all pixels within `reach` have the wanted value.
bool isAround(float wanted, const ImageF& mask, std::uint32_t x, std::uint32_t y, std::uint32_t reach)
{
    for (std::uint32_t v = y - reach; v <= y + reach; ++v) {
        for (std::uint32_t u = x - reach; u <= x + reach; ++u) {
            if (*mask.pixel(u, v) != wanted) {
                return false;
            }
        }
    }
    return true;
}

class ConvergingHost : public testing::Test {
protected:
    void TearDown() override { EXPECT_EQ(gpu_.messages(), std::vector<std::string>{}); }

    ImageF maskAt(FrameRenderer& renderer, double time_s, std::uint32_t groups = kAllGroups) const
    {
        const scene::State state = scene::evaluate(scene_, time_s);
        ShadedLight light = lightsOf(scene_, state).front();
        light.caster.groups = groups;
        if (&renderer == &plain_) { // whose masks are of shadow and light, and of nothing between
            light.caster.angular_diameter_rad = 0.0;
        }
        renderer.draw(state, smallEye(), {light});
        return renderer.read({.colour = false, .masks = true}).masks.front();
    }

    Gpu gpu_{GpuOptions{.gpu = "software", .validate = true}};
    scene::Scene scene_ = smallScene();
    SceneOnGpu uploaded_{gpu_, scene_, scene::evaluate(scene_, 0.0)};
    FrameRenderer soft_{uploaded_, optionsOf(Soften::converge)};
    FrameRenderer plain_{uploaded_, optionsOf(Soften::none)};
};

// A box that is somewhere else at once: what it shadowed is lit with the next frame.
TEST_F(ConvergingHost, aCasterThatIsGoneIsGoneAtOnce)
{
    for (int frame = 0; frame < 16; ++frame) {
        (void)maskAt(soft_, 0.5);
    }
    const ImageF before = maskAt(plain_, 0.5);
    const ImageF now = maskAt(plain_, 4.0);
    const ImageF mean = maskAt(soft_, 4.0);
    int vacated = 0;
    double worst = 0.0;
    for (std::uint32_t y = 4; y + 4 < kHeight; ++y) {
        for (std::uint32_t x = 4; x + 4 < kWidth; ++x) {
            if (isAround(0.0F, before, x, y, 1) && isAround(1.0F, now, x, y, 4)) {
                ++vacated;
                worst = std::max(worst, 1.0 - double{*mean.pixel(x, y)});
            }
        }
    }
    EXPECT_GT(vacated, 100) << "else this says nothing";
    EXPECT_LE(worst, 0.02);
}

TEST_F(ConvergingHost, aCasterThatMovesLeavesNoTrail)
{
    ImageF before = maskAt(plain_, 0.0);
    (void)maskAt(soft_, 0.0);
    int vacated = 0;
    for (int frame = 1; frame < 20; ++frame) {
        const double time_s = 0.15 * frame;
        const ImageF now = maskAt(plain_, time_s);
        const ImageF mean = maskAt(soft_, time_s);
        for (std::uint32_t y = 4; y + 4 < kHeight; ++y) {
            for (std::uint32_t x = 4; x + 4 < kWidth; ++x) {
                if (isAround(0.0F, before, x, y, 1) && isAround(1.0F, now, x, y, 2)) {
                    ++vacated;
                    EXPECT_GE(*mean.pixel(x, y), 0.98F) << x << " " << y << " in frame " << frame;
                }
            }
        }
        before = now;
    }
    EXPECT_GT(vacated, 50) << "else this says nothing";
}

// A light that no longer shadows a group, or does so again, is another light to the mean.
TEST_F(ConvergingHost, aGroupThatALightLeavesIsGoneAtOnce)
{
    for (int frame = 0; frame < 16; ++frame) {
        (void)maskAt(soft_, 0.5);
    }
    for (const std::uint32_t groups : {std::uint32_t{2}, kAllGroups}) {
        const ImageF now = maskAt(plain_, 0.5, groups);
        const ImageF mean = maskAt(soft_, 0.5, groups);
        int flat = 0;
        for (std::uint32_t y = 4; y + 4 < kHeight; ++y) {
            for (std::uint32_t x = 4; x + 4 < kWidth; ++x) {
                const float wanted = *now.pixel(x, y);
                if (isAround(wanted, now, x, y, 4)) {
                    ++flat;
                    ASSERT_NEAR(*mean.pixel(x, y), wanted, 0.02) << x << " " << y << ", groups " << groups;
                }
            }
        }
        EXPECT_GT(flat, 10000) << "else this says nothing";
    }
}

// Pixels that no moving object can shadow go on converging while something moves elsewhere.
TEST_F(ConvergingHost, theRestGoesOnConverging)
{
    ImageF mean;
    for (int frame = 0; frame < 12; ++frame) {
        mean = maskAt(soft_, 0.02 * frame);
    }
    const auto between = std::ranges::count_if(mean.values, [](float v) { return v > 0.0F && v < 1.0F; });
    EXPECT_GT(between, 30);
}

} // namespace
} // namespace gnomon::host::test
