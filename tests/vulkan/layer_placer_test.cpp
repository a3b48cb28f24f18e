// SPDX-License-Identifier: Apache-2.0
// Layers of depth: the GPU's relaxation against the same rules on the CPU, in double precision and by another sum; what
// keeps its place from frame to frame and what does not.
#define GNOMON_REAL double
#include "placed_layers.h"

#include <gnomon/shared/depth_layers.h>

namespace gnomon::test {
namespace {

using pack::DepthLayer;

constexpr int kBins = 1024;

/// Ground that rises slowly, houses on it, things in the air; a fifth is empty. `lower` sinks all of it.
std::vector<float> depthsOf(float lower = 0.0F)
{
    std::vector<float> depths(std::size_t{kSide} * kSide);
    std::uint32_t state = 7;
    for (std::size_t i = 0; i < depths.size(); ++i) {
        state = state * 1664525U + 1013904223U;
        const float noise = static_cast<float>(state >> 8) / 16777216.0F;
        const std::uint32_t kind = (state >> 4) % 20;
        const float ground = 0.80F + 0.1F * static_cast<float>(i) / static_cast<float>(depths.size());
        depths[i] = kind < 4 ? 1.0F
                             : lower + (kind < 7    ? 0.1F + 0.05F * noise
                                        : kind < 10 ? ground - 0.2F * noise
                                                    : ground);
    }
    return depths;
}

std::vector<double> lloydOnCpu(const std::vector<float>& depths, int count, int flags = 0, double ratio = 1.0)
{
    std::vector<double> histogram(kBins, 0.0);
    for (const float depth : depths) {
        if (depth < 1.0F) {
            ++histogram[static_cast<std::size_t>(
                shared::binOf(shared::momentDepth(double{depth}, flags, ratio), kBins))];
        }
    }
    const auto lowest = std::find_if(histogram.begin(), histogram.end(), [](double n) { return n > 0.0; });
    const auto highest = std::find_if(histogram.rbegin(), histogram.rend(), [](double n) { return n > 0.0; });
    const int low = static_cast<int>(lowest - histogram.begin());
    const int high = kBins - 1 - static_cast<int>(highest - histogram.rbegin());
    std::vector<double> means;
    for (int i = 0; i < count; ++i) {
        means.push_back(shared::lloydStart(i, count, shared::binCentre(low, kBins), shared::binCentre(high, kBins)));
    }
    std::vector<double> begins(static_cast<std::size_t>(count) + 1, 0.0);
    begins.back() = 1.0;
    for (int step = 0; step < 300; ++step) {
        for (std::size_t i = 1; i < means.size(); ++i) {
            begins[i] = shared::lloydSplit(static_cast<int>(i), count, means[i - 1], means[i], begins[i - 1]);
        }
        for (std::size_t i = 0; i < means.size(); ++i) {
            double held = 0.0;
            double sum = 0.0;
            for (int bin = 0; bin < kBins; ++bin) {
                if (shared::layerHoldsBin(bin, kBins, begins[i], begins[i + 1])) {
                    held += histogram[static_cast<std::size_t>(bin)];
                    sum += histogram[static_cast<std::size_t>(bin)] * shared::binCentre(bin, kBins);
                }
            }
            means[i] = shared::lloydMean(held, sum, means[i]);
        }
    }
    begins.pop_back();
    return begins;
}

TEST_F(LayersOfDepth, areWhereTheHandPutThem)
{
    ShadowOptions filter = lvsm(LayerPlacement::by_hand, 3);
    filter.moments.splits = {0.2F, 0.6F};
    filter.moments.layer_overlap = 0.1F;
    Placed placed(filter);
    const auto layers = placed.place(viewOf(kWhole), depthsOf());
    ASSERT_EQ(layers.size(), 3U);
    const float expected[3][3] = {{0.0F, 0.22F, 0.0F}, {0.16F, 0.64F, 0.2F}, {0.56F, 1.0F, 0.6F}};
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(layers[i].near, expected[i][0], 1e-6);
        EXPECT_NEAR(layers[i].far, expected[i][1], 1e-6);
        EXPECT_NEAR(layers[i].begins, expected[i][2], 1e-6);
    }
    const auto fixed = pack::fixedDepthLayers(filter.moments);
    ASSERT_EQ(fixed.size(), 3U);
    EXPECT_EQ(fixed[1].near, layers[1].near);
}

TEST_F(LayersOfDepth, areOfOneWidthWhenUniform)
{
    for (std::uint32_t count = 2; count <= kMaxDepthLayers; ++count) {
        Placed placed(lvsm(LayerPlacement::uniform, count));
        const auto layers = placed.place(viewOf(kWhole), depthsOf());
        ASSERT_EQ(layers.size(), count);
        for (std::uint32_t i = 0; i < count; ++i) {
            EXPECT_NEAR(layers[i].begins, double(i) / count, 1e-6);
            EXPECT_NEAR(layers[i].far, std::min(1.0, (i + 1.05) / count), 1e-6);
        }
    }
    EXPECT_TRUE(pack::fixedDepthLayers(lvsm(LayerPlacement::lloyd, 2).moments).empty());
}

TEST_F(LayersOfDepth, relaxOnTheGpuAsOnTheCpu)
{
    const std::vector<float> depths = depthsOf();
    for (std::uint32_t count = 2; count <= kMaxDepthLayers; ++count) {
        Placed placed(lvsm(LayerPlacement::lloyd, count));
        const auto layers = placed.place(viewOf(kWhole), depths);
        const auto expected = lloydOnCpu(depths, static_cast<int>(count));
        ASSERT_EQ(layers.size(), count);
        for (std::uint32_t i = 0; i < count; ++i) {
            EXPECT_NEAR(layers[i].begins, expected[i], 1e-5) << count << " layers, " << i;
        }
        // Not what they started from: things in the air have a layer of their own.
        EXPECT_GT(layers[1].begins, 0.15F);
        EXPECT_LT(layers[1].begins, 0.65F);
    }
}

TEST_F(LayersOfDepth, followWhatIsStoredUnderASpot)
{
    ShadowOptions filter = lvsm(LayerPlacement::lloyd, 4);
    filter.moments.metric = DepthMetricKind::z_over_w;
    View view = viewOf(kWhole);
    view.projection.orthographic = false;
    view.projection.parallel = false;
    view.projection.metric.near_m = 5.0;
    view.projection.metric.far_m = 100.0;
    Placed placed(filter);
    const std::vector<float> depths = depthsOf();
    const auto layers = placed.place(view, depths);
    const auto expected = lloydOnCpu(depths, 4, shared::kMomentZOverW, 0.05);
    for (std::size_t i = 0; i < layers.size(); ++i) {
        EXPECT_NEAR(layers[i].begins, expected[i], 1e-5) << i;
    }
}

TEST_F(LayersOfDepth, lookAtTheirTileOnly)
{
    // A view's depths begin at the image's first texel, wherever its tile is. The half of the image that is not the
    // view's own holds one depth.
    std::vector<float> depths = depthsOf();
    std::vector<float> own;
    for (std::size_t i = 0; i < depths.size(); ++i) {
        if (i % kSide >= kSide / 2) {
            depths[i] = 0.5F;
        } else {
            own.push_back(depths[i]);
        }
    }
    Placed placed(lvsm(LayerPlacement::lloyd, 3));
    const auto layers = placed.place(viewOf({0, kSide / 2, 0, kSide / 2, kSide}), depths);
    const auto expected = lloydOnCpu(own, 3);
    for (std::size_t i = 0; i < layers.size(); ++i) {
        EXPECT_NEAR(layers[i].begins, expected[i], 1e-5);
    }
}

TEST_F(LayersOfDepth, stayInAStillScene)
{
    Placed placed(lvsm(LayerPlacement::lloyd, 8));
    const auto first = placed.place(viewOf(kWhole), depthsOf());
    for (int frame = 0; frame < 3; ++frame) {
        const auto next = placed.place(viewOf(kWhole), depthsOf());
        for (std::size_t i = 0; i < first.size(); ++i) {
            EXPECT_EQ(next[i].begins, first[i].begins) << i;
            EXPECT_EQ(next[i].near, first[i].near);
            EXPECT_EQ(next[i].far, first[i].far);
        }
    }
}

// Maps that stand still have layers that do, whatever comes into view, until that gathers elsewhere.
TEST_F(LayersOfDepth, standStillWhereAMotionHoldsMaps)
{
    for (const Motion motion : {Motion::snap, Motion::step_blend}) {
        Placed placed(lvsm(LayerPlacement::lloyd, 2));
        const auto first = placed.place(viewOf(kWhole), depthsOf(), motion);
        const auto rest = lloydOnCpu(depthsOf(), 2);
        for (std::size_t i = 0; i < first.size(); ++i) {
            EXPECT_NEAR(first[i].begins, rest[i], 1e-5) << i; // new ones rest at once
        }
        for (int frame = 1; frame <= 3; ++frame) {
            const auto next = placed.place(viewOf(kWhole), depthsOf(0.02F * static_cast<float>(frame)), motion);
            for (std::size_t i = 0; i < first.size(); ++i) {
                EXPECT_EQ(next[i].begins, first[i].begins) << i;
                EXPECT_EQ(next[i].near, first[i].near);
                EXPECT_EQ(next[i].far, first[i].far);
            }
        }
        const std::vector<float> sunk = depthsOf(0.1F);
        const auto sunk_rest = lloydOnCpu(sunk, 2);
        const auto after = placed.place(viewOf(kWhole), sunk, motion);
        for (std::size_t i = 0; i < after.size(); ++i) {
            EXPECT_NEAR(after[i].begins, sunk_rest[i], 1e-5) << i; // off, and so at rest again
        }
    }
}

TEST_F(LayersOfDepth, keepTheirPlaceInTheWorldWhenTheLightIsBackedOut)
{
    // All depths are 0.05 larger because they are measured from 5 m farther up: the layers go with them at once.
    Placed placed(lvsm(LayerPlacement::lloyd, 4));
    const auto before = placed.place(viewOf(kWhole), depthsOf());
    const auto after = placed.place(viewOf(kWhole, {0.0, -1.0, 0.0}, 5.0), depthsOf(0.05F));
    for (std::size_t i = 1; i < before.size(); ++i) {
        EXPECT_NEAR(after[i].begins, before[i].begins + 0.05, 1e-3) << i; // bins are as wide
    }
}

TEST_F(LayersOfDepth, beginAnewForAnotherLight)
{
    Placed placed(lvsm(LayerPlacement::lloyd, 3));
    std::vector<float> shallow = depthsOf();
    for (float& depth : shallow) {
        depth = depth < 1.0F ? 0.2F * depth : 1.0F;
    }
    (void)placed.place(viewOf(kWhole), shallow);
    View other = viewOf(kWhole);
    other.light = 1;
    const auto layers = placed.place(other, depthsOf());
    const auto expected = lloydOnCpu(depthsOf(), 3);
    for (std::size_t i = 0; i < layers.size(); ++i) {
        EXPECT_NEAR(layers[i].begins, expected[i], 1e-5);
    }
}

TEST_F(LayersOfDepth, areTheirMapsOwnWhoeverElseIsThere)
{
    vulkan::Device device(gpu().view());
    vulkan::LayerPlacer placer(device, resolvedOrThrow(lvsm(LayerPlacement::lloyd, 2)), VK_NULL_HANDLE);
    const auto planWith = [](std::initializer_list<std::uint32_t> maps) {
        std::vector<View> views;
        for (const std::uint32_t map : maps) {
            views.push_back(viewOf({map, 0, 0, 64, 64}));
            views.back().place.map = {map, 0};
        }
        Plan plan = planOf(views);
        plan.map_count = 3;
        return plan;
    };
    const Plan first = planWith({0, 1});
    const Plan second = planWith({2});
    const Plan third = planWith({2, 1});
    EXPECT_TRUE(placer.prepare(first));
    EXPECT_GE(placer.bytes(), 3 * sizeof(shared::GpuDepthLayers)) << "for maps that are not in sight, too";
    const std::uint32_t slot_of_b = placer.slotOf(first, 1);
    EXPECT_NE(placer.slotOf(first, 0), slot_of_b);
    EXPECT_FALSE(placer.prepare(second));
    EXPECT_NE(placer.slotOf(second, 0), slot_of_b) << "nobody takes the layers of a map that is not in sight";
    EXPECT_FALSE(placer.prepare(third));
    EXPECT_EQ(placer.slotOf(third, 1), slot_of_b);
}

} // namespace
} // namespace gnomon::test
