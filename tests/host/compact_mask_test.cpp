// SPDX-License-Identifier: Apache-2.0
// Pictures that are shaded by a compact mask, against those with a channel for each light.
#include "host/frame_renderer.h"
#include "scene/state.h"

#include "small_scene.h"

#include <gnomon/error.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace gnomon::host::test {
namespace {

class CompactMaskPictures : public testing::Test {
protected:
    /// The scene's sun and lamp, and four lamps more at other places, one of which does not cast.
    [[nodiscard]] std::vector<ShadedLight> manyLights() const
    {
        std::vector<ShadedLight> lights = lightsOf(scene_, state_);
        for (std::uint32_t i = 0; i < 4; ++i) {
            ShadedLight lamp = lights[1];
            lamp.caster.key = 10 + i;
            lamp.caster.position_ws += glm::dvec3(1.0 * i - 1.5, 0.3 * i, 0.7 - 0.4 * i);
            lamp.caster.casts_shadow = i != 2;
            lights.push_back(lamp);
        }
        return lights;
    }
    [[nodiscard]] Picture draw(const pack::CompactMaskRule& rule, int frames = 1)
    {
        RenderOptions options;
        options.width = 128;
        options.height = 96;
        options.shadow.map_size = 256;
        options.compact_mask = rule;
        FrameRenderer renderer(uploaded_, options);
        for (int i = 0; i < frames; ++i) {
            renderer.draw(state_, smallEye(), manyLights());
        }
        return renderer.read({.colour = true});
    }
    void TearDown() override { EXPECT_EQ(gpu_.messages(), std::vector<std::string>{}); }

    Gpu gpu_{{.gpu = "software", .validate = true}};
    scene::Scene scene_ = smallScene();
    scene::State state_ = scene::evaluate(scene_, 1.0);
    SceneOnGpu uploaded_{gpu_, scene_, state_};
};

double worstDifference(const Image8& a, const Image8& b)
{
    double worst = 0.0;
    for (std::size_t i = 0; i < a.values.size(); ++i) {
        worst = std::max(worst, std::abs(double(a.values[i]) - double(b.values[i])));
    }
    return worst;
}

TEST_F(CompactMaskPictures, AreTheOrdinaryOnesWhereEveryLightHasAChannel)
{
    const Picture each = draw({});
    EXPECT_LE(worstDifference(draw({8, 16}).colour, each.colour), 1.0);
    EXPECT_LE(worstDifference(draw({8, 32}, 3).colour, each.colour), 1.0) << "every slot has lists";
}

TEST_F(CompactMaskPictures, HaveNoMaskForEachLight)
{
    RenderOptions options;
    options.width = 64;
    options.height = 48;
    options.compact_mask = {4, 16};
    FrameRenderer renderer(uploaded_, options);
    renderer.draw(state_, smallEye(), manyLights());
    EXPECT_THROW((void)renderer.read({.colour = false, .masks = true}), Error);
    // Masks of someone else's have a channel for each light; no light at all has no mask.
    const std::vector<ImageF> lit(manyLights().size(), ImageF(64, 48, 1, 1.0F));
    renderer.draw(state_, smallEye(), manyLights(), &lit);
    EXPECT_EQ(renderer.read({.colour = false, .masks = true}).masks.size(), lit.size());
    renderer.draw(state_, smallEye(), {});
    (void)renderer.read({.colour = true});
    renderer.setShadows({});
    renderer.draw(state_, smallEye(), manyLights());
}

} // namespace
} // namespace gnomon::host::test
