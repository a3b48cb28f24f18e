// SPDX-License-Identifier: Apache-2.0
// Layers placed by gaps: between casters that lie over each other and what they hide, wherever most depths gather.
#include "placed_layers.h"

#include <gnomon/shared/depth_layers.h>

#include <algorithm>
#include <set>

namespace gnomon::test {
namespace {

constexpr float kBars = 0.1F;
constexpr float kSail = 0.75F;
constexpr float kGround = 0.9F;

/// Bars over a sail over ground. `lower` sinks all of it.
std::vector<float> barsOverASail(float lower = 0.0F)
{
    std::vector<float> depths;
    for (std::uint32_t y = 0; y < kSide; ++y) {
        for (std::uint32_t x = 0; x < kSide; ++x) {
            const bool sail = x % 64 < 32 && y > 32 && y < 224;
            const bool bar = y % 32 < 8;
            depths.push_back(lower + (bar ? kBars : sail ? kSail : kGround));
        }
    }
    return depths;
}

class LayersByGaps : public LayersOfDepth {};

TEST_F(LayersByGaps, partTheReceiverFromAllThatHidesIt)
{
    Placed placed(lvsm(LayerPlacement::gaps, 2));
    const auto layers = placed.place(viewOf(kWhole), barsOverASail());
    EXPECT_GE(layers[1].near, kSail); // so both casters are at 0 for the ground, and nothing bleeds there
    EXPECT_LE(layers[1].begins, kGround);
    // Lloyd's rule goes by how many depths there are, and leaves the sail in the ground's layer.
    Placed by_lloyd(lvsm(LayerPlacement::lloyd, 2));
    EXPECT_LT(by_lloyd.place(viewOf(kWhole), barsOverASail())[1].near, kSail);
}

TEST_F(LayersByGaps, keepAwayFromWhatTheyPart)
{
    ShadowOptions options = lvsm(LayerPlacement::gaps, 2);
    options.moments.layer_overlap = 0.0F;
    Placed placed(options);
    const float begins = placed.place(viewOf(kWhole), barsOverASail())[1].begins;
    EXPECT_GT(begins, kSail + 0.3F * (kGround - kSail));
    EXPECT_LT(begins, kGround - 0.3F * (kGround - kSail));
}

/// Until layers of one width part ground and sail nearly as well.
TEST_F(LayersByGaps, areThoseOfFewerLayersAndMore)
{
    std::set<float> before;
    for (std::uint32_t count = 2; count <= 3; ++count) {
        Placed placed(lvsm(LayerPlacement::gaps, count));
        const auto layers = placed.place(viewOf(kWhole), barsOverASail());
        std::set<float> splits;
        for (std::size_t i = 1; i < layers.size(); ++i) {
            EXPECT_GE(layers[i].begins - layers[i - 1].begins, shared::kLeastLayerWidth);
            splits.insert(layers[i].begins);
        }
        ASSERT_EQ(splits.size(), count - 1);
        for (const float split : before) {
            EXPECT_EQ(splits.count(split), 1U) << split << ", " << count << " layers";
        }
        before = splits;
    }
}

TEST_F(LayersByGaps, leaveNextToNothingBeforeTheSailInTheGroundsLayer)
{
    for (std::uint32_t count = 2; count <= kMaxDepthLayers; ++count) {
        Placed placed(lvsm(LayerPlacement::gaps, count));
        const auto layers = placed.place(viewOf(kWhole), barsOverASail());
        const auto next = std::find_if(layers.begin(), layers.end(),
                                       [](const pack::DepthLayer& layer) { return layer.begins > kGround; });
        EXPECT_GE((next - 1)->near, kSail - 0.02F) << count << " layers";
    }
}

TEST_F(LayersByGaps, areOfOneWidthWhereNothingIsOverAnything)
{
    for (const float depth : {0.4F, 1.0F}) {
        Placed placed(lvsm(LayerPlacement::gaps, 4));
        const auto layers = placed.place(viewOf(kWhole), std::vector<float>(std::size_t{kSide} * kSide, depth));
        for (std::size_t i = 0; i < layers.size(); ++i) {
            EXPECT_NEAR(layers[i].begins, 0.25 * double(i), 0.1) << i;
        }
    }
}

/// Steps at all depths down to the ground, side by side: many pairs, no gap among them.
std::vector<float> stairs()
{
    std::vector<float> depths;
    for (std::uint32_t y = 0; y < kSide; ++y) {
        for (std::uint32_t x = 0; x < kSide; ++x) {
            const std::uint32_t step = (x / 8 * 7 + y / 8 * 5) % 16;
            depths.push_back(0.05F + 0.055F * static_cast<float>(step));
        }
    }
    return depths;
}

TEST_F(LayersByGaps, areOfOneWidthWhereNoSplitSavesMuch)
{
    for (const std::uint32_t count : {2U, 3U, 4U, 8U}) {
        for (const Motion motion : {Motion::free, Motion::snap}) {
            Placed placed(lvsm(LayerPlacement::gaps, count));
            const auto layers = placed.place(viewOf(kWhole), stairs(), motion);
            for (std::uint32_t i = 0; i < count; ++i) {
                EXPECT_NEAR(layers[i].begins, double(i) / count, 1e-6) << count << " layers";
            }
        }
    }
}

TEST_F(LayersByGaps, comeBackToOneWidthWhenTheGapCloses)
{
    for (const Motion motion : {Motion::free, Motion::snap}) {
        Placed placed(lvsm(LayerPlacement::gaps, 2));
        EXPECT_GT(placed.place(viewOf(kWhole), barsOverASail(), motion)[1].begins, kSail);
        for (int frame = 0; frame < 20; ++frame) {
            (void)placed.place(viewOf(kWhole), stairs(), motion);
        }
        EXPECT_NEAR(placed.place(viewOf(kWhole), stairs(), motion)[1].begins, 0.5, 1e-4);
    }
}

TEST_F(LayersByGaps, stayWhileTheyDoTheirWorkAndThenFollow)
{
    constexpr float kRisen = -0.09F; // the ground is before the split, and bleeds
    Placed anew(lvsm(LayerPlacement::gaps, 2));
    const float rest = anew.place(viewOf(kWhole), barsOverASail(kRisen))[1].begins;
    for (const Motion motion : {Motion::free, Motion::snap}) {
        Placed placed(lvsm(LayerPlacement::gaps, 2));
        const auto first = placed.place(viewOf(kWhole), barsOverASail(), motion);
        EXPECT_GT(first[1].begins, kGround + kRisen);
        for (const float sunk : {0.0F, 0.02F, 0.04F}) {
            const auto next = placed.place(viewOf(kWhole), barsOverASail(sunk), motion);
            EXPECT_EQ(next[1].begins, first[1].begins);
            EXPECT_EQ(next[1].near, first[1].near);
        }
        // At once where maps are held, else half of the way in a frame.
        const auto off = placed.place(viewOf(kWhole), barsOverASail(kRisen), motion);
        EXPECT_NEAR(off[1].begins, motion == Motion::snap ? rest : 0.5F * (first[1].begins + rest), 1e-5);
    }
}

} // namespace
} // namespace gnomon::test
