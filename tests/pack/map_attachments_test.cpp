// SPDX-License-Identifier: Apache-2.0
#include "plan_by_hand.h"

#include <gnomon/pack/filter_rule.h>
#include <gnomon/pack/map_attachments.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>

namespace gnomon::test {
namespace {

pack::MapAttachments attachmentsOf(const ShadowOptions& options, bool orthographic)
{
    PlanByHand by_hand({options});
    by_hand.add(0, 1);
    by_hand.plan.views[0].projection.orthographic = orthographic;
    return pack::mapAttachments(by_hand.plan, by_hand.plan.views[0]);
}

TEST(MapAttachments, OfDepthsNeedAFragmentShaderWhereTheRasterisersDepthIsNotTheMetric)
{
    ShadowOptions options{.technique = kPlainTechnique};
    options.format = MapFormat::d16;
    const pack::MapAttachments sun = attachmentsOf(options, true);
    EXPECT_EQ(sun, (pack::MapAttachments{.depth = MapFormat::d16}));
    EXPECT_FALSE(sun.needFragmentShader());
    const pack::MapAttachments lamp = attachmentsOf(options, false);
    EXPECT_EQ(lamp, (pack::MapAttachments{.depth = MapFormat::d16, .write_depth = true}));
    EXPECT_TRUE(lamp.needFragmentShader());
}

TEST(MapAttachments, OfAFilterableMapAreDepthsWithItsSamples)
{
    const pack::MapAttachments made = attachmentsOf(filteredBy(Filter::msm), false);
    EXPECT_EQ(made, (pack::MapAttachments{.samples = 4, .write_depth = true}));
    EXPECT_FALSE(attachmentsOf(filteredBy(Filter::msm), true).needFragmentShader());
}

TEST(MapAttachments, OfAColourMapHaveADepthBesideIt)
{
    ShadowOptions options{.technique = kPlainTechnique};
    options.format = MapFormat::rg16;
    const pack::MapAttachments made = attachmentsOf(options, false);
    EXPECT_EQ(made.depth, MapFormat::d32f);
    EXPECT_EQ(made.colour, MapFormat::rg16);
    EXPECT_EQ(made.clear_colour, 1.0F);
    EXPECT_FALSE(made.write_depth) << "the texel has the metric";
    EXPECT_TRUE(made.needFragmentShader());
    EXPECT_EQ(attachmentsOf(filteredBy(Filter::id), true).clear_colour, 0.0F) << "0 is no object";
}

TEST(MapAttachments, PartsOfATexelShareNoChannel)
{
    for (const MapFormat format : {MapFormat::rg16, MapFormat::rg16f, MapFormat::rgba8}) {
        const std::uint32_t first = pack::channelsOfPart(format, TexelPart::first);
        const std::uint32_t second = pack::channelsOfPart(format, TexelPart::second);
        EXPECT_NE(first, 0U);
        EXPECT_EQ(first & second, 0U);
        EXPECT_EQ(pack::channelsOfPart(format, TexelPart::whole), 0xFU);
    }
    EXPECT_EQ(pack::channelsOfPart(MapFormat::rg16, TexelPart::second), 0x2U);
    EXPECT_EQ(pack::channelsOfPart(MapFormat::rgba8, TexelPart::second), 0xCU);
    EXPECT_EQ(pack::channelsOfPart(MapFormat::r32f, TexelPart::first), 0xFU);
}

// Every texel of a map lies in a block of each level, and the last level has one block.
TEST(MapBlocks, CoverTheMapWithOneAtTheEnd)
{
    for (const glm::uvec2 size : {glm::uvec2(1, 1), glm::uvec2(16, 16), glm::uvec2(1000, 24), glm::uvec2(2048, 2049)}) {
        const glm::uvec2 extent = pack::blocksExtent(size);
        const std::uint32_t levels = pack::blockLevels(size);
        EXPECT_GE(2 * extent.x, size.x);
        EXPECT_GE(2 * extent.y, size.y);
        EXPECT_EQ(extent.x >> (levels - 1), 1U);
        EXPECT_EQ(extent.y >> (levels - 1), 1U);
        EXPECT_LT(extent.x, std::max({size.x, size.y, 2U})) << "no larger than it takes";
    }
}

} // namespace
} // namespace gnomon::test
