// SPDX-License-Identifier: Apache-2.0
// Which layer and channel of the mask a light has.
#include "worlds.h"

#include <gnomon/plan_views.h>
#include <gnomon/planner.h>

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace gnomon {
namespace {

ShadowOptions plainWith(Translucent translucent)
{
    ShadowOptions options{.technique = kPlainTechnique, .map_size = 64};
    options.translucent = translucent;
    return options;
}

/// A box over a floor, in the light of suns with these options.
class MaskPlaces : public ::testing::Test {
protected:
    MaskPlaces()
    {
        set_.add({{-10, 0, -10}, {10, 0, 10}});
        set_.add({{-1, 1, -1}, {1, 3, 1}});
    }
    const Plan& plan(Planner& planner, const std::vector<std::uint32_t>& options)
    {
        lights_.clear();
        for (const std::uint32_t one : options) {
            lights_.push_back(test::sun({0, -1, 0}));
            lights_.back().options = one;
        }
        Frame frame;
        frame.objects = &set_;
        frame.camera = test::orthographicCamera({0, 500, 0}, {0, 0, 0}, 50.0);
        frame.lights = lights_;
        return planner.plan(frame);
    }

    ObjectSet set_;
    std::vector<Light> lights_;
};

TEST_F(MaskPlaces, ColouredLightHasALayerOfItsOwn)
{
    const std::array options{plainWith(Translucent::grey), plainWith(Translucent::colour)};
    Planner planner(options);
    const Plan& made = plan(planner, {0, 1, 0, 0, 0, 0, 1, 2}); // there are no options 2: the light is refused
    constexpr std::array<std::array<std::uint32_t, 2>, 8> kPlaces{
        {{0, 0}, {1, 3}, {0, 1}, {0, 2}, {0, 3}, {2, 0}, {3, 3}, {2, 1}}};
    ASSERT_EQ(made.lights.size(), kPlaces.size());
    for (std::size_t i = 0; i < kPlaces.size(); ++i) {
        const LightPlan& light = made.lights[i];
        EXPECT_EQ((std::array{light.mask_layer, light.mask_channel}), kPlaces[i]) << i;
        EXPECT_EQ(light.mask_coloured, i == 1 || i == 6) << i;
        EXPECT_EQ(maskChannelsOf(light), light.mask_coloured ? 0xFU : 1U << kPlaces[i][1]) << i;
    }
    EXPECT_EQ(made.mask_layers, 4U);
}

TEST_F(MaskPlaces, MaskOfOneLightHasOneChannelUnlessItIsColoured)
{
    for (const Translucent translucent : {Translucent::none, Translucent::grey, Translucent::colour}) {
        const bool coloured = translucent == Translucent::colour;
        Planner planner(plainWith(translucent));
        EXPECT_EQ(maskChannelCount(plan(planner, {0})), coloured ? 4U : 1U);
        EXPECT_EQ(plan(planner, {0}).mask_layers, 1U);
        EXPECT_EQ(maskChannelCount(plan(planner, {0, 0})), 4U);
        EXPECT_EQ(plan(planner, {0, 0}).mask_layers, coloured ? 2U : 1U);
    }
}

} // namespace
} // namespace gnomon
