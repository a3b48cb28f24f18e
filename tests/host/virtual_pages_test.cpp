// SPDX-License-Identifier: Apache-2.0
// Partition virtual in a renderer: the mask of a frame says where the pages of frames to come are.
#include "host/frame_renderer.h"
#include "small_scene.h"

#include "scene/state.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace gnomon::host::test {
namespace {

class VirtualPages : public testing::TestWithParam<LightType> {
protected:
    /// The scene's sun alone, or its spot light, or that as a lamp.
    std::vector<ShadedLight> light()
    {
        std::vector<ShadedLight> all = lightsOf(scene, state);
        const bool sunny = GetParam() == LightType::directional;
        std::erase_if(all,
                      [&](const ShadedLight& one) { return (one.caster.type == LightType::directional) != sunny; });
        all.at(0).caster.type = GetParam();
        return all;
    }
    const scene::Scene scene = smallScene();
    const scene::State state = scene::evaluate(scene, 0.0);
    const std::vector<ShadedLight> lights = light();
};

std::string nameOfType(const testing::TestParamInfo<LightType>& info)
{
    return std::string(info.param == LightType::directional ? "sun" : info.param == LightType::spot ? "spot" : "point");
}

INSTANTIATE_TEST_SUITE_P(Types, VirtualPages,
                         testing::Values(LightType::directional, LightType::spot, LightType::point), nameOfType);

RenderOptions optionsOf(Technique technique, std::uint32_t texels)
{
    RenderOptions options;
    options.width = 320;
    options.height = 200;
    options.shadow.technique = technique;
    options.shadow.max_texels = texels;
    return options;
}

TEST_P(VirtualPages, FollowEdgesOfFramesBeforeAndComeToRest)
{
    ASSERT_EQ(lights.size(), 1U);
    Gpu gpu({.gpu = "software", .validate = true});
    {
        const SceneOnGpu uploaded(gpu, scene, state);
        FrameRenderer renderer(uploaded,
                               optionsOf({Partition::virtual_pages, Fit::uniform, Filter::raymarch}, 1U << 19U));
        std::vector<std::vector<double>> texels;
        for (int i = 0; i < 12; ++i) {
            renderer.draw(state, smallEye(), lights);
            const Plan& plan = renderer.plan();
            ASSERT_EQ(plan.lights[0].outcome.kind, OutcomeKind::ok) << plan.lights[0].outcome.reason;
            EXPECT_LE(plan.views.size(), 32U);
            std::vector<double>& sizes = texels.emplace_back();
            for (const View& view : plan.views)
                sizes.push_back(view.projection.texel_m);
        }
        EXPECT_NE(texels.front(), texels.back()) << "the picture has edges that boxes do not tell";
        EXPECT_EQ(texels[10], texels[11]);
        EXPECT_TRUE(std::ranges::none_of(renderer.plan().views, [](const View& view) { return view.contents.redraw; }));
    }
    EXPECT_EQ(gpu.messages(), std::vector<std::string>{});
}

/// Pages are parts of one map, so a picture by them is one by a single map, but for edges, which are finer.
TEST_P(VirtualPages, ShowWhatOneMapShows)
{
    Gpu gpu({.gpu = "software", .validate = true});
    const SceneOnGpu uploaded(gpu, scene, state);
    std::vector<ImageF> masks;
    const Partition whole = GetParam() == LightType::point ? Partition::cube : Partition::single;
    for (const Partition partition : {whole, Partition::virtual_pages}) {
        FrameRenderer renderer(uploaded, optionsOf({partition, Fit::uniform, Filter::pcf}, 1U << 22U));
        for (int i = 0; i < 4; ++i)
            renderer.draw(state, smallEye(), lights);
        masks.push_back(renderer.read({.colour = false, .masks = true}).masks.at(0));
    }
    EXPECT_LT(differing(masks[0], masks[1], 0.5F), masks[0].values.size() / 200);
    EXPECT_GT(differing(masks[0], ImageF(320, 200, 1), 0.5F), masks[0].values.size() / 200) << "there are shadows";
}

} // namespace
} // namespace gnomon::host::test
