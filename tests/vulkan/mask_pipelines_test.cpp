// SPDX-License-Identifier: Apache-2.0
// Pipelines of the mask are made in prepare(), not while it is recorded.
#include "null_driver.h"
#include "scene.h"

#include <gtest/gtest.h>

namespace gnomon::test {
namespace {

constexpr VkExtent2D kScreen{64, 48};

class Masks {
public:
    explicit Masks(const vulkan::ShadowRendererOptions& options = {}) : renderer_(driver_.view(), options) {}

    /// Pipelines made by prepare(), then by the recording.
    std::pair<std::uint64_t, std::uint64_t> frame(const std::vector<Light>& lights, bool warped = false)
    {
        std::vector<Tile> tiles;
        for (std::uint32_t i = 0; i < lights.size(); ++i) {
            tiles.push_back({0, 64 * i, 0, 64, 64});
        }
        Plan plan = makePlan(scene_, lights, tiles, {512, 64, 1});
        if (warped) {
            plan.views[0].projection.orthographic = false;
        }
        const auto before = driver_.counts().pipelines;
        (void)renderer_.prepare(plan, kScreen);
        const auto prepared = driver_.counts().pipelines;
        renderer_.recordMaps(driver_.commands(), 0, plan, [](const vulkan::MapPass&) {});
        renderer_.recordMask(driver_.commands(), 0, plan, inputs_);
        return {prepared - before, driver_.counts().pipelines - prepared};
    }

private:
    NullDriver driver_;
    Scene scene_ = makeScene();
    vulkan::ShadowRenderer renderer_;
    vulkan::MaskInputs inputs_{kScreen, driver_.makeView()};
};

using Pipelines = std::pair<std::uint64_t, std::uint64_t>;

TEST(MaskPipelines, AreNotMadeWhileRecording)
{
    const Light sun = makeSun({0.5, -1.0, 0.2});
    const Light lamp = makeSpot({4.0, 8.0, 2.0}, {0.0, 0.0, 0.0}, 0.5);
    Masks masks;
    EXPECT_EQ(masks.frame({sun}), Pipelines(0, 1)) << "nobody said which inputs there would be";
    EXPECT_EQ(masks.frame({sun}), Pipelines(0, 0));
    EXPECT_EQ(masks.frame({sun}, true), Pipelines(1, 0)) << "a fit that falls back";
    EXPECT_EQ(masks.frame({sun, lamp}), Pipelines(1, 0)) << "a mask of another format";
    EXPECT_EQ(masks.frame({sun, sun, sun, lamp, lamp}), Pipelines(0, 0)) << "more lights";
    EXPECT_EQ(masks.frame({sun, sun}, true), Pipelines(0, 0));
}

TEST(MaskPipelines, AreMadeBeforeTheFirstFrameWhereTheInputsAreKnown)
{
    const Light sun = makeSun({0.5, -1.0, 0.2});
    Masks masks({.mask_shape = vulkan::MaskShape{}});
    EXPECT_EQ(masks.frame({sun}), Pipelines(1, 0));
}

} // namespace
} // namespace gnomon::test
