// SPDX-License-Identifier: Apache-2.0
#include "plan_by_hand.h"

#include <gnomon/pack/cascade_lights.h>
#include <gnomon/pack/caster_rows.h>
#include <gnomon/pack/depth_layers.h>
#include <gnomon/pack/filter_rule.h>
#include <gnomon/pack/frame_passes.h>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <array>

namespace gnomon::test {
namespace {

using Kind = pack::FramePassKind;

std::vector<pack::FramePass> passesOf(const Plan& plan)
{
    std::vector<pack::FramePass> passes;
    pack::listFramePasses(plan, passes);
    return passes;
}

TEST(FramePasses, ComeInTheOrderInWhichTheyNeedEachOther)
{
    PlanByHand by_hand(
        {ShadowOptions{.technique = kPlainTechnique}, filteredBy(Filter::msm), filteredBy(Filter::hard)});
    by_hand.add(2, 1);
    by_hand.add(0, 1);
    by_hand.add(0, 0);
    by_hand.plan.views[0].projection.gpu_cascade = 0;
    by_hand.plan.lights[1].steps.paired = by_hand.plan.lights[1].steps.alternate = true;
    by_hand.plan.lights[0].sample.joined = true;
    const auto passes = passesOf(by_hand.plan);
    ASSERT_EQ(passes.size(), 6U);
    const std::array kinds{Kind::bounds, Kind::maps, Kind::maps, Kind::mask, Kind::history, Kind::converge};
    for (std::size_t i = 0; i < kinds.size(); ++i) {
        EXPECT_EQ(passes[i].kind, kinds[i]) << i;
    }
    EXPECT_EQ(passes[1].options, 0U);
    EXPECT_EQ(passes[2].options, 2U);
}

TEST(FramePasses, GiveAHostSomethingToBindBeforeThereIsAMap)
{
    PlanByHand by_hand({ShadowOptions{.technique = kPlainTechnique}});
    by_hand.add(0, 0);
    for (const auto& passes :
         {passesOf(by_hand.plan), passesOf(PlanByHand({ShadowOptions{.technique = kPlainTechnique},
                                                       ShadowOptions{.technique = kPlainTechnique}})
                                               .plan)}) {
        ASSERT_EQ(passes.size(), 2U);
        EXPECT_TRUE(pack::has(passes, Kind::mask));
        EXPECT_EQ(passes[0].options, 0U);
    }
}

// An object ten thousand kilometres away moves by whole millimetres; single precision would jump by a metre.
TEST(CasterRows, ComposeInDoublePrecision)
{
    const glm::dvec3 place(1.0e7, 10.0, 0.0);
    View view;
    view.projection.clip_from_world = glm::translate(glm::dmat4(1.0), -place);
    view.projection.metric.metric_ws = {0.0, -0.01, 0.0, 0.6};
    const pack::Rows3x4 transform{{2, 0, 0, 1.0e7F}, {0, 2, 0, 10}, {0, 0, 2, 0}};
    std::array<glm::vec4, pack::casterRowCount(true)> rows{};
    EXPECT_EQ(pack::CasterRows(view).write(transform, rows.data()), rows.data() + rows.size());
    EXPECT_EQ(rows[0], glm::vec4(2, 0, 0, 0)) << "the large numbers cancel before they are rounded";
    EXPECT_NEAR(rows[2].w, 0.5F, 1e-6F);
    view.projection.orthographic = false;
    std::array<glm::vec4, pack::casterRowCount(false)> more{};
    EXPECT_EQ(pack::CasterRows(view).write(transform, more.data()), more.data() + more.size());
    EXPECT_EQ(more[3], glm::vec4(0, 0, 0, 1)) << "w comes before the metric";
    view.projection.metric.near_m = 20.0;
    view.projection.metric.far_m = 120.0;
    std::array<glm::vec4, pack::casterRowCount(false)> biased{};
    (void)pack::CasterRows(view).write(transform, biased.data(), 2.0);
    EXPECT_NEAR(biased[4].w, more[4].w + 0.02F, 1e-6F) << "two metres of a hundred";
    biased[4].w = more[4].w;
    EXPECT_EQ(biased, more);
}

TEST(FilterRule, HoldsWhatTheFormatDoes)
{
    const auto resolved = [](Filter filter, std::optional<MapFormat> format) {
        ShadowOptions options = filteredBy(filter);
        options.format = format;
        return resolvedOrThrow(options);
    };
    EXPECT_EQ(pack::depthHolding(resolved(Filter::pcf, {})), 0);
    EXPECT_EQ(pack::depthHolding(resolved(Filter::pcf, MapFormat::rg16)), 1);
    EXPECT_EQ(pack::depthHolding(resolved(Filter::hard, MapFormat::rgba8)), 2);
    EXPECT_EQ(pack::depthHolding(resolved(Filter::vsm, MapFormat::rg16)), 0) << "moments, not two maps";
    EXPECT_GT(pack::depthQuantum(MapFormat::d16), 1.0F / 65535.0F);
    EXPECT_LT(pack::depthQuantum(MapFormat::d32f), 1e-5F);
}

/// The first channel holds the mean, whatever the format; msm alone has a basis of its own for 16 bits.
TEST(FilterRule, DepthOfATexelIsItsFirstMoment)
{
    const std::array texel{0.25F, 0.0625F, 1.0F, 1.0F};
    for (const MapFormat format : {MapFormat::rgba16, MapFormat::rgba16f, MapFormat::rgba32f}) {
        ShadowOptions options = filteredBy(Filter::lvsm);
        options.format = format;
        EXPECT_NEAR(pack::mapDepth(resolvedOrThrow(options), texel), 0.25F, 1e-6F) << static_cast<int>(format);
    }
}

TEST(DepthLayers, KeepTheirPlaceAsLongAsTheirMapHasItsName)
{
    PlanByHand by_hand({filteredBy(Filter::lvsm)});
    by_hand.add(0, 2);
    EXPECT_EQ(pack::depthLayersSlot(by_hand.plan, 1), 1U) << "a map without a name: by its view";
    by_hand.plan.views[1].place.map = {7, 3};
    EXPECT_EQ(pack::depthLayersSlot(by_hand.plan, 1), 7U);
    EXPECT_EQ(pack::depthLayersCount(by_hand.plan), 8U);
    by_hand.plan.map_count = 12; // others are out of sight
    EXPECT_EQ(pack::depthLayersCount(by_hand.plan), 12U);
}

TEST(CascadeLights, AreOnlyThoseThatTheGpuFits)
{
    ShadowOptions sdsm{.technique = kPlainTechnique};
    sdsm.technique.partition = Partition::sdsm;
    sdsm.cascades.count = 3;
    sdsm.max_distance_m = 80.0;
    PlanByHand by_hand({ShadowOptions{.technique = kPlainTechnique}, sdsm});
    by_hand.plan.made_for.camera = {{0.0, 2.0, 0.0}, glm::perspectiveRH_ZO(0.9, 1.6, 500.0, 0.1)};
    by_hand.add(0, 1);
    by_hand.add(1, 3);
    for (std::uint32_t i = 0; i < 3; ++i) {
        by_hand.plan.views[1 + i].projection.gpu_cascade = i;
    }
    ASSERT_EQ(pack::cascadeLightCount(by_hand.plan), 1U);
    std::array<shared::GpuCascadeLight, 2> lights{};
    EXPECT_EQ(pack::fillCascadeLights(by_hand.plan, {320, 200}, lights), 1U);
    EXPECT_EQ(lights[0].cascades.x, 3U);
    EXPECT_EQ(lights[0].cascades.y, 1U) << "its first view";
    EXPECT_EQ(lights[0].reach.y, 80.0F) << "by its own options";
    EXPECT_EQ(lights[0].screen.x, 320.0F);
    EXPECT_EQ(pack::groupsOver({320, 200}), glm::uvec2(5, 4));
}

TEST(CascadeLights, WhatWasFoundHasInfinitiesAgain)
{
    shared::GpuFittedView gpu{};
    gpu.place = {2.0F, 4.0F, 0.5F, -0.25F};
    gpu.slice = {-1e30F, 12.0F, 0.5F, 0.01F};
    gpu.seen = {1.0F, 1.0F, -1.0F, -1.0F};
    const FittedView view = pack::describeFitted(gpu);
    EXPECT_EQ(view.scale, glm::dvec2(2.0, 4.0));
    EXPECT_EQ(view.centre, glm::dvec2(0.5, -0.25));
    EXPECT_EQ(view.begin_m, -std::numeric_limits<double>::infinity());
    EXPECT_EQ(view.end_m, 12.0);
    EXPECT_EQ(view.blend_m, 2.0);
    EXPECT_TRUE(view.empty());
}

} // namespace
} // namespace gnomon::test
