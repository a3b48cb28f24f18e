// SPDX-License-Identifier: Apache-2.0
// A compact mask against one in which every light has a channel.
#include "fixture.h"
#include "option_steps.h"
#include "planned_scene.h"

#include "reach_cells.h"

#include <gnomon/error.h>
#include <gnomon/pack/compact_mask.h>
#include <gnomon/planner.h>

#include <gtest/gtest.h>

#include <cmath>

namespace gnomon::test {
namespace {

constexpr VkExtent2D kScreen{70, 40};

/// Seven lights that are planned by these options in turn.
struct Lights {
    explicit Lights(const std::vector<ShadowOptions>& options) : planner(options)
    {
        for (std::uint32_t i = 0; i < lights.size(); ++i) {
            lights[i].options = i % static_cast<std::uint32_t>(options.size());
            lights[i].brightness = lights[i].type == LightType::spot ? 100.0 + i : 1.0 + 0.1 * i;
        }
        lights[5].casts_shadow = false;
    }

    std::vector<Light> lights = sunsAndSpots(7);
    PlannedScene scene{gpu(), kScreen};
    Planner planner;
};

/// The masks of one frame, ordinary and compact.
class TwoMasks {
public:
    TwoMasks(Lights& lights, const pack::CompactMaskRule& rule)
        : frame_(lights.scene.frameOf(lights.lights)), plan_(&lights.planner.plan(frame_))
    {
        Drawing each(gpu(), lights.scene.mesh());
        each_ = lights.scene.draw(each, *plan_);
        Drawing compact(gpu(), lights.scene.mesh(), rule);
        compact_ = lights.scene.draw(compact, *plan_);
        EXPECT_EQ(compact.renderer.mask().layers, rule.channels / 4);
        EXPECT_GT(compact.renderer.maskTiles(0).bytes, 0U);
        EXPECT_EQ(compact.renderer.maskTiles(99).bytes, 0U);
        EXPECT_EQ(each.renderer.maskTiles(0).bytes, 0U);
        pack::LightLists lists;
        pack::listCompactMask(*plan_, rule, {kScreen.width, kScreen.height}, lists, tiles_);
    }

    /// Difference between what a pixel's tile says of its lights and what the ordinary mask does, of 255; of lights
    /// that share a channel, of their mean.
    [[nodiscard]] double worst() const
    {
        double worst = 0.0;
        for (std::uint32_t y = 0; y < kScreen.height; ++y) {
            for (std::uint32_t x = 0; x < kScreen.width; ++x) {
                worst = std::max(worst, worstAt(x, y));
            }
        }
        return worst;
    }
    [[nodiscard]] double darkest() const { return *std::ranges::min_element(compact_) == std::byte{0} ? 0.0 : 1.0; }

private:
    [[nodiscard]] double valueOf(const std::vector<std::byte>& mask, std::uint32_t layer, std::uint32_t channel,
                                 std::uint32_t x, std::uint32_t y) const
    {
        const std::size_t pixels = std::size_t{kScreen.width} * kScreen.height;
        const std::size_t at = layer * pixels + std::size_t{y} * kScreen.width + x;
        return static_cast<double>(mask.at(at * 4 + channel));
    }
    [[nodiscard]] double worstAt(std::uint32_t x, std::uint32_t y) const
    {
        std::array<double, 8> wanted{};
        std::array<bool, 8> counts{};
        for (const pack::TileLight& light : tiles_.of(x / tiles_.rule.side_px, y / tiles_.rule.side_px)) {
            const LightPlan& planned = plan_->lights[light.light];
            const double own = valueOf(each_, planned.mask_layer, planned.mask_channel, x, y);
            if (light.channel == pack::kNoMaskChannel) {
                EXPECT_EQ(own, 255.0) << "without a map";
                continue;
            }
            const pack::ScreenBounds lit = pack::litPixels(frame_.lights[light.light], frame_.camera,
                                                           frame_.objects->bounds(), {kScreen.width, kScreen.height});
            if (x < lit.x0 || x >= lit.x1 || y < lit.y0 || y >= lit.y1) {
                return 0.0; // the ordinary mask is not drawn there
            }
            wanted[light.channel] += light.weight * own;
            counts[light.channel] = true;
        }
        double worst = 0.0;
        for (std::uint32_t channel = 0; channel < tiles_.rule.channels; ++channel) {
            const double found = valueOf(compact_, channel / 4, channel % 4, x, y);
            worst = std::max(worst, std::abs(found - (counts[channel] ? wanted[channel] : 255.0)));
        }
        return worst;
    }

    Frame frame_;
    const Plan* plan_;
    std::vector<std::byte> each_;
    std::vector<std::byte> compact_;
    pack::CompactMask tiles_;
};

TEST(CompactMask, HasTheOrdinaryMasksNumbersWhereEveryLightHasAChannel)
{
    Lights lights({optionsFrom("filter=pcf map-size=128")});
    const TwoMasks masks(lights, {8, 16});
    EXPECT_LE(masks.worst(), 1.0);
    EXPECT_EQ(masks.darkest(), 0.0);
    expectSilence(gpu());
}

TEST(CompactMask, HasTheMeanOfLightsThatShareAChannel)
{
    Lights lights({optionsFrom("filter=pcf map-size=128")});
    EXPECT_LE(TwoMasks(lights, {4, 16}).worst(), 1.5);
    EXPECT_LE(TwoMasks(lights, {4, 32}).worst(), 1.5);
    expectSilence(gpu());
}

// Their draws take away from each other's; each rounds.
TEST(CompactMask, JoinsLightsOfSeveralFilters)
{
    Lights lights({optionsFrom("filter=pcf map-size=128"), optionsFrom("filter=evsm map-size=64"),
                   optionsFrom("filter=hard map-size=64")});
    EXPECT_LE(TwoMasks(lights, {8, 16}).worst(), 1.0);
    EXPECT_LE(TwoMasks(lights, {4, 16}).worst(), 3.0);
    expectSilence(gpu());
}

TEST(CompactMask, RefusesWhatNeedsAChannelForEachLight)
{
    for (const char* const options : {"filter=pcf translucent=colour", "filter=pcf soften=converge",
                                      "filter=pcf soften=blur", "filter=pcf mask-size=half"}) {
        Lights lights({optionsFrom(options)});
        const Frame frame = lights.scene.frameOf(lights.lights);
        Drawing compact(gpu(), lights.scene.mesh(), {4, 16});
        EXPECT_THROW((void)compact.renderer.prepare(lights.planner.plan(frame), kScreen), Error) << options;
    }
    Lights lights({optionsFrom("filter=pcf")});
    Plan plan = lights.planner.plan(lights.scene.frameOf(lights.lights));
    plan.lights[0].steps.paired = true;
    Drawing compact(gpu(), lights.scene.mesh(), {4, 16});
    EXPECT_THROW((void)compact.renderer.prepare(plan, kScreen), Error);
    EXPECT_THROW(vulkan::ShadowRenderer(gpu().view(), {.compact = {3, 16}}), Error);
    EXPECT_THROW(vulkan::ShadowRenderer(gpu().view(), {.compact = {4, 17}}), Error);
}

} // namespace
} // namespace gnomon::test
