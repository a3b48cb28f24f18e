// SPDX-License-Identifier: Apache-2.0
// Where filterable maps end: the largest exponents that a format holds, and maps that hold, which cost nothing.
#include "moment_bench.h"

#include <glm/gtc/packing.hpp>
#include <gtest/gtest.h>

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

TEST(MomentsAtRest, takeNoShaderAtAll)
{
    for (const BlurPath path : {BlurPath::compute, BlurPath::fragment}) {
        const Scene scene = makeScene();
        Plan plan = momentPlan(scene);
        vulkan::ShadowRendererOptions options;
        options.filter = momentFilter(Filter::vsm, MapFormat::rg32f);
        options.filter.moments.blur = BlurKind::gaussian;
        options.filter.moments.blur_path = path;
        options.frames_in_flight = 1;
        vulkan::ShadowRenderer renderer(gpu().view(), options);
        vulkan::CasterDrawerOptions drawer_options;
        drawer_options.orthographic = renderer.mapFormats(true);
        drawer_options.perspective = renderer.mapFormats(false);
        drawer_options.frames_in_flight = 1;
        vulkan::CasterDrawer drawer(gpu().view(), drawer_options);
        const SceneMesh mesh = uploadMesh(gpu(), scene);
        drawer.setScene(mesh.parts, mesh.objects, mesh.batches);
        const auto transforms = scene.transforms();
        vulkan::Profiler profiler(gpu().view(), 1, 8);
        (void)renderer.prepare(plan, {8, 8});
        for (const bool redraw : {true, false}) {
            for (View& view : plan.views) {
                view.redraw = redraw;
            }
            const Frame frame;
            gpu().run([&](VkCommandBuffer commands) {
                profiler.beginFrame(commands, 0);
                drawer.beginFrame(0, plan, mesh.geometry, transforms);
                renderer.recordMaps(
                    commands, 0, frame, plan, [&](const vulkan::MapPass& pass) { drawer.draw(pass); }, &profiler);
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
