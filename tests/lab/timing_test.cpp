// SPDX-License-Identifier: Apache-2.0
#include "lab/timing.h"

#include "stage.h"

#include "worlds/worlds.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace gnomon::lab::test {
namespace {

TEST(Spread, IsMedianAndInterquartileRangeByLinearInterpolation)
{
    // Type 7 of {1, 2, 3, 4}: quartiles 1.75, 2.5 and 3.25.
    const Spread even = spreadOf({4.0, 1.0, 3.0, 2.0});
    EXPECT_DOUBLE_EQ(even.median, 2.5);
    EXPECT_DOUBLE_EQ(even.iqr, 1.5);
    const Spread odd = spreadOf({7.0, 100.0, -1.0});
    EXPECT_DOUBLE_EQ(odd.median, 7.0);
    EXPECT_DOUBLE_EQ(odd.iqr, (7.0 + 93.0 / 2.0) - 3.0);
    EXPECT_EQ(spreadOf({5.0}).median, 5.0);
    EXPECT_EQ(spreadOf({5.0}).iqr, 0.0);
    EXPECT_EQ(spreadOf({}).median, 0.0);
}

TEST(Turns, GoBackAndForth)
{
    using Places = std::vector<std::size_t>;
    EXPECT_EQ(turnsOf(0, 3), (Places{0, 1, 2}));
    EXPECT_EQ(turnsOf(1, 3), (Places{2, 1, 0}));
    EXPECT_EQ(turnsOf(2, 3), (Places{0, 1, 2}));
    EXPECT_EQ(turnsOf(7, 1), Places{0});
}

TEST(Stages, SumThePassesOfTheirName)
{
    host::FrameTimes times;
    times.plan_ms = 0.5;
    times.frame_ms = 9.0;
    const auto pass = [&](const char* name, double milliseconds) {
        vulkan::PassRecord record{};
        record.name = name;
        record.milliseconds = milliseconds;
        record.draws = 2;
        record.vertex_invocations = 100;
        times.passes.push_back(record);
    };
    pass("shadow maps", 1.0);
    pass("g-buffer", 16.0);
    pass("shadow maps", 2.0);
    pass("mask", 4.0);
    const StageTimes stages = stagesOf(times);
    EXPECT_EQ(stages.plan, 0.5);
    EXPECT_EQ(stages.maps, 3.0);
    EXPECT_EQ(stages.filter, 0.0);
    EXPECT_EQ(stages.mask, 4.0);
    EXPECT_EQ(stages.frame, 9.0);

    Plan plan;
    plan.views.resize(2);
    plan.views[0].place.tile = {.width = 10, .height = 20};
    plan.views[1].place.tile = {.width = 30, .height = 30};
    plan.views[1].contents.redraw = false;
    EXPECT_EQ(countersOf(times, plan, false).texels_rendered, 200U);
    EXPECT_EQ(countersOf(times, plan, true).texels_rendered, 1100U);
    plan.views[0].contents.kept_layer = 0; // restored, and a corner drawn over
    plan.views[0].contents.dirty = {5, 5, 3, 4};
    EXPECT_EQ(countersOf(times, plan, false).texels_rendered, 12U);
    EXPECT_EQ(countersOf(times, plan, true).texels_rendered, 2U * 200U + 900U);
    plan.views[0].contents.redraw_kept = true;
    plan.views[0].contents.dirty = {0, 0, 10, 20};
    EXPECT_EQ(countersOf(times, plan, false).texels_rendered, 2U * 200U);
    EXPECT_EQ(countersOf(times, plan, true).draws, 8U);
    EXPECT_EQ(countersOf(times, plan, true).vertex_invocations, 400U);
    EXPECT_EQ(countersOf(times, plan, true).passes, 4U);
    EXPECT_FALSE(countersOf(times, plan, true).has_statistics);
}

TEST(Stages, AreAbsentWhereTheDeviceMeasuresNoTimes)
{
    host::FrameTimes times;
    vulkan::PassRecord record{};
    record.name = "shadow maps";
    times.passes.push_back(record);
    const StageTimes stages = stagesOf(times);
    EXPECT_FALSE(stages.maps.has_value());
    EXPECT_EQ(stages.filter, 0.0) << "no such pass took no time";
    EXPECT_EQ(stages.frame, 0.0) << "the CPU's clock is always there";
}

Timed timedOf(std::initializer_list<double> frames)
{
    Timed timed;
    for (const double frame : frames) {
        timed.samples.emplace_back().frame_ms = frame;
    }
    return timed;
}

TEST(FrameRatio, IsOfMedians)
{
    Timed timed = timedOf({30.0, 3.0, 2.0});
    EXPECT_EQ(frameRatio(timed), 0.0); // of nothing
    timed.baseline_ms = 2.0;
    EXPECT_DOUBLE_EQ(frameRatio(timed), 1.5);
}

class TimeInTurn : public testing::Test {
protected:
    TimeInTurn() : stage(worlds::load("planes", 1), "side", {64, 36})
    {
        contestants = {{"kept", hardOptions(128)}, {"anew", hardOptions(128)}, {"large", hardOptions(256)}};
        contestants[1].options.reuse_maps = false;
        for (Contestant& contestant : contestants) {
            contestant.options.width = 64;
            contestant.options.height = 36;
        }
    }
    Stage stage;
    std::vector<Contestant> contestants;
};

// Shadow volumes have no map whose drawing would make the mask another one.
TEST_F(TimeInTurn, DrawsMasksAnewWhereMapsAre)
{
    contestants.resize(1);
    contestants[0].options.shadow.technique.filter = Filter::volumes;
    for (const bool kept : {false, true}) {
        const TimingResult result = timeInTurn(stage.uploaded(), stage.subject(), contestants,
                                               {.repetitions = 2, .warmup = 3, .reuse_maps = kept}, nullptr);
        for (const host::FrameTimes& times : result.techniques[0].samples) {
            EXPECT_EQ(times.mask_kept, kept);
        }
    }
}

TEST_F(TimeInTurn, KeepsEachOnesFramesAndWhatTheyTook)
{
    int steps = 0;
    const TimingResult result = timeInTurn(stage.uploaded(), stage.subject(), contestants,
                                           {.repetitions = 3, .warmup = 2, .reuse_maps = true}, [&] { ++steps; });
    EXPECT_EQ(steps, 4 * 5);
    ASSERT_EQ(result.techniques.size(), 3U);
    EXPECT_EQ(result.baseline.samples.size(), 3U);
    EXPECT_EQ(stagesOf(result.baseline.samples[0]).maps, 0.0);
    EXPECT_EQ(result.baseline.counters.texels_rendered, 0U);
    EXPECT_TRUE(result.baseline.added_memory.empty());
    EXPECT_GT(result.baseline_bytes, 64U * 36U * 4U);
    for (const Timed& timed : result.techniques) {
        EXPECT_EQ(timed.samples.size(), 3U);
        EXPECT_GT(frameRatio(timed), 0.0);
        std::uint64_t added = 0;
        for (const auto& [purpose, bytes] : timed.added_memory) {
            added += bytes;
        }
        EXPECT_GE(added, std::uint64_t{timed.atlas.width} * timed.atlas.height * timed.atlas.layers * 4);
    }
    // Two lights, a map each.
    EXPECT_EQ(result.techniques[0].counters.texels_rendered, 0U);
    EXPECT_EQ(result.techniques[1].counters.texels_rendered, 2U * 128U * 128U);
    EXPECT_GT(stagesOf(result.techniques[1].samples[2]).maps, 0.0);
    // Kept and drawn anew they read the same, one texel for a pixel and light at the most.
    const auto least = [&](std::size_t i) {
        return result.techniques[i].counters.bytes_minimum;
    };
    EXPECT_EQ(result.baseline.counters.bytes_minimum, 0U);
    EXPECT_EQ(least(1) - least(0), 4U * 2U * 128U * 128U);
    EXPECT_GT(least(0), 64U * 36U * (4 + 4 + 4 + 4)); // two lights: four bytes of mask
    EXPECT_LT(least(0), 64U * 36U * (4 + 4 + 4 + 4 + 2 * 4));
    EXPECT_EQ(result.techniques[2].plan.views.size(), 2U);
    EXPECT_EQ(result.techniques[2].plan.views[0].place.tile.width, 256U);
}

TEST_F(TimeInTurn, DrawsEveryMapAnewUnlessAskedToKeepThem)
{
    const TimingResult result =
        timeInTurn(stage.uploaded(), stage.subject(), contestants, {.repetitions = 2, .warmup = 1}, {});
    EXPECT_EQ(result.techniques[0].counters.texels_rendered, 2U * 128U * 128U);
    EXPECT_EQ(result.techniques[2].counters.texels_rendered, 2U * 256U * 256U);
}

TEST(TimingGroups, AreSmallAndTheirMapsFitTogether)
{
    const auto groups = [](const std::vector<std::uint32_t>& sides, std::size_t lights) {
        std::vector<Contestant> made;
        for (const std::uint32_t side : sides) {
            made.push_back({"", hardOptions(side)});
        }
        return timingGroups(made, lights);
    };
    using Sizes = std::vector<std::size_t>;
    EXPECT_EQ(groups(std::vector<std::uint32_t>(8, 2048), 1), (Sizes{8}));
    EXPECT_EQ(groups(std::vector<std::uint32_t>(17, 2048), 1), (Sizes{8, 8, 1}));
    EXPECT_EQ(groups({16384, 8192, 8192, 8192, 16384, 16384}, 1), (Sizes{4, 2}));
    EXPECT_EQ(groups({8192, 8192, 8192}, 4), (Sizes{2, 1}));
    EXPECT_EQ(groups({64, 16384, 64}, 4), (Sizes{1, 1, 1})); // one alone may have more
}

TEST_F(TimeInTurn, ManyHaveABaselineForEachGroup)
{
    contestants.resize(kMaxTogether + 1, contestants[0]);
    contestants.back().options.shadow.map_size = 256;
    const TimingOptions options{.repetitions = 2, .warmup = 1};
    std::uint64_t steps = 0;
    const TimingResult result = timeInTurn(stage.uploaded(), stage.subject(), contestants, options, [&] { ++steps; });
    EXPECT_EQ(steps, (kMaxTogether + 1 + 2) * 3U);
    EXPECT_EQ(timingSteps(stage.subject(), contestants, options), steps);
    ASSERT_EQ(result.techniques.size(), kMaxTogether + 1);
    EXPECT_EQ(result.baseline.samples.size(), 4U);
    EXPECT_EQ(result.techniques.back().plan.views[0].place.tile.width, 256U);
    EXPECT_EQ(result.techniques.back().added_memory.empty(), false);
    for (const Timed& timed : result.techniques) {
        EXPECT_EQ(timed.samples.size(), 2U);
        EXPECT_GT(frameRatio(timed), 0.0);
    }
    const auto frame = [&](std::size_t i) {
        return result.baseline.samples[i].frame_ms;
    };
    EXPECT_DOUBLE_EQ(result.techniques.front().baseline_ms, (frame(0) + frame(1)) / 2.0);
    EXPECT_DOUBLE_EQ(result.techniques.back().baseline_ms, (frame(2) + frame(3)) / 2.0);
}

TEST_F(TimeInTurn, StopsWhenTheCallerThrows)
{
    int steps = 0;
    const auto stop = [&] {
        if (++steps == 3) {
            throw std::runtime_error("enough");
        }
    };
    EXPECT_THROW((void)timeInTurn(stage.uploaded(), stage.subject(), contestants, {}, stop), std::runtime_error);
    EXPECT_EQ(steps, 3);
}

} // namespace
} // namespace gnomon::lab::test
