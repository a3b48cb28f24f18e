// SPDX-License-Identifier: Apache-2.0
// The README's lines of library use, run against the driver that does nothing.
#include "null_driver.h"

#include <gnomon/planner.h>
#include <gnomon/vulkan/shadow_renderer.h>

#include <glm/gtc/matrix_transform.hpp>

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
    std::size_t drawn = 0;
    const auto drawObject = [&](const gnomon::vulkan::MapPass&, std::uint32_t) {
        ++drawn;
    };

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

    gnomon::vulkan::ShadowRenderer shadows(engine.view(), {}); // your device
    shadows.prepare(plan, screen);
    shadows.recordMaps(commands, 0, plan, [&](const gnomon::vulkan::MapPass& pass) {
        for (const std::uint32_t object : pass.casters) { // all of them: filterable maps hold receivers, too
            // By pass.clip_from_world, with a pipeline for pass.formats: docs/integrating.md.
            drawObject(pass, object);
        }
    });
    shadows.recordMask(commands, 0, plan, {screen, depth_view});
    const gnomon::vulkan::ImageRef mask = shadows.mask(); // visibility per pixel: 1 lit, 0 in shadow
    // README end

    return plan.views.size() == 1 && drawn > 0 && mask.view != VK_NULL_HANDLE ? EXIT_SUCCESS : EXIT_FAILURE;
}
