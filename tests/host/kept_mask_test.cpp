// SPDX-License-Identifier: Apache-2.0
// Frames in which nothing moves keep their mask, and show what frames show that draw it.
#include "host/frame_renderer.h"
#include "small_scene.h"

#include "scene/state.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::host::test {
namespace {

RenderOptions smallOptions(Filter filter = Filter::pcf)
{
    RenderOptions options;
    options.width = 96;
    options.height = 60;
    options.shadow.map_size = 128;
    options.shadow.technique.filter = filter;
    options.shadow.volumes.open = OpenCasters::skip;
    return options;
}

/// One renderer that keeps masks, and one that draws them all, of the same scene.
struct Both {
    explicit Both(RenderOptions options, scene::Scene the_scene = smallScene())
        : scene(std::move(the_scene)), state(scene::evaluate(scene, 0.0)), gpu({.gpu = "software", .validate = true}),
          uploaded(std::in_place, gpu, scene, state), keeps(std::in_place, *uploaded, options),
          lights(lightsOf(scene, state))
    {
        options.reuse_masks = false;
        draws.emplace(*uploaded, options);
    }
    ~Both()
    {
        keeps.reset();
        draws.reset();
        uploaded.reset();
        EXPECT_EQ(gpu.messages(), std::vector<std::string>{});
    }
    /// Was the mask kept?
    bool frame()
    {
        const FrameTimes times = keeps->draw(state, eye, lights);
        EXPECT_FALSE(draws->draw(state, eye, lights).mask_kept);
        const WantedImages wanted{.colour = true, .masks = keeps->options().compact_mask.channels == 0};
        const Picture picture = keeps->read(wanted);
        const Picture other = draws->read(wanted);
        EXPECT_TRUE(picture.colour.values == other.colour.values);
        for (std::size_t i = 0; i < other.masks.size(); ++i) {
            EXPECT_TRUE(picture.masks[i].values == other.masks[i].values) << "light " << i;
        }
        const bool drawn = std::ranges::any_of(
            times.passes, [](const vulkan::PassRecord& pass) { return std::string_view(pass.name) == "mask"; });
        EXPECT_NE(drawn, times.mask_kept);
        return times.mask_kept;
    }
    /// A map whose light has come to rest is drawn in parts some frames later, and that is a map that is drawn.
    bool settles()
    {
        constexpr int kMost = 8;
        int count = 0;
        while (count < kMost && !frame()) {
            ++count;
        }
        return count < kMost;
    }
    void change(const std::function<void(FrameRenderer&)>& how)
    {
        how(*keeps);
        how(*draws);
    }

    scene::Scene scene;
    scene::State state;
    Gpu gpu;
    std::optional<SceneOnGpu> uploaded;
    std::optional<FrameRenderer> keeps;
    std::optional<FrameRenderer> draws;
    std::vector<ShadedLight> lights;
    Eye eye = smallEye();
};

/// Frames between that show none, or are looked at from elsewhere, leave nothing that is taken for this frame's.
TEST(KeptMask, OutlivesOtherFrames)
{
    Both both(smallOptions());
    (void)both.frame();
    EXPECT_TRUE(both.frame());
    Eye beside = both.eye;
    beside.position_ws.x += 0.5;
    both.change([&](FrameRenderer& one) { one.drawAgain(both.state, beside, both.lights); });
    EXPECT_FALSE(both.frame());
    EXPECT_TRUE(both.frame());
    const std::vector<ImageF> lit(both.lights.size(), ImageF(96, 60, 1, 1.0F));
    both.change([&](FrameRenderer& one) { one.draw(both.state, both.eye, both.lights, &lit); });
    EXPECT_TRUE(both.frame()) << "the library's mask is as it was";
}

TEST(KeptMask, IsNoneWhereMapsAreDrawnOrPixelsMove)
{
    RenderOptions redrawn = smallOptions();
    redrawn.reuse_maps = false;
    RenderOptions average = smallOptions();
    average.average_pixels = true;
    for (const RenderOptions& options : {redrawn, average}) {
        Both both(options);
        for (int i = 0; i < 3; ++i) {
            EXPECT_FALSE(both.frame());
        }
    }
}

} // namespace
} // namespace gnomon::host::test
