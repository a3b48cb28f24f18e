// SPDX-License-Identifier: Apache-2.0
// Frames pass by pass, and the least that passes have to move.
#include "lab/passes.h"

#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <vector>

namespace gnomon::lab {
namespace {

vulkan::PassRecord record(const char* name, double ms, std::uint64_t fragments)
{
    vulkan::PassRecord pass;
    pass.name = name;
    pass.milliseconds = ms;
    pass.has_statistics = true;
    pass.fragment_invocations = fragments;
    pass.draws = 1;
    return pass;
}

host::FrameTimes frame(std::initializer_list<vulkan::PassRecord> passes)
{
    host::FrameTimes times;
    for (const vulkan::PassRecord& pass : passes) {
        times.passes.push_back(pass);
    }
    return times;
}

TEST(Passes, OfOneNameAreOne)
{
    const std::array frames{
        frame({record("g-buffer", 5.0, 7), record("shadow maps", 1.0, 10), record("mask", 2.0, 4),
               record("shadow maps", 2.0, 20)}),
        frame({record("g-buffer", 7.0, 8), record("shadow maps", 4.0, 11), record("shadow maps", 5.0, 22)})};
    LeastByPass least;
    least.maps = PassLeast{100, 400};
    const std::vector<PassWork> passes = passesOf(frames, least);
    ASSERT_EQ(passes.size(), 3U);
    EXPECT_EQ(passes[0].name, "g-buffer");
    EXPECT_EQ(passes[0].ms.value().median, 6.0);
    EXPECT_EQ(passes[0].sum.fragment_invocations, 8U); // of the last frame
    EXPECT_FALSE(passes[0].least);
    EXPECT_EQ(passes[1].name, "shadow maps");
    EXPECT_EQ(passes[1].ms.value().median, 6.0); // of 3 and 9
    EXPECT_EQ(passes[1].ms.value().iqr, 3.0);
    EXPECT_EQ(passes[1].sum.fragment_invocations, 33U);
    EXPECT_EQ(passes[1].sum.draws, 2U);
    ASSERT_TRUE(passes[1].least);
    EXPECT_EQ(passes[1].least->bytes, 400U);
    EXPECT_EQ(passes[2].name, "mask");
    EXPECT_EQ(passes[2].ms.value().median, 1.0); // the last frame has none
    EXPECT_EQ(passes[2].sum.fragment_invocations, 0U);
    EXPECT_TRUE(passesOf({}, least).empty());
}

TEST(Passes, HaveNoTimeOnceOnePartIsNotMeasured)
{
    vulkan::PassRecord untimed = record("mask", 0.0, 4);
    untimed.milliseconds.reset();
    untimed.has_statistics = false;
    const std::array frames{frame({record("shadow maps", 1.0, 10), untimed}),
                            frame({record("shadow maps", 2.0, 10), record("mask", 2.0, 4), untimed})};
    const std::vector<PassWork> passes = passesOf(frames, {});
    ASSERT_EQ(passes.size(), 2U);
    EXPECT_EQ(passes[0].ms.value().median, 1.5);
    EXPECT_FALSE(passes[1].ms.has_value());
    EXPECT_FALSE(passes[1].sum.has_statistics);
}

Plan planOf(std::uint32_t side)
{
    Plan plan;
    plan.lights.resize(1);
    plan.mask_layers = 1;
    plan.views.resize(1);
    plan.views[0].place.tile.width = side;
    plan.views[0].place.tile.height = side;
    return plan;
}

TEST(LeastByPass, OfMapsOfDepthsAreTheirTexels)
{
    Plan plan = planOf(256);
    TrafficOptions options{.format = MapFormat::d16};
    const LeastByPass least = leastByPass(plan, 1000, options);
    ASSERT_TRUE(least.maps);
    EXPECT_EQ(least.maps->texels, 256U * 256U);
    EXPECT_EQ(least.maps->bytes, 2U * 256U * 256U);
    EXPECT_FALSE(least.filter);
    ASSERT_TRUE(least.mask);
    EXPECT_EQ(least.mask->texels, 1000U);
    EXPECT_EQ(least.mask->bytes, 5000U); // depth in, a byte out
    plan.views[0].contents.redraw = false;
    options.redraws_all = false;
    EXPECT_EQ(leastByPass(plan, 1000, options).maps->bytes, 0U);
    // Two lights have four channels written, and four samples to a pixel are four pixels.
    plan.lights.resize(2);
    options.samples = 4;
    EXPECT_EQ(leastByPass(plan, 1000, options).mask->bytes, 4U * 1000U * (4U + 4U));
    EXPECT_FALSE(leastByPass(Plan(), 1000, options).mask);
}

TEST(LeastByPass, OfHalfAMaskGoesThroughAQuarterOfIt)
{
    Plan plan = planOf(256);
    plan.lights[0].view_count = 1;
    const std::uint64_t whole = leastByPass(plan, 1000, {}).mask->bytes;
    const auto withSize = [&](MaskSize size) {
        ShadowOptions options{.technique = kPlainTechnique};
        options.mask_size = size;
        plan.options = std::make_shared<const std::vector<ResolvedOptions>>(1, resolvedOrThrow(options));
        return leastByPass(plan, 1000, {}).mask->bytes;
    };
    EXPECT_EQ(withSize(MaskSize::full), whole);
    EXPECT_EQ(withSize(MaskSize::half), whole + 2U * 250U); // written, and read again
    plan.lights.resize(2);
    EXPECT_EQ(withSize(MaskSize::half), 1000U * (4U + 4U) + 2U * 250U * 4U);
}

/// 8 + (1 + 4 + 5/3) b bytes a texel, less the levels' sums of which the last texel ends them.
TEST(LeastByPass, OfAFilteredMapIsTheClosedForm)
{
    constexpr std::uint64_t kTexels = 256 * 256;
    for (const MapFormat format : {MapFormat::rg32f, MapFormat::rgba32f, MapFormat::r32f}) {
        const Plan plan = planOf(256);
        const TrafficOptions options{
            .format = format, .mip_levels = 9, .filterable = true, .depth_samples = 1, .blurred = true};
        const LeastByPass least = leastByPass(plan, 1, options);
        const std::uint64_t b = texelBytes(format);
        EXPECT_EQ(least.maps->bytes, 4 * kTexels);
        const std::uint64_t levels = (kTexels - 1) / 3; // 128 x 128 + 64 x 64 + ... + 1
        EXPECT_EQ(least.filter->bytes, 4 * kTexels + 5 * b * kTexels + b * levels + b * (kTexels + levels - 1));
        const double a_texel = static_cast<double>(least.maps->bytes + least.filter->bytes) / kTexels;
        EXPECT_NEAR(a_texel, 8.0 + 20.0 / 3.0 * static_cast<double>(b), 1e-3 * a_texel);
    }
}

} // namespace
} // namespace gnomon::lab
