// SPDX-License-Identifier: Apache-2.0
#include "plan_by_hand.h"

#include <gnomon/pack/frame_passes.h>
#include <gnomon/pack/mask_draws.h>
#include <gnomon/pack/soften_draws.h>

#include <gnomon/shared/screen_blur.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace gnomon::test {
namespace {

ShadowOptions blurredBy(float strength_px)
{
    ShadowOptions options = filteredBy(Filter::pcf);
    options.technique.soften = Soften::blur;
    options.screen_blur.strength_px = strength_px;
    return options;
}

std::vector<pack::SoftenDraw> softenDrawsOf(const Plan& plan)
{
    std::vector<pack::SoftenDraw> draws;
    pack::listSoftenDraws(plan, draws);
    return draws;
}

TEST(SoftenDraws, FourLightsAreBlurredAtATime)
{
    PlanByHand by_hand({blurredBy(1.0F)});
    for (int i = 0; i < 8; ++i) {
        by_hand.add(0, 1);
    }
    const auto draws = softenDrawsOf(by_hand.plan);
    ASSERT_EQ(draws.size(), 2U) << "eight lights share two layers";
    for (std::uint32_t layer = 0; layer < 2; ++layer) {
        EXPECT_EQ(draws[layer].layer, layer);
        EXPECT_EQ(draws[layer].channels, 0b1111U);
        EXPECT_TRUE(draws[layer].whole);
    }
}

TEST(SoftenDraws, LightsOfOtherOptionsKeepTheirChannels)
{
    PlanByHand by_hand({blurredBy(1.0F), filteredBy(Filter::hard), blurredBy(2.0F), blurredBy(1.0F)});
    by_hand.add(0, 1);
    by_hand.add(1, 1);
    by_hand.add(2, 1);
    by_hand.add(3, 1); // other options with the same blur
    const auto draws = softenDrawsOf(by_hand.plan);
    ASSERT_EQ(draws.size(), 2U);
    EXPECT_EQ(draws[0].channels, 0b1001U);
    EXPECT_EQ(draws[1].channels, 0b0100U);
    EXPECT_FALSE(draws[0].whole || draws[1].whole);
    EXPECT_EQ(draws[1].blur.strength_px, 2.0F);
}

TEST(HalfMaskDraws, TexelsAreThoseWhosePixelsTheyHave)
{
    const auto isOf = [](std::uint32_t texel, std::uint32_t begin, std::uint32_t end, std::uint32_t size) {
        const int pixel = std::min(shared::pixelOfTexel(static_cast<int>(texel), 2), static_cast<int>(size) - 1);
        return pixel >= static_cast<int>(begin) && pixel < static_cast<int>(end);
    };
    for (const std::uint32_t size : {1U, 2U, 7U, 8U}) {
        for (std::uint32_t begin = 0; begin < size; ++begin) {
            for (std::uint32_t end = begin + 1; end <= size; ++end) {
                const pack::ScreenBounds found = pack::halfTexels({begin, 0, end, 5}, {size, 5});
                for (std::uint32_t texel = 0; texel < (size + 1) / 2; ++texel) {
                    EXPECT_EQ(texel >= found.x0 && texel < found.x1, isOf(texel, begin, end, size))
                        << texel << " of " << begin << " " << end << " " << size;
                }
                EXPECT_EQ(std::pair(found.y0, found.y1), std::pair(0U, 3U));
            }
        }
    }
}

TEST(HalfMaskDraws, AreSpreadAfterTheMaskAndBeforeTheBlur)
{
    ShadowOptions half = blurredBy(1.0F);
    half.mask_size = MaskSize::half;
    PlanByHand by_hand({half, filteredBy(Filter::hard)});
    by_hand.add(1, 1);
    std::vector<pack::FramePass> passes;
    pack::listFramePasses(by_hand.plan, passes);
    EXPECT_FALSE(pack::has(passes, pack::FramePassKind::spread));
    by_hand.add(0, 1);
    pack::listFramePasses(by_hand.plan, passes);
    ASSERT_GE(passes.size(), 3U);
    EXPECT_EQ(passes[passes.size() - 3].kind, pack::FramePassKind::mask);
    EXPECT_EQ(passes[passes.size() - 2].kind, pack::FramePassKind::spread);
    EXPECT_EQ(passes.back().kind, pack::FramePassKind::blur);
}

TEST(SoftenDraws, LightsWithoutAMapDoNotCount)
{
    PlanByHand by_hand({blurredBy(1.0F), filteredBy(Filter::hard)});
    by_hand.add(0, 1);
    by_hand.add(1, 0);
    by_hand.add(0, 0);
    const auto draws = softenDrawsOf(by_hand.plan);
    ASSERT_EQ(draws.size(), 1U);
    EXPECT_EQ(draws[0].channels, 0b0001U);
    EXPECT_TRUE(draws[0].whole) << "what has no map is 1 all over, and stays so";
}

TEST(SoftenDraws, ALightInColourIsBlurredInAllChannels)
{
    PlanByHand by_hand({blurredBy(1.0F)});
    LightPlan& light = by_hand.add(0, 1);
    light.mask_coloured = true;
    light.mask_channel = 3;
    const auto draws = softenDrawsOf(by_hand.plan);
    ASSERT_EQ(draws.size(), 1U);
    EXPECT_EQ(draws[0].channels, 0b1111U);
}

TEST(SoftenDraws, ThePassIsTheLastAndOnlyWhereALightWantsIt)
{
    PlanByHand by_hand({filteredBy(Filter::pcf), blurredBy(1.0F)});
    by_hand.add(0, 1);
    by_hand.add(1, 0);
    std::vector<pack::FramePass> passes;
    pack::listFramePasses(by_hand.plan, passes);
    EXPECT_FALSE(pack::has(passes, pack::FramePassKind::blur));
    EXPECT_TRUE(softenDrawsOf(by_hand.plan).empty());
    by_hand.add(1, 1);
    pack::listFramePasses(by_hand.plan, passes);
    EXPECT_EQ(passes.back().kind, pack::FramePassKind::blur);
}

} // namespace
} // namespace gnomon::test
