// SPDX-License-Identifier: Apache-2.0
#include "plan_by_hand.h"

#include <gnomon/pack/mask_draws.h>
#include <gnomon/pack/technique_constants.h>

#include <gtest/gtest.h>

namespace gnomon::test {
namespace {

std::vector<pack::MaskDraw> drawsOf(const Plan& plan)
{
    std::vector<pack::MaskDraw> draws;
    pack::listMaskDraws(plan, {640, 480}, draws);
    return draws;
}

TEST(MaskDraws, EveryFilterHasItsOwnWithItsLightsChannels)
{
    PlanByHand by_hand({filteredBy(Filter::pcf), filteredBy(Filter::evsm)});
    by_hand.add(0, 1);
    by_hand.add(1, 1);
    by_hand.add(0, 1);
    by_hand.add(1, 0); // without a map: what is cleared to 1 says so
    by_hand.add(1, 1); // in the next layer, alone
    const auto draws = drawsOf(by_hand.plan);
    ASSERT_EQ(draws.size(), 3U);
    EXPECT_EQ(draws[0].options, 0U);
    EXPECT_EQ(draws[0].channels, 0b0101U);
    EXPECT_EQ(draws[1].options, 1U);
    EXPECT_EQ(draws[1].channels, 0b0010U);
    EXPECT_TRUE(draws[0].shares && draws[1].shares) << "neither may write over the other's channels";
    EXPECT_EQ(draws[2].layer, 1U);
    EXPECT_EQ(draws[2].channels, 0b0001U);
    EXPECT_FALSE(draws[2].shares);
    EXPECT_EQ(draws[2].first_light, 4U);
}

TEST(MaskDraws, ThereAreNoneWhereNothingHasAMap)
{
    PlanByHand by_hand({ShadowOptions{.technique = kPlainTechnique}});
    by_hand.add(0, 0);
    EXPECT_TRUE(drawsOf(by_hand.plan).empty());
    EXPECT_TRUE(drawsOf(PlanByHand({ShadowOptions{.technique = kPlainTechnique}}).plan).empty());
}

TEST(MaskDraws, OneWarpedViewIsEnoughForAPerspectiveShader)
{
    PlanByHand by_hand({ShadowOptions{.technique = kPlainTechnique}});
    by_hand.add(0, 1);
    by_hand.add(0, 2);
    EXPECT_TRUE(drawsOf(by_hand.plan)[0].orthographic);
    by_hand.plan.views[2].projection.orthographic = false;
    EXPECT_FALSE(drawsOf(by_hand.plan)[0].orthographic);
}

TEST(MaskDraws, FewViewsAreThoseOfAPlansOnlyLight)
{
    ShadowOptions cascades{.technique = kPlainTechnique};
    cascades.technique.partition = Partition::cascades;
    for (std::uint32_t count = 1; count <= kMaxCascades; ++count) {
        PlanByHand by_hand({cascades});
        by_hand.add(0, count);
        const auto wished = static_cast<std::uint32_t>((*by_hand.plan.options)[0].cascades().count);
        EXPECT_EQ(drawsOf(by_hand.plan)[0].few_views, count == 1        ? 1U
                                                      : count <= wished ? wished
                                                                        : shared::kFewViews)
            << count;
        by_hand.add(0, 0);
        const std::uint32_t alone = drawsOf(by_hand.plan)[0].few_views;
        EXPECT_EQ(pack::fewViewsOf(by_hand.plan), 0U) << "a host may ask for the other light";
        EXPECT_EQ(drawsOf(by_hand.plan)[0].few_views, alone) << "the mask asks for lights with maps alone";
        by_hand.add(0, 1);
        EXPECT_EQ(drawsOf(by_hand.plan)[0].few_views, 0U) << "another light has a map";
    }
    ShadowOptions stepping{.technique = kPlainTechnique};
    stepping.technique.motion = Motion::step_blend;
    PlanByHand by_hand({stepping});
    by_hand.add(0, 1);
    EXPECT_EQ(drawsOf(by_hand.plan)[0].few_views, 0U) << "it will be seen from two positions";
}

TEST(MaskDraws, FewViewsAreToldApartByWhatSetsThemApart)
{
    ShadowOptions cascades{.technique = kPlainTechnique};
    cascades.technique.partition = Partition::cascades;
    PlanByHand one({ShadowOptions{.technique = kPlainTechnique}});
    one.add(0, 1);
    const auto told = [](const PlanByHand& by_hand) {
        return drawsOf(by_hand.plan)[0].told_apart;
    };
    EXPECT_EQ(told(one), pack::ToldApart::alone);
    one.plan.views[0].serves.slice.end_m = 5.0;
    EXPECT_EQ(told(one), pack::ToldApart::tests) << "it does not serve what is farther";
    one.plan.views[0].serves.slice = {};
    one.plan.views[0].projection.gpu_cascade = 0;
    EXPECT_EQ(told(one), pack::ToldApart::tests) << "the GPU gives it a slice";

    PlanByHand several({cascades});
    several.add(0, 3);
    for (View& view : several.plan.views) {
        view.serves.slice.axis = {0.0, 0.0, -1.0, 2.0};
        view.serves.slice.end_m = 5.0;
    }
    EXPECT_EQ(told(several), pack::ToldApart::slices);
    several.plan.views[1].serves.slice.axis.w = 3.0;
    EXPECT_EQ(told(several), pack::ToldApart::tests) << "one counts from elsewhere";
    several.plan.views[1].serves.slice.axis.w = 2.0;
    several.plan.views[2].serves.sector.x = {1.0, 0.0, 0.0, 0.0};
    EXPECT_EQ(told(several), pack::ToldApart::tests) << "one stands beside others";
}

TEST(MaskDraws, OneViewOfEachPositionOfASunIsKnown)
{
    ShadowOptions stepping{.technique = kPlainTechnique};
    stepping.technique.motion = Motion::step_band;
    PlanByHand by_hand({stepping});
    by_hand.add(0, 1);
    EXPECT_EQ(drawsOf(by_hand.plan)[0].told_apart, pack::ToldApart::alone) << "of the position that there is";
    EXPECT_FALSE(drawsOf(by_hand.plan)[0].paired);

    PlanByHand two({stepping});
    LightPlan& light = two.add(0, 2);
    two.plan.views[0].serves.sun = SunPosition::earlier;
    two.plan.views[1].serves.sun = SunPosition::later;
    light.steps.paired = true;
    light.steps.band = 0.1;
    light.steps.edge = 0.5;
    const auto draws = drawsOf(two.plan);
    ASSERT_EQ(draws.size(), 3U);
    for (const pack::MaskDraw& draw : draws) {
        EXPECT_EQ(draw.told_apart, pack::ToldApart::alone);
        EXPECT_EQ(draw.few_views, 0U) << "where there are no modules for one view they are looked up";
    }
    EXPECT_TRUE(!draws[0].paired && draws[1].paired && !draws[2].paired) << "the band alone reads two maps";
    two.plan.views[1].serves.slice.end_m = 5.0;
    EXPECT_EQ(drawsOf(two.plan)[1].told_apart, pack::ToldApart::tests) << "it does not serve what is farther";
    EXPECT_FALSE(drawsOf(two.plan)[1].paired);

    PlanByHand divided({stepping});
    divided.add(0, 4).steps.paired = true;
    divided.plan.views[2].serves.sun = divided.plan.views[3].serves.sun = SunPosition::later;
    EXPECT_EQ(drawsOf(divided.plan)[0].told_apart, pack::ToldApart::tests) << "each position has two views";
}

TEST(MaskDraws, ColouredLightIsDrawnToAllChannelsOfItsLayer)
{
    PlanByHand by_hand({filteredBy(Filter::pcf), filteredBy(Filter::evsm)});
    by_hand.add(0, 1);
    LightPlan& coloured = by_hand.add(1, 1);
    coloured.mask_layer = 1;
    coloured.mask_channel = 3;
    coloured.mask_coloured = true;
    by_hand.plan.mask_layers = 2;
    const auto draws = drawsOf(by_hand.plan);
    ASSERT_EQ(draws.size(), 2U);
    EXPECT_FALSE(draws[0].coloured);
    EXPECT_TRUE(draws[1].coloured);
    EXPECT_EQ(draws[1].layer, 1U);
    EXPECT_EQ(draws[1].channels, 0b1111U);
    EXPECT_FALSE(draws[1].shares);
    std::vector<shared::GpuLight> lights(pack::maskLightCount(by_hand.plan));
    pack::fillMaskLights(by_hand.plan, draws, lights);
    EXPECT_EQ(lights[0].views, glm::uvec4(0, 1, 0, 0));
    EXPECT_EQ(lights[1].views.y, 0U) << "nobody has that channel";
    for (std::uint32_t channel = 0; channel < 4; ++channel) {
        EXPECT_EQ(lights[draws[1].first_light + channel].views, glm::uvec4(1, 1, 0, 0)) << channel;
    }
}

TEST(MaskDraws, HaveRoomForTheirLightsHoweverSunsStand)
{
    ShadowOptions stepping{.technique = kPlainTechnique};
    stepping.technique.motion = Motion::step_band;
    PlanByHand by_hand({stepping, ShadowOptions{.technique = kPlainTechnique}});
    for (std::uint32_t i = 0; i < 4; ++i) {
        LightPlan& light = by_hand.add(i % 2, 2);
        by_hand.plan.views.back().serves.sun = SunPosition::later;
        by_hand.plan.views[light.first_view].serves.sun = SunPosition::earlier;
        light.steps.paired = true;
        light.steps.band = 0.1;
        light.steps.edge = 0.2 + 0.2 * i;
    }
    const auto draws = drawsOf(by_hand.plan);
    EXPECT_GT(draws.size(), 9U);
    std::vector<shared::GpuLight> lights(pack::maskLightCount(by_hand.plan));
    pack::fillMaskLights(by_hand.plan, draws, lights);
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
    for (const pack::MaskDraw& draw : draws) {
        ASSERT_LE(draw.first_light + 4, lights.size());
        EXPECT_TRUE(draw.pixels.x0 == end || draw.pixels.x0 == begin) << "strips follow each other";
        begin = draw.pixels.x0;
        end = draw.pixels.x1;
        for (std::uint32_t channel = 0; channel < 4; ++channel) {
            const bool drawn = (draw.channels >> channel & 1U) != 0;
            EXPECT_TRUE(!drawn || lights[draw.first_light + channel].views.y > 0);
        }
    }
    EXPECT_EQ(end, 640U) << "strips cover the screen";
}

} // namespace
} // namespace gnomon::test
