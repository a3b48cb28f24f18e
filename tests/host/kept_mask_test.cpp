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

TEST(KeptMask, IsDrawnAnewWhateverChanges)
{
    for (const Filter filter : {Filter::pcf, Filter::volumes}) {
        Both both(smallOptions(filter));
        struct Change {
            const char* what;
            std::function<void()> make;
        };
        const std::vector<Change> changes{
            {"eye",
             [&] {
                 both.eye.position_ws.x += 0.1;
             }},
            {"field of view",
             [&] {
                 both.eye.fov_y_rad *= 1.05;
             }},
            {"what moves and deforms",
             [&] {
                 scene::advance(both.scene, 1.5, both.state);
             }},
            {"and moves on",
             [&] {
                 scene::advance(both.scene, 1.6, both.state);
             }},
            {"light",
             [&] {
                 both.lights[0].caster.direction_ws = glm::normalize(glm::dvec3(0.4, -1.0, 0.2));
             }},
            {"light that goes",
             [&] {
                 both.lights.pop_back();
             }},
            {"size",
             [&] {
                 both.change([](FrameRenderer& one) { one.resize(80, 50); });
             }},
            {"technique",
             [&] {
                 both.change([](FrameRenderer& one) { one.setShadows(smallOptions(Filter::hard).shadow); });
             }},
            {"technique of before",
             [&] {
                 both.change([&](FrameRenderer& one) { one.setShadows(smallOptions(filter).shadow); });
             }},
        };
        for (const Change& change : changes) {
            EXPECT_TRUE(both.settles()) << change.what;
            change.make();
            EXPECT_FALSE(both.frame()) << change.what;
        }
    }
}

TEST(KeptMask, GoesOnWithFramesInFlight)
{
    for (const std::uint32_t frames : {1U, 2U, 3U}) {
        for (const std::uint32_t channels : {0U, 4U}) {
            RenderOptions options = smallOptions();
            options.frames_in_flight = frames;
            options.compact_mask.channels = channels;
            Both both(options);
            EXPECT_FALSE(both.frame());
            for (std::uint32_t i = 0; i < frames + 2; ++i) {
                // Several are on their way before the one that is read.
                both.change([&](FrameRenderer& one) {
                    for (std::uint32_t ahead = 0; ahead < frames; ++ahead) {
                        one.submit(both.state, both.eye, both.lights);
                    }
                });
                EXPECT_TRUE(both.frame());
            }
            scene::advance(both.scene, 0.7, both.state);
            EXPECT_FALSE(both.frame());
            EXPECT_TRUE(both.frame());
        }
    }
}

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
