// SPDX-License-Identifier: Apache-2.0
// Cascades drawn each in a pass of its own and in one pass: the same maps, bit for bit.
#include "host/frame_renderer.h"
#include "scene/state.h"
#include "small_scene.h"

#include <gnomon/error.h>

#include <gtest/gtest.h>

#include <string>
#include <string_view>

namespace gnomon::host::test {
namespace {

struct PassCase {
    const char* name;
    Partition partition;
    Fit fit;
    Filter filter;
    MapFormat format;
    std::uint32_t count;
};

struct Drawn {
    std::vector<ImageF> maps;
    std::vector<ImageF> masks;
    std::uint32_t draws = 0; // of the maps
    std::uint64_t vertices = 0;
    std::uint32_t together = 0;
    std::vector<std::string> messages;
};

class CascadePasses : public testing::TestWithParam<PassCase> {
protected:
    RenderOptions optionsWith(CascadePass pass) const
    {
        RenderOptions options;
        options.width = 160;
        options.height = 100;
        options.shadow.technique.partition = GetParam().partition;
        options.shadow.technique.fit = GetParam().fit;
        options.shadow.technique.filter = GetParam().filter;
        options.shadow.cascades.count = GetParam().count;
        options.shadow.map_size = 128;
        options.shadow.format = GetParam().format;
        options.shadow.cascades.pass = pass;
        return options;
    }
    Drawn draw(CascadePass pass) const
    {
        Gpu gpu({.gpu = "software", .validate = true});
        const SceneOnGpu uploaded(gpu, scene_, state_);
        FrameRenderer renderer(uploaded, optionsWith(pass));
        EXPECT_EQ(renderer.cascadePass(), pass);
        const FrameTimes times = renderer.draw(state_, smallEye(), lights_);
        Drawn drawn;
        drawn.together = times.reuse.together;
        drawn.masks = renderer.read({.colour = false, .masks = true}).masks;
        for (const View& view : renderer.plan().views) {
            drawn.maps.push_back(renderer.readMap(view.place.tile.layer));
        }
        for (const vulkan::PassRecord& record : times.passes) {
            if (std::string_view(record.name) == "shadow maps") {
                drawn.draws += record.draws;
                drawn.vertices += record.vertex_invocations;
            }
        }
        drawn.messages = gpu.messages();
        return drawn;
    }

    scene::Scene scene_ = smallScene(); // a masked caster is in it
    scene::State state_ = scene::evaluate(scene_, 0.0);
    std::vector<ShadedLight> lights_ = lightsOf(scene_, state_);
};

TEST_P(CascadePasses, GiveTheSameMapsBitForBit)
{
    const Drawn each = draw(CascadePass::each);
    const Drawn layered = draw(CascadePass::layered);
    ASSERT_GT(each.maps.size(), GetParam().count) << "a sun's, and some of the spot's";
    ASSERT_EQ(layered.maps.size(), each.maps.size());
    for (std::size_t view = 0; view < each.maps.size(); ++view) {
        EXPECT_TRUE(each.maps[view].values == layered.maps[view].values) << "view " << view;
    }
    for (std::size_t light = 0; light < each.masks.size(); ++light) {
        EXPECT_EQ(each.masks[light].values, layered.masks[light].values) << "light " << light;
    }
    EXPECT_EQ(each.together, 0U);
    EXPECT_GE(layered.together, 2U);
    EXPECT_LT(layered.draws, each.draws);
    EXPECT_EQ(layered.vertices, each.vertices) << "what casts in a map is drawn to it, and no more";
    EXPECT_EQ(each.messages, std::vector<std::string>{});
    EXPECT_EQ(layered.messages, std::vector<std::string>{});
}

INSTANTIATE_TEST_SUITE_P(
    All, CascadePasses,
    testing::Values(PassCase{"pcf_d32f_2", Partition::cascades, Fit::uniform, Filter::pcf, MapFormat::d32f, 2},
                    PassCase{"hard_r32f_4", Partition::cascades, Fit::uniform, Filter::hard, MapFormat::r32f, 4},
                    PassCase{"pcf_lispsm_d16_6", Partition::cascades, Fit::lispsm, Filter::pcf, MapFormat::d16, 6},
                    PassCase{"pcf_sdsm_d32f_4", Partition::sdsm, Fit::uniform, Filter::pcf, MapFormat::d32f, 4},
                    PassCase{"hard_sdsm_tsm_r32f_3", Partition::sdsm, Fit::tsm, Filter::hard, MapFormat::r32f, 3}),
    [](const auto& one) { return std::string(one.param.name); });

TEST(CascadePassOptions, AreRefusedForMapsThatAreAveraged)
{
    const scene::Scene scene = smallScene();
    const scene::State state = scene::evaluate(scene, 0.0);
    Gpu gpu({.gpu = "software", .validate = true});
    RenderOptions options;
    options.width = 32;
    options.height = 20;
    options.shadow.technique.filter = Filter::vsm;
    options.shadow.format = MapFormat::rg16f;
    options.shadow.cascades.pass = CascadePass::layered;
    const SceneOnGpu uploaded(gpu, scene, state);
    EXPECT_THROW(FrameRenderer(uploaded, options), Error);
    options.shadow.cascades.pass = CascadePass::automatic;
    EXPECT_EQ(FrameRenderer(uploaded, options).cascadePass(), CascadePass::each);
}

} // namespace
} // namespace gnomon::host::test
