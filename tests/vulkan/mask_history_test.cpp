// SPDX-License-Identifier: Apache-2.0
// Where a pixel was in the frame before.
#include "mask_history.h"
#include "null_driver.h"
#include "scene.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace gnomon::test {
namespace {

constexpr VkExtent2D kScreen{64, 40};

Plan planOf(const glm::dvec2& jitter_px)
{
    Plan plan;
    Camera& camera = plan.made_for.camera;
    camera = makeCamera({9.0, 6.0, 11.0}, {0.0, 0.5, 0.0}, 1.6);
    camera.jitter_px = jitter_px;
    const glm::dvec2 shift(jitter_px.x * 2.0 / kScreen.width, jitter_px.y * 2.0 / kScreen.height);
    const glm::dmat4 moved(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, shift.x, shift.y, 0, 1);
    camera.clip_from_world = moved * camera.clip_from_world;
    return plan;
}

/// While the camera stands each pixel is where it was, whatever jitter the two frames have.
TEST(MaskHistory, FindsAPixelWhereItWasWhateverTheJitter)
{
    NullDriver driver;
    vulkan::Device device(driver.view());
    vulkan::MaskHistory history(device, {.surfaces = VK_FORMAT_R16G16B16A16_SFLOAT});
    vulkan::ImageInfo mask;
    mask.format = VK_FORMAT_R8_UNORM;
    mask.extent = kScreen;
    EXPECT_TRUE(history.prepare(mask));
    history.begin(driver.commands());
    history.end(driver.commands(), planOf({0.25, -0.5}));
    const Plan now = planOf({-0.4, 0.3});
    EXPECT_TRUE(history.stands(now));
    const vulkan::Reprojection before = history.reprojection(now);
    const glm::dvec3 p(1.0, 0.5, -2.0);
    const glm::dvec4 from_eye(p - now.made_for.camera.eye_ws, 1.0);
    const double w = glm::dot(glm::dvec4(before.w), from_eye);
    const glm::dvec4 clip = now.made_for.camera.clip_from_world * glm::dvec4(p, 1.0);
    EXPECT_NEAR(glm::dot(glm::dvec4(before.x), from_eye) / w, (0.5 * clip.x / clip.w + 0.5) * kScreen.width, 1e-3);
    EXPECT_NEAR(glm::dot(glm::dvec4(before.y), from_eye) / w, (0.5 * clip.y / clip.w + 0.5) * kScreen.height, 1e-3);
}

} // namespace
} // namespace gnomon::test
