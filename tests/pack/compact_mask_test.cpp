// SPDX-License-Identifier: Apache-2.0
// The lists of a compact mask: no light is missing, the brightest have channels, the others share one.
#include "plan_by_hand.h"

#include <gnomon/error.h>
#include <gnomon/pack/compact_mask.h>
#include <gnomon/pack/mask_draws.h>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <bit>
#include <limits>
#include <random>
#include <set>

namespace gnomon::test {
namespace {

constexpr glm::uvec2 kSize{320, 181};

// Lamps around the origin, every fifth without a map. The camera looks along -z.
PlanByHand lampsByHand(std::uint32_t count)
{
    PlanByHand by_hand({filteredBy(Filter::pcf)});
    std::mt19937 engine(5);
    std::uniform_real_distribution<double> dice(-1.0, 1.0);
    for (std::uint32_t i = 0; i < count; ++i) {
        by_hand.add(0, i % 5 == 4 ? 0 : 6);
    }
    for (Light& light : by_hand.plan.made_for.lights) {
        light.type = LightType::point;
        light.position_ws = {8.0 * dice(engine), 5.0 * dice(engine), -14.0 + 8.0 * dice(engine)};
        light.range_m = 3.5 + 2.0 * dice(engine);
        light.brightness = 50.0 + 40.0 * dice(engine);
    }
    by_hand.plan.made_for.camera.clip_from_world = glm::perspectiveRH_ZO(1.0, double(kSize.x) / kSize.y, 0.1, 100.0);
    by_hand.plan.made_for.size_px = kSize;
    return by_hand;
}

pack::CompactMask maskOf(const PlanByHand& by_hand, const pack::CompactMaskRule& rule, glm::uvec2 size_px = kSize)
{
    pack::LightLists lists;
    pack::CompactMask mask;
    pack::listCompactMask(by_hand.plan, rule, size_px, lists, mask);
    return mask;
}

// Own channels first, in the order of importance; then one that is shared; then lights without maps.
void expectOrder(const PlanByHand& by_hand, const pack::CompactMask& mask, std::uint32_t tile, bool& shares)
{
    const std::uint32_t channels = mask.rule.channels;
    const auto lights = std::span(mask.lights).subspan(mask.first[tile], mask.first[tile + 1] - mask.first[tile]);
    const std::uint32_t masked = mask.masked[tile];
    float shared = 0.0F;
    for (std::uint32_t i = 0; i < lights.size(); ++i) {
        EXPECT_EQ(by_hand.plan.lights[lights[i].light].outcome.hasMap(), i < masked);
        if (i >= masked) {
            EXPECT_EQ(lights[i].channel, pack::kNoMaskChannel);
        } else if (masked <= channels || i + 1 < channels) {
            EXPECT_EQ(lights[i].channel, i);
            EXPECT_EQ(lights[i].weight, 1.0F);
        } else {
            EXPECT_EQ(lights[i].channel, channels - 1);
            shared += lights[i].weight;
            shares = true;
        }
    }
    if (masked > channels) {
        EXPECT_NEAR(shared, 1.0F, 1e-5F);
    }
}

class CompactMasks : public testing::TestWithParam<pack::CompactMaskRule> {};

TEST_P(CompactMasks, HaveEveryLightOfEveryTileOnce)
{
    const PlanByHand by_hand = lampsByHand(60);
    const pack::CompactMask mask = maskOf(by_hand, GetParam());
    pack::LightLists lists;
    pack::listLights(by_hand.plan.made_for.lights, by_hand.plan.made_for.camera, {}, kSize, GetParam().side_px, lists);
    ASSERT_EQ(mask.tiles, lists.tiles);
    bool shares = false;
    for (std::uint32_t y = 0; y < mask.tiles.y; ++y) {
        for (std::uint32_t x = 0; x < mask.tiles.x; ++x) {
            std::set<std::uint32_t> found;
            for (const pack::TileLight& light : mask.of(x, y)) {
                EXPECT_TRUE(found.insert(light.light).second);
            }
            const auto wanted = lists.of(x, y);
            EXPECT_EQ(found, std::set<std::uint32_t>(wanted.begin(), wanted.end()));
            expectOrder(by_hand, mask, y * mask.tiles.x + x, shares);
        }
    }
    EXPECT_TRUE(shares) << "no tile has many lights";
    const pack::CompactMask again = maskOf(by_hand, GetParam());
    EXPECT_EQ(again.lights, mask.lights);
    EXPECT_EQ(again.first, mask.first);
}

INSTANTIATE_TEST_SUITE_P(Rules, CompactMasks,
                         testing::Values(pack::CompactMaskRule{4, 16}, pack::CompactMaskRule{4, 32},
                                         pack::CompactMaskRule{8, 16}));

TEST(CompactMask, GivesTheBrightestTheirOwnChannels)
{
    PlanByHand by_hand = lampsByHand(10);
    for (std::uint32_t i = 0; i < 10; ++i) {
        by_hand.plan.made_for.lights[i].position_ws = {0.0, 0.0, -5.0};
        by_hand.plan.made_for.lights[i].range_m = 100.0;
        by_hand.plan.made_for.lights[i].brightness = i == 3 ? 9.0 : i == 8 ? 7.0 : i == 1 ? 5.0 : 2.0;
    }
    const pack::CompactMask mask = maskOf(by_hand, {4, 16});
    const auto lights = mask.of(3, 3);
    ASSERT_EQ(lights.size(), 10U);
    EXPECT_EQ(lights[0].light, 3U);
    EXPECT_EQ(lights[1].light, 8U);
    EXPECT_EQ(lights[2].light, 1U);
    for (std::uint32_t i = 3; i < 8; ++i) {
        EXPECT_FLOAT_EQ(lights[i].weight, 0.2F) << "five of one brightness";
    }
}

TEST(CompactMask, IsWrittenAsShadersReadIt)
{
    const pack::CompactMask mask = maskOf(lampsByHand(60), {8, 16});
    std::vector<glm::uvec2> words(pack::maskTileWords(mask));
    pack::fillMaskTiles(mask, words);
    EXPECT_EQ(words[0], glm::uvec2(16, mask.tiles.x));
    for (std::uint32_t tile = 0; tile < mask.masked.size(); ++tile) {
        const glm::uvec2 here = words[1 + tile];
        EXPECT_EQ(here.y & 0xFFFFU, mask.masked[tile]);
        ASSERT_EQ(here.y >> 16U, mask.first[tile + 1] - mask.first[tile]);
        for (std::uint32_t i = 0; i < here.y >> 16U; ++i) {
            const glm::uvec2 word = words[here.x + i];
            const pack::TileLight& light = mask.lights[mask.first[tile] + i];
            EXPECT_EQ(word.x & 0xFFFFFFU, light.light);
            EXPECT_EQ(word.x >> 24U, light.channel);
            EXPECT_EQ(std::bit_cast<float>(word.y), light.weight);
        }
    }
    words.pop_back();
    EXPECT_THROW(pack::fillMaskTiles(mask, words), Error);
}

TEST(CompactMask, SurvivesNumbersThatAreNone)
{
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    PlanByHand by_hand = lampsByHand(20);
    by_hand.plan.made_for.lights[0].position_ws.x = kNan;
    by_hand.plan.made_for.lights[1].brightness = kNan;
    by_hand.plan.made_for.lights[2].brightness = kInfinity;
    by_hand.plan.made_for.lights[3].range_m = kNan;
    by_hand.plan.made_for.lights[5].range_m = -1.0;
    by_hand.plan.made_for.lights[6].brightness = -1.0;
    for (const pack::TileLight& light : maskOf(by_hand, {4, 16}).lights) {
        EXPECT_GE(light.weight, 0.0F);
        EXPECT_LE(light.weight, 1.0F);
    }
    EXPECT_TRUE(maskOf(by_hand, {4, 16}, {0, 10}).lights.empty());
    EXPECT_TRUE(maskOf(by_hand, {0, 16}).lights.empty());
    by_hand.plan.made_for.camera.clip_from_world = glm::dmat4(kNan);
    (void)maskOf(by_hand, {8, 32});
    by_hand.plan.made_for.camera.clip_from_world = glm::dmat4(0.0);
    (void)maskOf(by_hand, {8, 32});
    EXPECT_THROW((void)maskOf(by_hand, {5, 16}), Error);
    EXPECT_THROW((void)maskOf(by_hand, {4, 0}), Error);
    by_hand.plan.made_for.lights.resize(3);
    EXPECT_THROW((void)maskOf(by_hand, {4, 16}), Error);
}

TEST(CompactMask, IsDrawnOnceForEachLayerAndOptions)
{
    PlanByHand by_hand({filteredBy(Filter::pcf), filteredBy(Filter::evsm)});
    by_hand.add(0, 1);
    by_hand.add(0, 0);
    std::vector<pack::MaskDraw> draws;
    pack::listCompactMaskDraws(by_hand.plan, {8, 16}, kSize, draws);
    ASSERT_EQ(draws.size(), 2U);
    EXPECT_FALSE(draws[0].shares);
    EXPECT_EQ(draws[1].layer, 1U);
    by_hand.add(1, 1);
    pack::listCompactMaskDraws(by_hand.plan, {8, 16}, kSize, draws);
    ASSERT_EQ(draws.size(), 4U);
    EXPECT_TRUE(draws[0].shares);
    EXPECT_EQ(draws[3].options, 1U);
}

} // namespace
} // namespace gnomon::test
