// SPDX-License-Identifier: Apache-2.0
// Where filterable maps end: the largest exponents that a format holds, and maps that hold, which cost nothing.
#include "moment_bench.h"
#include "moment_images.h"
#include "moment_numbers.h"
#include "null_driver.h"

#include <glm/gtc/packing.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace gnomon::test {
namespace {

bool fits(MapFormat format, double value)
{
    const bool half = format == MapFormat::r16f || format == MapFormat::rg16f || format == MapFormat::rgba16f;
    const auto single = static_cast<float>(value);
    return std::isfinite(half ? glm::unpackHalf1x16(glm::packHalf1x16(single)) : single);
}

// ESM stores e^c and EVSM e^2c, of the far plane.
TEST(LargestExponent, isTheLargestThatTheFormatHoldsButForRoomForSums)
{
    const MomentOptions options;
    for (const MapFormat format : {MapFormat::r16f, MapFormat::r32f, MapFormat::rg16f, MapFormat::rg32f,
                                   MapFormat::rgba16f, MapFormat::rgba32f}) {
        const bool esm = format == MapFormat::r16f || format == MapFormat::r32f;
        const double c = largestExponent(esm ? Filter::esm : Filter::evsm, format, options);
        const double stored = esm ? c : 2.0 * c;
        EXPECT_TRUE(fits(format, std::exp(stored))) << nameOf(format) << ", " << c;
        EXPECT_FALSE(fits(format, std::exp(stored * 1.06))) << nameOf(format) << ", " << c;
    }
}

// An exponent is one of depths 0 to 1, whatever is stored.
TEST(MomentExponents, meanTheSameOfRemappedDepths)
{
    for (const Filter which : {Filter::esm, Filter::evsm}) {
        for (const bool given : {false, true}) {
            ShadowOptions filter = momentFilter(which, filterTraits(which)->formats.front());
            if (given) {
                filter.moments.esm_exponent = 30.0F;
                filter.moments.evsm_positive = 30.0F;
                filter.moments.evsm_negative = 3.0F;
            }
            const MomentNumbers plain = momentNumbers(filter);
            filter.moments.remap = true;
            const MomentNumbers remapped = momentNumbers(filter);
            EXPECT_EQ(2.0 * remapped.exponent, plain.exponent); // of a coordinate that is twice as long
            EXPECT_EQ(2.0 * remapped.exponent_negative, plain.exponent_negative);
        }
    }
}

// A tile's level exists where its edges lie on the level's grid, and no map has more than its tiles can use.
TEST(MipLevels, areThoseThatATileCanHave)
{
    ShadowOptions filter = momentFilter(Filter::vsm, MapFormat::rg32f);
    filter.moments.sampling = MapSampling::trilinear;
    const std::pair<std::uint32_t, std::uint32_t> cases[] = {{1, 1},    {2, 2},    {767, 1},  {768, 8}, {770, 2},
                                                             {1000, 4}, {1024, 8}, {1025, 1}, {64, 7}};
    for (const auto& [side, levels] : cases) {
        EXPECT_EQ(levelsOf(filter, {side, side, 1}), levels) << side;
        EXPECT_EQ(coarsestOf({0, 0, 0, side, side}, levelsOf(filter, {side, side, 1})), levels - 1) << side;
    }
    EXPECT_EQ(levelsOf(filter, {1024, 514, 1}), 2U) << "the side with fewer decides";
    filter.moments.sampling = MapSampling::bilinear;
    EXPECT_EQ(levelsOf(filter, {1024, 1024, 1}), 1U);
}

TEST(ScratchStrips, areAsNarrowAsBlocksOrHaveALayerEach)
{
    using pack::stripsOf;
    EXPECT_EQ(stripsOf(2048, 1, 2048).width, 32U);
    EXPECT_EQ(stripsOf(2048, 1, 2048).count, 64U);
    EXPECT_EQ(stripsOf(17, 4, 2048).count, 1U);
    EXPECT_EQ(stripsOf(33, 1, 2048).count, 2U);
    EXPECT_EQ(stripsOf(16384, 4, 256).width, 256U);
    EXPECT_EQ(stripsOf(16384, 4, 256).count, 64U);
    EXPECT_EQ(stripsOf(16384, 4, 255).width, 512U) << "256 layers would be one too many";
}

ShadowOptions blurred(BlurPath path)
{
    ShadowOptions options = momentFilter(Filter::vsm, MapFormat::rg32f);
    options.moments.blur = BlurKind::gaussian;
    options.moments.blur_path = path;
    return options;
}

TEST(MomentCounts, areMadeVisibleToTheHostLast)
{
    for (const BlurPath path : {BlurPath::compute, BlurPath::fragment}) {
        using Kind = NullEvent::Kind;
        NullDriver driver;
        vulkan::ShadowRenderer renderer(driver.view(), {});
        Plan plan = momentPlan(makeScene());
        plan.options = planOptions(blurred(path));
        (void)renderer.prepare(plan, {8, 8});
        renderer.recordMaps(driver.commands(), 0, plan, [](const vulkan::MapPass&) {});
        const auto events = driver.events();
        const auto last_work = std::find_if(events.rbegin(), events.rend(), [](const NullEvent& event) {
            return event.kind == Kind::dispatch || event.kind == Kind::end_rendering;
        });
        ASSERT_NE(last_work, events.rend());
        EXPECT_TRUE(std::any_of(events.rbegin(), last_work, [](const NullEvent& event) {
            return event.kind == Kind::memory_barrier && event.target_stages == VK_PIPELINE_STAGE_2_HOST_BIT &&
                   event.target_access == VK_ACCESS_2_HOST_READ_BIT;
        })) << nameOf(path);
    }
}

TEST(MomentsAtRest, takeNoShaderAtAll)
{
    for (const BlurPath path : {BlurPath::compute, BlurPath::fragment}) {
        const Scene scene = makeScene();
        Plan plan = momentPlan(scene);
        plan.options = planOptions(blurred(path));
        vulkan::ShadowRenderer renderer(gpu().view(), {.frames_in_flight = 1});
        vulkan::CasterDrawerOptions drawer_options;
        drawer_options.frames_in_flight = 1;
        vulkan::CasterDrawer drawer(gpu().view(), drawer_options);
        const SceneMesh mesh = uploadMesh(gpu(), scene);
        drawer.setScene(mesh.parts, mesh.objects, mesh.batches);
        const auto transforms = scene.transforms();
        vulkan::Profiler profiler(gpu().view(), 1, 8);
        (void)renderer.prepare(plan, {8, 8});
        for (const bool redraw : {true, false}) {
            for (View& view : plan.views) {
                view.contents.redraw = redraw;
            }
            gpu().run([&](VkCommandBuffer commands) {
                profiler.beginFrame(commands, 0);
                drawer.beginFrame(0, plan, mesh.geometry, transforms);
                renderer.recordMaps(
                    commands, 0, plan, [&](const vulkan::MapPass& pass) { drawer.draw(pass); }, &profiler);
            });
            std::uint64_t invocations = 0;
            for (const auto& pass : profiler.results(0)) {
                invocations += pass.compute_invocations + pass.fragment_invocations + pass.vertex_invocations;
            }
            EXPECT_EQ(invocations > 0, redraw) << nameOf(path) << ", " << invocations;
        }
        expectSilence(gpu());
    }
}

} // namespace
} // namespace gnomon::test
