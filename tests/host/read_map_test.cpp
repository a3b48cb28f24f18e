// SPDX-License-Identifier: Apache-2.0
// Maps read back as plain numbers, whatever they are stored in.
#include "host/frame_renderer.h"
#include "scene/state.h"
#include "worlds/worlds.h"

#include <gnomon/choices.h>
#include <gnomon/error.h>
#include <gnomon/pack/filter_rule.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>

namespace gnomon::host::test {
namespace {

/// One caster over a ground: everything that a map needs, and little to compile.
ImageF mapIn(Gpu& gpu, Filter filter, MapFormat format)
{
    static const scene::Scene scene = worlds::load("planes", 1);
    static const scene::State state = scene::evaluate(scene, 0.0);
    RenderOptions options;
    options.width = 16;
    options.height = 16;
    options.shadow.map_size = 32;
    options.shadow.technique.filter = filter;
    options.shadow.format = format;
    options.shadow.moments.samples = 1;
    options.shadow.moments.blur = BlurKind::none;
    options.shadow.moments.sampling = MapSampling::bilinear;
    const SceneOnGpu uploaded(gpu, scene, state);
    FrameRenderer renderer(uploaded, options);
    const Eye eye{.position_ws = {6.0, 5.0, 9.0}, .target_ws = {0.0, 0.0, 0.0}};
    renderer.draw(state, eye, lightsOf(scene, state));
    EXPECT_TRUE(renderer.depthLayers(0).empty());
    EXPECT_TRUE(renderer.depthLayers(1000).empty());
    EXPECT_EQ(renderer.filterCost().texels, 0U) << "there is nothing to blur";
    EXPECT_THROW((void)renderer.readMap(1000), Error);
    return renderer.readMap(0);
}

TEST(ReadMap, GivesTheSameDepthsFromEveryFormat)
{
    Gpu gpu({.gpu = "software", .validate = true});
    const ImageF depth = mapIn(gpu, Filter::pcf, MapFormat::d32f);
    ASSERT_EQ(depth.channels, 1U);
    EXPECT_LT(*std::min_element(depth.values.begin(), depth.values.end()), 1.0F);
    for (std::uint8_t i = 0; i <= static_cast<std::uint8_t>(MapFormat::rgba8); ++i) {
        const auto format = static_cast<MapFormat>(i);
        if (refusal(Filter::pcf, format)) {
            continue;
        }
        const ImageF map = mapIn(gpu, Filter::pcf, format);
        ASSERT_EQ(map.values.size(), depth.values.size() * map.channels) << int{i};
        ShadowOptions filter{.technique = kPlainTechnique};
        filter.technique.filter = Filter::pcf;
        filter.format = format; // some have two depths a texel, and one of them in two channels
        for (std::size_t t = 0; t < depth.values.size(); ++t) {
            const std::span texel = std::span(map.values).subspan(t * map.channels, map.channels);
            ASSERT_NEAR(pack::mapDepth(resolvedOrThrow(filter), texel), depth.values[t], 1e-3F)
                << int{i} << " at " << t;
        }
    }
    for (const std::string& message : gpu.messages()) {
        ADD_FAILURE() << message;
    }
}

/// Two and four channels: powers of one depth without blur and with one sample; warped depths of the four of evsm.
TEST(ReadMap, GivesEveryChannelOfMomentsOfOneDepth)
{
    Gpu gpu({.gpu = "software", .validate = true});
    const ImageF depth = mapIn(gpu, Filter::pcf, MapFormat::d32f);
    const ImageF vsm = mapIn(gpu, Filter::vsm, MapFormat::rg32f);
    const ImageF msm = mapIn(gpu, Filter::msm, MapFormat::rgba32f);
    const ImageF evsm = mapIn(gpu, Filter::evsm, MapFormat::rgba32f);
    ASSERT_EQ(vsm.channels, 2U);
    ASSERT_EQ(msm.channels, 4U);
    ASSERT_EQ(evsm.channels, 4U);
    ASSERT_EQ(vsm.values.size(), 2 * depth.values.size());
    ASSERT_EQ(msm.values.size(), 4 * depth.values.size());
    ASSERT_EQ(evsm.values.size(), 4 * depth.values.size());
    for (std::size_t t = 0; t < depth.values.size(); ++t) {
        const float d = vsm.values[2 * t]; // receivers are in it too, so that it is not what pcf has
        ASSERT_NEAR(vsm.values[2 * t + 1], d * d, 1e-6F) << t;
        for (int power = 1; power <= 4; ++power) {
            ASSERT_NEAR(msm.values[4 * t + static_cast<std::size_t>(power) - 1], std::pow(2.0F * d - 1.0F, power),
                        2e-6F)
                << t;
        }
        for (const std::size_t first : {4 * t, 4 * t + 2}) { // a warped depth and its square, of either sign
            const float warped = evsm.values[first];
            ASSERT_TRUE(first == 4 * t ? warped > 0.0F : warped < 0.0F) << t;
            ASSERT_NEAR(evsm.values[first + 1] / (warped * warped), 1.0F, 1e-5F) << t;
        }
    }
    for (const std::string& message : gpu.messages()) {
        ADD_FAILURE() << message;
    }
}

} // namespace
} // namespace gnomon::host::test
