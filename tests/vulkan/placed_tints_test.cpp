// SPDX-License-Identifier: Apache-2.0
// Maps of tints for a host that shades from the maps itself: which views have one, and where.
#include "null_driver.h"
#include "scene.h"

#include <gnomon/error.h>

#include <gnomon/shared/gpu_structs.h>

#include <gtest/gtest.h>

#include <vector>

namespace gnomon::test {
namespace {

class PlacedTints : public ::testing::Test {
protected:
    /// One past the layer of the tints of each view.
    std::vector<float> placesBy(vulkan::ShadowRenderer& renderer) const
    {
        std::vector<shared::GpuView> views(plan_.views.size());
        renderer.placeTints(plan_, views);
        std::vector<float> places;
        for (const shared::GpuView& view : views) {
            places.push_back(view.more.w);
        }
        return places;
    }

    NullDriver driver_;
    Scene scene_ = makeScene();
    std::vector<Light> lights_{makeSun({0.5, -1.0, 0.2}), makeSpot({4.0, 8.0, 2.0}, {0.0, 0.0, 0.0}, 0.5)};
    Plan plan_ = makePlan(scene_, lights_, std::vector<Tile>{{0, 0, 0, 256, 256}, {1, 0, 0, 256, 256}}, {256, 256, 2},
                          {.technique = kPlainTechnique});
};

TEST_F(PlacedTints, ViewsWithBlendedCastersHaveTheLayerOfTheirMap)
{
    const std::uint32_t blended = plan_.casters.at(0);
    plan_.views[1].casters.count = 0; // the sun's map alone has it
    plan_.views[1].casters.still = 0;
    vulkan::ShadowRenderer renderer(driver_.view(), {.is_blended = [&](std::uint32_t one) {
                                        return one == blended;
                                    }});
    EXPECT_EQ(renderer.tints().image, VkImage{VK_NULL_HANDLE}) << "nothing is prepared";
    (void)renderer.prepare(plan_, {});
    EXPECT_NE(renderer.tints().image, VkImage{VK_NULL_HANDLE});
    EXPECT_EQ(renderer.tints().layers, 2U);
    EXPECT_EQ(renderer.tints(7).image, VkImage{VK_NULL_HANDLE});
    EXPECT_EQ(placesBy(renderer), (std::vector<float>{1.0F, 0.0F}));
}

TEST_F(PlacedTints, WithoutBlendedCastersThereAreNone)
{
    vulkan::ShadowRenderer renderer(driver_.view(), {.is_blended = [](std::uint32_t) {
                                        return false;
                                    }});
    (void)renderer.prepare(plan_, {});
    EXPECT_EQ(renderer.tints().image, VkImage{VK_NULL_HANDLE});
    EXPECT_EQ(placesBy(renderer), (std::vector<float>{0.0F, 0.0F}));
}

// A host that writes its descriptors only when it is told to must hear of it.
TEST_F(PlacedTints, PrepareSaysWhenTheyComeAndGo)
{
    bool any = true;
    vulkan::ShadowRenderer renderer(driver_.view(), {.is_blended = [&any](std::uint32_t) {
                                        return any;
                                    }});
    EXPECT_TRUE(renderer.prepare(plan_, {}));
    EXPECT_FALSE(renderer.prepare(plan_, {}));
    const VkImage before = renderer.tints().image;
    any = false;
    EXPECT_TRUE(renderer.prepare(plan_, {}));
    EXPECT_EQ(renderer.tints().image, VkImage{VK_NULL_HANDLE});
    EXPECT_FALSE(renderer.prepare(plan_, {}));
    any = true;
    EXPECT_TRUE(renderer.prepare(plan_, {}));
    EXPECT_EQ(renderer.tints().image, before);
    EXPECT_EQ(placesBy(renderer), (std::vector<float>{1.0F, 2.0F}));
}

TEST_F(PlacedTints, TooLittleRoomOrAPlanThatIsNotPreparedIsAnError)
{
    vulkan::ShadowRenderer renderer(driver_.view(), {});
    EXPECT_THROW((void)placesBy(renderer), Error);
    (void)renderer.prepare(plan_, {});
    std::vector<shared::GpuView> few(1);
    EXPECT_THROW(renderer.placeTints(plan_, few), Error);
    EXPECT_EQ(placesBy(renderer).size(), 2U);
}

} // namespace
} // namespace gnomon::test
