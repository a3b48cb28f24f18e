// SPDX-License-Identifier: Apache-2.0
// The README's lines of library use, run against the driver that does nothing.
#include "null_driver.h"

#include <gnomon/planner.h>
#include <gnomon/vulkan/caster_drawer.h>

#include <glm/gtc/matrix_transform.hpp>

#include <array>
#include <cstdlib>

int main()
{
    gnomon::test::NullDriver engine;
    const VkCommandBuffer commands = engine.commands();
    const VkImageView depth_view = engine.makeView();
    const VkExtent2D screen{1280, 720};
    const glm::dvec3 eye(4.0, 3.0, 6.0);
    const glm::dmat4 clip_from_world = glm::perspectiveRH_ZO(0.9, 16.0 / 9.0, 500.0, 0.1) *
                                       glm::lookAtRH(eye, glm::dvec3(0.0), glm::dvec3(0.0, 1.0, 0.0));
    const gnomon::vulkan::DeviceView device = engine.view();
    const std::uint32_t slot = 0;
    const VkBuffer vertices = engine.makeBuffer();
    const VkBuffer indices = engine.makeBuffer();
    const std::array parts{gnomon::vulkan::DrawPart{{0, 36, 0}, 0}};
    const std::array draws{gnomon::vulkan::DrawObject{0, 1}, gnomon::vulkan::DrawObject{0, 1}};
    const std::array<gnomon::vulkan::Rows3x4, 2> world_from_object{};

    // README begin
    gnomon::ObjectSet objects; // bounds of everything that casts or receives
    objects.add({{-20.0F, -0.1F, -20.0F}, {20.0F, 0.0F, 20.0F}});
    objects.add({{-1.0F, 0.0F, -1.0F}, {1.0F, 2.0F, 1.0F}});
    gnomon::Light sun;
    sun.direction_ws = glm::normalize(glm::dvec3(0.5, -1.0, 0.3));

    gnomon::Frame frame;
    frame.camera = {eye, clip_from_world}; // reversed depth: 1 near, 0 far
    frame.size_px = {screen.width, screen.height};
    frame.lights = {&sun, 1};
    frame.objects = &objects;
    gnomon::Planner planner({.max_texels = 2048 * 2048}); // which maps, by which matrices, who is drawn there; all auto
    const gnomon::Plan& plan = planner.plan(frame);

    gnomon::vulkan::ShadowRenderer shadows(device); // yours
    gnomon::vulkan::CasterDrawer casters(device);
    casters.setScene(parts, draws); // which ranges of your index buffer each object draws
    shadows.prepare(plan, screen);
    casters.beginFrame(slot, plan, {vertices, 0, nullptr, 0, indices, 0}, world_from_object);
    shadows.recordMaps(commands, slot, plan, casters.callback()); // or a callback of your own
    shadows.recordMask(commands, slot, plan, {screen, depth_view});
    const gnomon::vulkan::ImageRef mask = shadows.mask(); // visibility per pixel: 1 lit, 0 in shadow
    // README end

    return plan.views.size() == 1 && casters.triangles() > 0 && mask.view != VK_NULL_HANDLE ? EXIT_SUCCESS
                                                                                            : EXIT_FAILURE;
}
