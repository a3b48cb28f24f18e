// SPDX-License-Identifier: Apache-2.0
// Maps read back as plain numbers, whatever they are stored in.
#include "small_scene.h"

#include "scene/state.h"

#include <gnomon/choices.h>
#include <gnomon/error.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace gnomon::host::test {
namespace {

ImageF mapIn(Gpu& gpu, MapFormat format)
{
    const scene::Scene scene = smallScene();
    const scene::State state = scene::evaluate(scene, 0.0);
    RenderOptions options;
    options.width = 32;
    options.height = 32;
    options.plan.map_size = 64;
    options.filter.format = format;
    Renderer renderer(gpu, scene, state, options);
    renderer.draw(state, smallEye(), lightsOf(scene, state));
    EXPECT_TRUE(renderer.depthLayers(0).empty());
    EXPECT_TRUE(renderer.depthLayers(1000).empty());
    EXPECT_EQ(renderer.filterCost().texels, 0U) << "pcf has nothing to blur";
    EXPECT_THROW((void)renderer.readMap(1000), Error);
    return renderer.readMap(0);
}

TEST(ReadMap, GivesTheSameDepthsFromEveryFormat)
{
    Gpu gpu({.gpu = "software", .validate = true});
    const ImageF depth = mapIn(gpu, MapFormat::d32f);
    ASSERT_EQ(depth.channels, 1U);
    EXPECT_LT(*std::min_element(depth.values.begin(), depth.values.end()), 1.0F);
    for (std::uint8_t i = 0; i <= static_cast<std::uint8_t>(MapFormat::r16f); ++i) {
        const auto format = static_cast<MapFormat>(i);
        if (refusal(Filter::pcf, format)) {
            continue;
        }
        const ImageF map = mapIn(gpu, format);
        ASSERT_EQ(map.values.size(), depth.values.size()) << int{i};
        for (std::size_t t = 0; t < map.values.size(); ++t) {
            ASSERT_NEAR(map.values[t], depth.values[t], 1e-3F) << int{i} << " at " << t;
        }
    }
    for (const std::string& message : gpu.messages()) {
        ADD_FAILURE() << message;
    }
}

} // namespace
} // namespace gnomon::host::test
