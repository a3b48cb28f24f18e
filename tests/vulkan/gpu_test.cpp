// SPDX-License-Identifier: Apache-2.0
// The renderer's work beyond filtering, on a real device: reuse of maps, clamping, alpha masks, ids, normals, timing.
#include "fixture.h"

#include <gtest/gtest.h>

namespace gnomon::test {
namespace {

using vulkan::MapPass;

constexpr VkExtent2D kScreen{160, 100};

class OnGpu : public testing::Test {
protected:
    void TearDown() override { expectSilence(gpu()); }
};

// How much of two masks differs by more than `tolerance` of 255.
double shareOfDifferent(std::span<const std::byte> a, std::span<const std::byte> b, int tolerance)
{
    EXPECT_EQ(a.size(), b.size());
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        count += std::abs(std::to_integer<int>(a[i]) - std::to_integer<int>(b[i])) > tolerance ? 1 : 0;
    }
    return double(count) / double(a.size());
}

TEST_F(OnGpu, viewsThatHoldKeepTheirTexels)
{
    // Both views share one layer: drawing one must leave the other's tile alone.
    for (const MapFormat format : {MapFormat::d32f, MapFormat::r32f}) {
        Bench bench(kScreen, format);
        bench.setLights({makeSun({0.8, -0.9, -0.35}), makeSpot({-6.0, 9.0, 5.0}, {0.0, 0.0, 0.0}, 0.6)},
                        {{0, 0, 0, 256, 256}, {0, 256, 0, 256, 256}}, {512, 256, 1});
        bench.prepare();
        bench.record(1);
        const auto before = bench.readMap(0);
        bench.plan.views[0].contents.redraw = false;
        bench.plan.views[1].contents.redraw = true;
        bench.plan.views[1].casters.count = 0; // now it is drawn empty
        bench.record(2);
        const auto after = bench.readMap(0);
        std::size_t kept = 0;
        std::size_t cleared = 0;
        for (std::size_t y = 0; y < 256; ++y) {
            for (std::size_t x = 0; x < 256; ++x) {
                kept += after[y * 512 + x] == before[y * 512 + x] ? 1 : 0;
                cleared += after[y * 512 + 256 + x] == 1.0F ? 1 : 0;
            }
        }
        EXPECT_EQ(kept, 256U * 256U);
        EXPECT_EQ(cleared, 256U * 256U);
    }
}

TEST_F(OnGpu, castersBeforeTheNearPlaneAreClampedOrCut)
{
    Bench bench(kScreen, MapFormat::d32f);
    bench.scene.boxes = {{{0.0, 22.0, 0.0}, {2.0, 0.5, 2.0}, 0.0}}; // above the near plane, 15 m up
    bench.setLights({makeSun({0.0, -1.0, 0.0})}, {{0, 0, 0, 128, 128}}, {128, 128, 1});
    bench.prepare();
    bench.record(1);
    EXPECT_EQ(bench.readMap(0)[64 * 128 + 64], 0.0F) << "clamped onto the near plane";
    bench.plan.views[0].projection.clamp_near = false;
    bench.record(1);
    EXPECT_NEAR(bench.readMap(0)[64 * 128 + 64], 15.0 / 45.0, 1e-5) << "cut: the ground shows";
}

TEST_F(OnGpu, normalsFromDepthAgreeWithGivenOnes)
{
    Bench bench(kScreen, MapFormat::d32f);
    bench.setLights({makeSun({0.8, -0.9, -0.35})}, {{0, 0, 0, 512, 512}}, {512, 512, 1});
    bench.prepare();
    bench.record(1);
    const auto given = bench.readMask(0);
    bench.inputs.normal = VK_NULL_HANDLE;
    bench.record(1);
    EXPECT_LT(shareOfDifferent(given, bench.readMask(0), 8), 0.01);
}

TEST_F(OnGpu, depthDirectionDoesNotMatter)
{
    Bench reversed(kScreen, MapFormat::d32f);
    Bench forward(kScreen, MapFormat::d32f, false);
    for (Bench* bench : {&reversed, &forward}) {
        bench->setLights({makeSun({0.8, -0.9, -0.35})}, {{0, 0, 0, 512, 512}}, {512, 512, 1});
        bench->prepare();
        bench->record(1);
    }
    EXPECT_LT(shareOfDifferent(reversed.readMask(0), forward.readMask(0), 8), 0.002);
}

TEST_F(OnGpu, receiversWithIdZeroAreLit)
{
    Bench bench(kScreen, MapFormat::d32f);
    bench.setLights({makeSun({0.8, -0.9, -0.35})}, {{0, 0, 0, 512, 512}}, {512, 512, 1});
    std::vector<std::uint32_t> ids = bench.picture.object_plus_one;
    for (std::uint32_t& id : ids) {
        id = id == 1 ? 0 : id; // the ground wants no shadow
    }
    bench.prepare();
    bench.record(1);
    const auto plain = bench.readMask(0);
    bench.inputs.object_id = gpu().makeImage(VK_FORMAT_R32_UINT, kScreen, std::as_bytes(std::span(ids))).view;
    bench.record(1);
    const auto masked = bench.readMask(0);
    std::size_t relit = 0;
    for (std::size_t i = 0; i < ids.size(); ++i) {
        EXPECT_EQ(masked[i], ids[i] == 0 ? std::byte{255} : plain[i]);
        relit += masked[i] != plain[i] ? 1 : 0;
    }
    EXPECT_GT(relit, 100U);
}

TEST_F(OnGpu, profilerCountsWhatWasDrawn)
{
    Bench bench(kScreen, MapFormat::d32f);
    bench.setLights({makeSun({0.8, -0.9, -0.35})}, {{0, 0, 0, 256, 256}}, {256, 256, 1});
    bench.prepare();
    vulkan::Profiler profiler(gpu().view(), 1, 4);
    bench.record(1, &profiler);
    const auto results = profiler.results(0);
    ASSERT_EQ(results.size(), 2U);
    EXPECT_STREQ(results[0].name, "shadow maps");
    EXPECT_STREQ(results[1].name, "mask");
    EXPECT_GT(results[0].milliseconds.value_or(1.0), 0.0) << "where the queue has timestamps";
    EXPECT_EQ(results[0].draws, 2U);
    EXPECT_EQ(results[0].has_statistics, gpu().view().features.statistics);
    if (!results[0].has_statistics) {
        GTEST_SKIP() << "the device has no pipelineStatisticsQuery";
    }
    EXPECT_GE(results[0].vertex_invocations, 4 + 8 * bench.scene.boxes.size());
    EXPECT_GE(results[1].fragment_invocations, kScreen.width * kScreen.height);
    EXPECT_EQ(results[1].compute_invocations, 0U);
}

} // namespace
} // namespace gnomon::test
