// SPDX-License-Identifier: Apache-2.0
// One plan, drawn by the Vulkan backend and by OpenGL from the same depths.
#pragma once

#include "gl_scene.h"
#include "planned_scene.h"

#include "image/image.h"

namespace gnomon::test {

struct VulkanSide {
    explicit VulkanSide(VkExtent2D screen, Gpu& device = gpu()) : scene(device, screen), drawing(device, scene.mesh())
    {
    }

    PlannedScene scene;
    Drawing drawing;
};

struct GlSide {
    explicit GlSide(VkExtent2D screen_in) : screen(screen_in) {}

    /// The depths that this camera sees, from the same numbers that the Vulkan side has.
    void see(const Camera& camera) { inputs = scene.upload(tracePicture(makeScene(), camera, screen)); }
    /// Draws maps and mask.
    void run(const Plan& plan);
    /// see() and run(); all layers of the mask, one after the other.
    std::vector<std::byte> draw(const Plan& plan);

    VkExtent2D screen;
    GlScene scene{makeScene()};
    gl::ShadowRenderer renderer{{EglContext::function, {}}};
    gl::MaskInputs inputs;
};

/// A sun, a spot, a lamp: names with spaces between them.
[[nodiscard]] std::vector<Light> lightsOf(const std::string& names);
/// By how many of 255 steps two masks differ at most.
[[nodiscard]] int farthest(const std::vector<std::byte>& a, const std::vector<std::byte>& b);
/// One light's channel.
[[nodiscard]] ImageF channelOf(const std::vector<std::byte>& mask, VkExtent2D screen, const Plan& plan,
                               const LightPlan& light);

} // namespace gnomon::test
